#include "ros_shim/frames.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/portable_math.hpp"
#include "avoidbench/views.hpp"

namespace ros_shim {
namespace {

namespace portable = avoidbench::portable;

std::string plain(const std::string& frame) {
  return frame.substr(!frame.empty() && frame[0] == '/' ? 1 : 0);
}

std::string seconds_text(std::int64_t time_ns) {
  return std::to_string(static_cast<double>(time_ns) * 1e-9);
}

void rotate(const double (&q)[4], const double (&v)[3], double (&to)[3]) {
  const double wxyz[4] = {q[3], q[0], q[1], q[2]};
  const avoidbench::Vec3 turned = avoidbench::rotated(wxyz, {v[0], v[1], v[2]});
  std::copy(turned.begin(), turned.end(), to);
}

/// Along the shorter way from one rotation to the other.
void turn_between(const double (&a)[4], const double (&b)[4], double share, double (&to)[4]) {
  double dot = 0.0;
  for (int i = 0; i < 4; ++i) dot += a[i] * b[i];
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  const double angle = portable::acos(std::min(1.0, sign * dot));
  // Below that the sines say nothing more than the share.
  const bool is_small = angle < 1e-8;
  const double whole = is_small ? 1.0 : portable::sin(angle);
  const double of_a = is_small ? 1.0 - share : portable::sin((1.0 - share) * angle) / whole;
  const double of_b = sign * (is_small ? share : portable::sin(share * angle) / whole);
  for (int i = 0; i < 4; ++i) to[i] = of_a * a[i] + of_b * b[i];
}

}  // namespace

FramePose combined(const FramePose& first, const FramePose& then) {
  FramePose pose{};
  rotate(first.rotation, then.translation, pose.translation);
  for (int i = 0; i < 3; ++i) pose.translation[i] += first.translation[i];
  const double(&a)[4] = first.rotation;
  const double(&b)[4] = then.rotation;
  pose.rotation[0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
  pose.rotation[1] = a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2];
  pose.rotation[2] = a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0];
  pose.rotation[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
  return pose;
}

FramePose inverse(const FramePose& pose) {
  FramePose back{};
  for (int i = 0; i < 3; ++i) back.rotation[i] = -pose.rotation[i];
  back.rotation[3] = pose.rotation[3];
  rotate(back.rotation, pose.translation, back.translation);
  for (double& value : back.translation) value = -value;
  return back;
}

void Frames::set(const std::string& parent, const std::string& child, std::int64_t stamp_ns,
                 const FramePose& pose, bool is_static) {
  Link& link = links_[plain(child)];
  if (link.parent != plain(parent) || link.is_static != is_static) link.samples.clear();
  link.parent = plain(parent);
  link.is_static = is_static;
  if (is_static) link.samples.clear();
  const auto later = std::upper_bound(
      link.samples.begin(), link.samples.end(), stamp_ns,
      [](std::int64_t time_ns, const auto& sample) { return time_ns < sample.first; });
  link.samples.insert(later, {stamp_ns, pose});
  const std::int64_t newest_ns = link.samples.back().first;
  while (link.samples.front().first < newest_ns - kept_ns_) link.samples.pop_front();
}

bool Frames::exists(const std::string& frame) const {
  const std::string name = plain(frame);
  return links_.count(name) > 0 || std::any_of(links_.begin(), links_.end(), [&](const auto& link) {
           return link.second.parent == name;
         });
}

/// The frame, its parent and so on.
std::vector<std::string> Frames::way_up(const std::string& frame) const {
  std::vector<std::string> way{frame};
  for (auto link = links_.find(frame); link != links_.end(); link = links_.find(way.back())) {
    way.push_back(link->second.parent);
    if (way.size() > links_.size() + 1) {
      throw FrameError(FrameError::unconnected, "The tf tree is invalid: it contains a loop.");
    }
  }
  return way;
}

FramePose Frames::pose_at(const std::string& child, std::int64_t time_ns) const {
  const Link& link = links_.at(child);
  const Samples& samples = link.samples;
  if (link.is_static) return samples.front().second;
  const auto after = std::lower_bound(
      samples.begin(), samples.end(), time_ns,
      [](const auto& sample, std::int64_t wanted_ns) { return sample.first < wanted_ns; });
  if (after != samples.end() && after->first == time_ns) return after->second;
  if (after == samples.end() || after == samples.begin()) {
    const bool is_future = after == samples.end();
    throw FrameError(FrameError::extrapolated,
                     std::string("Lookup would require extrapolation into the ") +
                         (is_future ? "future" : "past") + ". Requested time " +
                         seconds_text(time_ns) + " but the " + (is_future ? "latest" : "earliest") +
                         " data is at time " +
                         seconds_text((is_future ? samples.back() : samples.front()).first) +
                         ", when looking up transform from frame [" + child + "] to frame [" +
                         link.parent + "]");
  }
  const auto before = std::prev(after);
  const double share = static_cast<double>(time_ns - before->first) /
                       static_cast<double>(after->first - before->first);
  FramePose pose{};
  for (int i = 0; i < 3; ++i) {
    pose.translation[i] =
        (1.0 - share) * before->second.translation[i] + share * after->second.translation[i];
  }
  turn_between(before->second.rotation, after->second.rotation, share, pose.rotation);
  return pose;
}

FramePose Frames::lookup(const std::string& target, const std::string& source, std::int64_t time_ns,
                         std::int64_t& at_ns) const {
  const std::string from = plain(source), to = plain(target);
  for (const std::string* frame : {&to, &from}) {
    if (exists(*frame) || from == to) continue;
    throw FrameError(FrameError::unknown, "\"" + *frame + "\" passed to lookupTransform argument " +
                                              (frame == &to ? "target" : "source") +
                                              "_frame does not exist. ");
  }
  const std::vector<std::string> up_from = way_up(from), up_to = way_up(to);
  std::size_t steps_from = 0, steps_to = up_to.size();
  for (; steps_from < up_from.size() && steps_to == up_to.size(); ++steps_from) {
    const auto common = std::find(up_to.begin(), up_to.end(), up_from[steps_from]);
    steps_to = static_cast<std::size_t>(common - up_to.begin());
    if (steps_to < up_to.size()) break;
  }
  if (steps_to == up_to.size()) {
    throw FrameError(FrameError::unconnected,
                     "Could not find a connection between '" + to + "' and '" + from +
                         "' because they are not part of the same tree. Tf has two or more "
                         "unconnected trees.");
  }
  at_ns = time_ns;
  if (time_ns == 0) {
    std::int64_t newest_ns = std::numeric_limits<std::int64_t>::max();
    const auto limit = [&](const std::string& child) {
      const Link& link = links_.at(child);
      if (!link.is_static) newest_ns = std::min(newest_ns, link.samples.back().first);
    };
    for (std::size_t i = 0; i < steps_from; ++i) limit(up_from[i]);
    for (std::size_t i = 0; i < steps_to; ++i) limit(up_to[i]);
    at_ns = newest_ns == std::numeric_limits<std::int64_t>::max() ? 0 : newest_ns;
  }
  FramePose of_source{{}, {0.0, 0.0, 0.0, 1.0}}, of_target = of_source;
  for (std::size_t i = 0; i < steps_from; ++i) {
    of_source = combined(pose_at(up_from[i], at_ns), of_source);
  }
  for (std::size_t i = 0; i < steps_to; ++i) {
    of_target = combined(pose_at(up_to[i], at_ns), of_target);
  }
  return combined(inverse(of_target), of_source);
}

}  // namespace ros_shim
