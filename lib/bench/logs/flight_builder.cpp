#include "logs/flight_builder.hpp"

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

// 128 MB of poses and 48 MB of velocities: a flight of an hour and a half at 400 Hz.
constexpr std::size_t kMostPoses = 2'000'000;
constexpr std::size_t kFewPoses = std::size_t{1} << 16U;
constexpr std::size_t kMostTopics = 10'000, kMostTopicNameBytes = 1024, kMostChildFrames = 1000;
constexpr std::size_t kMostListed = 50;

std::string left_out(std::int64_t count, std::string_view noun, std::string_view one,
                     std::string_view several) {
  const bool is_one = count == 1;
  return counted(count, noun) + " " + std::string(is_one ? one : several) + " and " +
         (is_one ? "is" : "are") + " left out";
}

/// "/odom (nav_msgs/Odometry, 3 messages)", the first of many.
std::string list_of(const std::vector<std::string>& entries) {
  const std::size_t shown = std::min(entries.size(), kMostListed);
  std::string all = joined(std::span(entries).first(shown));
  if (shown < entries.size()) all += " and " + std::to_string(entries.size() - shown) + " more";
  return all;
}

}  // namespace

std::size_t FlightBuilder::topic(std::string_view name, std::string_view type) {
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    if (topics_[i].name == name && topics_[i].type == type) return i;
  }
  if (topics_.size() == kMostTopics) throw BadMessage("more than 10000 topics");
  if (name.size() > kMostTopicNameBytes || type.size() > kMostTopicNameBytes) {
    throw BadMessage("a topic's name or type of more than 1024 bytes");
  }
  topics_.push_back(
      {.name = std::string(name), .type = std::string(type), .message = pose_message_of(type)});
  return topics_.size() - 1;
}

bool FlightBuilder::fits(const Topic& topic) const {
  return preferred_.empty() ? topic.message.has_value() : contains(preferred_, topic.name);
}

bool FlightBuilder::is_preferred_to_chosen(const Topic& topic) const {
  return !preferred_.empty() &&
         place_in(preferred_, topic.name) < place_in(preferred_, topics_[*chosen_].name);
}

std::string_view FlightBuilder::chosen_topic() const {
  return chosen_ ? std::string_view(topics_[*chosen_].name) : std::string_view();
}

void FlightBuilder::restart_with(std::size_t topic) {
  FlightBuilder again(choice_);
  again.flight_.format = std::move(flight_.format);
  again.topics_ = std::move(topics_);
  again.preferred_ = std::move(preferred_);
  again.chosen_ = topic;
  *this = std::move(again);
}

bool FlightBuilder::wants_message(std::size_t topic) {
  Topic& its = topics_[topic];
  ++its.count;
  if (!fits(its) || (!choice_.topic.empty() && its.name != choice_.topic)) return false;
  if (!chosen_) chosen_ = topic;
  if (is_preferred_to_chosen(its)) restart_with(topic);
  return *chosen_ == topic;
}

void FlightBuilder::read_message(std::size_t topic, MessageReader message, std::int64_t logged_ns) {
  read_pose_message(*topics_[topic].message, message, [&](const LoggedPose& logged) {
    if (!logged.child_frame.empty() && !is_of_child(logged.child_frame)) return;
    check_frame(logged.frame);
    LoggedPose pose = logged;
    if (pose.time_ns == 0) {
      ++unstamped_count_;
      pose.time_ns = logged_ns;
    }
    add(pose);
  });
}

bool FlightBuilder::is_of_child(std::string_view child_frame) {
  if (topics_[*chosen_].message == PoseMessage::odometry) return true;  // there it is the body
  const auto place = child_frames_.find(child_frame);
  if (place != child_frames_.end()) {
    ++place->second;
  } else {
    if (child_frames_.size() == kMostChildFrames) throw BadMessage("more than 1000 child frames");
    child_frames_.emplace(child_frame, 1);
  }
  if (child_frame_.empty()) child_frame_ = child_frame;
  return child_frame == child_frame_;
}

void FlightBuilder::check_frame(std::string_view frame) {
  if (!frame_) frame_ = frame;
  if (*frame_ == frame) return;
  throw BadMessage("its pose is in the frame '" + std::string(frame) + "', those before are in '" +
                   *frame_ + "'");
}

std::optional<std::size_t> FlightBuilder::add(const LoggedPose& pose) {
  std::vector<RecordedPose>& poses = flight_.poses;
  if (!poses.empty() && pose.velocity.has_value() == flight_.velocities.empty()) {
    throw BadMessage("some messages have a velocity, others don't");
  }
  if (!pose.position.allFinite()) {
    ++not_finite_count_;
    return std::nullopt;
  }
  if (!poses.empty() && pose.time_ns <= poses.back().time_ns) {
    ++back_in_time_count_;
    return std::nullopt;
  }
  if (poses.size() == kMostPoses) throw BadMessage("more than 2000000 poses");
  // All at once: grown step by step, a vector is for a moment held twice. Memory that is not
  // written to yet costs nothing.
  if (poses.size() == kFewPoses) poses.reserve(kMostPoses);
  if (poses.size() == kFewPoses && pose.velocity) flight_.velocities.reserve(kMostPoses);
  poses.push_back({.time_ns = pose.time_ns, .position = pose.position, .q = pose.q});
  if (pose.velocity) flight_.velocities.push_back(*pose.velocity);
  return poses.size() - 1;
}

std::string FlightBuilder::listed(bool only_fitting) const {
  std::vector<std::string> entries;
  for (const Topic& topic : topics_) {
    if (only_fitting && (!fits(topic) || topic.count == 0)) continue;
    const std::string type = topic.type.empty() ? "" : topic.type + ", ";
    entries.push_back(topic.name + " (" + type + counted(topic.count, "message") + ")");
  }
  return list_of(entries);
}

void FlightBuilder::refuse(const std::string& message) const {
  std::string all = message;
  for (const std::string& warning : flight_.warnings) all += "; " + warning;
  refuse_file(choice_.file, all);
}

void FlightBuilder::check_named_topic() const {
  std::vector<std::string> names;
  bool is_there = false;
  for (const Topic& topic : topics_) {
    names.push_back(topic.name);
    if (topic.name != choice_.topic) continue;
    is_there = true;
    if (fits(topic)) return;
  }
  const std::string fitting = listed(true);
  const std::string others =
      fitting.empty() ? "; no topic has poses of a supported type" : "; these can be: " + fitting;
  if (is_there) refuse("the topic " + choice_.topic + " can't be read as poses" + others);
  const std::string nearest = did_you_mean(choice_.topic, names);
  refuse("no topic " + choice_.topic + nearest +
         (names.empty() ? "; it has no topics" : "; it has " + listed(false)));
}

void FlightBuilder::check_topic() const {
  if (!choice_.topic.empty()) return check_named_topic();
  const auto is_candidate = [&](const Topic& topic) { return fits(topic) && topic.count > 0; };
  const auto candidates = std::count_if(topics_.begin(), topics_.end(), is_candidate);
  if (candidates > 1 && preferred_.empty()) {
    refuse("several topics have poses; name the one to read: " + listed(true));
  }
  if (candidates == 0 && !topics_.empty()) {
    const std::string read =
        preferred_.empty() ? "poses of " + std::string(kPoseMessageNames) : joined(preferred_);
    refuse("no topic has poses of a supported type (" + read + "); it has " + listed(false));
  }
}

void FlightBuilder::check_child_frame() const {
  if (child_frames_.empty()) return;
  std::vector<std::string> names, entries;
  for (const auto& [name, count] : child_frames_) {
    names.push_back(name);
    entries.push_back(name + " (" + counted(count, "transform") + ")");
  }
  if (choice_.child_frame.empty() && names.size() > 1) {
    refuse("the topic " + topics_[*chosen_].name +
           " has transforms of several child frames; name the one to read: " + list_of(entries));
  }
  if (!choice_.child_frame.empty() && !contains(names, choice_.child_frame)) {
    refuse("the topic " + topics_[*chosen_].name + " has no child frame " + choice_.child_frame +
           did_you_mean(choice_.child_frame, names) + "; it has " + list_of(entries));
  }
}

void FlightBuilder::leave_out_bad_attitudes() {
  std::vector<RecordedPose>& poses = flight_.poses;
  const auto is_good = [](const RecordedPose& pose) { return is_attitude(pose.q); };
  const std::int64_t bad_count =
      std::ssize(poses) - std::count_if(poses.begin(), poses.end(), is_good);
  flight_.has_attitude = bad_count < std::ssize(poses);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    RecordedPose pose = poses[i];
    if (flight_.has_attitude && !is_good(pose)) continue;
    flight_.has_attitude ? pose.q.normalize() : void(pose.q.setIdentity());
    poses[kept] = pose;
    if (!flight_.velocities.empty()) flight_.velocities[kept] = flight_.velocities[i];
    ++kept;
  }
  poses.resize(kept);
  if (!flight_.velocities.empty()) flight_.velocities.resize(kept);
  if (flight_.has_attitude && bad_count > 0) {
    warn(left_out(bad_count, "pose", "has no attitude", "have no attitude"));
  }
}

void FlightBuilder::leave_out_bad_velocities() {
  std::vector<Eigen::Vector3d>& velocities = flight_.velocities;
  const auto bad_count = std::count_if(velocities.begin(), velocities.end(),
                                       [](const auto& velocity) { return !velocity.allFinite(); });
  if (bad_count == 0) return;
  if (bad_count < std::ssize(velocities)) {
    warn(counted(static_cast<std::int64_t>(bad_count), "pose") + " of " +
         std::to_string(velocities.size()) + (bad_count == 1 ? " has" : " have") +
         " no velocity; all velocities are left out");
  }
  velocities = {};
}

void FlightBuilder::report_left_out() {
  if (not_finite_count_ > 0) {
    warn(left_out(not_finite_count_, "pose", "is not finite or not valid",
                  "are not finite or not valid"));
  }
  if (back_in_time_count_ > 0) {
    warn(left_out(back_in_time_count_, "pose", "is not later than the one before",
                  "are not later than the one before"));
  }
  if (unstamped_count_ > 0) {
    warn(counted(unstamped_count_, "pose") + (unstamped_count_ == 1 ? " has" : " have") +
         " no time stamp; the time of recording is used");
  }
}

RecordedFlight FlightBuilder::finish() {
  check_topic();
  check_child_frame();
  report_left_out();
  if (flight_.poses.empty()) refuse("no usable pose");
  leave_out_bad_attitudes();
  leave_out_bad_velocities();
  if (chosen_) {
    flight_.topic = topics_[*chosen_].name;
    flight_.type = topics_[*chosen_].type;
  }
  return std::move(flight_);
}

}  // namespace avoidbench
