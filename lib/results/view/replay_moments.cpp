#include <algorithm>
#include <limits>

#include "base/option_error.hpp"
#include "trial/planner_view.hpp"
#include "view/replay_sheet.hpp"

namespace avoidbench {
namespace {

/// All are in memory, with their images, until the flight's end.
constexpr std::size_t kMostMoments = 2000;

/// Of whichever kind of view it is: depth, the left eye of a pair, or colour.
template <class View>
SeenImage seen_image(const View& view, int width_px, int height_px) {
  SeenImage image{.time_s = view.time_s,
                  .width_px = width_px,
                  .height_px = height_px,
                  .depth_m = {},
                  .bytes = {}};
  if constexpr (requires { view.depth_m; }) {
    image.depth_m.assign(view.depth_m.begin(), view.depth_m.end());
  } else if constexpr (requires { view.left; }) {
    image.bytes.assign(view.left.begin(), view.left.end());
  } else {
    image.bytes.assign(view.rgb.begin(), view.rgb.end());
  }
  return image;
}

}  // namespace

MomentRecorder::MomentRecorder(std::vector<double> at_s, double every_s, const TrialSpec& spec)
    : at_s_(std::move(at_s)), every_s_(every_s), cameras_(rig_cameras(seen_sensor(spec))) {
  std::sort(at_s_.begin(), at_s_.end());
  // Never reached by a call: finish() keeps the flight's end in its place.
  if (at_s_.empty() && every_s_ <= 0.0) at_s_.push_back(std::numeric_limits<double>::infinity());
}

/// Both lists of times are merged as they are needed, in order.
double MomentRecorder::next_s() const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double at = at_index_ < at_s_.size() ? at_s_[at_index_] : kNever;
  const double every = every_s_ > 0.0 ? every_s_ * static_cast<double>(every_index_) : kNever;
  return std::min(at, every);
}

void MomentRecorder::keep(double time_s) {
  if (moments_.size() == kMostMoments) {
    throw OptionError("more than " + std::to_string(kMostMoments) + " pictures; show fewer", "",
                      "every");
  }
  // The latest call before the moment, under the moment's own time.
  moments_.push_back(latest_);
  moments_.back().time_s = time_s;
  const double next = next_s();
  // Both pointers go past this time, so that a time in both lists is one moment.
  while (at_index_ < at_s_.size() && at_s_[at_index_] <= next) ++at_index_;
  if (every_s_ > 0.0 && every_s_ * static_cast<double>(every_index_) <= next) ++every_index_;
}

void MomentRecorder::see(double time_s, const VehicleState& believed, const PlannerView& seen) {
  // Moments before this call have the call before it: it is what the vehicle was flying by.
  while (next_s() < time_s) keep(next_s());
  latest_.call_s = time_s;
  latest_.believed = believed;
  // Views come newest first: from the last one on, newer ones overwrite older ones of a camera.
  const auto take = [&](const auto& views) {
    for (auto view = views.rbegin(); view != views.rend(); ++view) {
      if (latest_.images.size() <= view->camera) latest_.images.resize(view->camera + 1);
      const CameraSpec& camera = cameras_[view->camera].kind;
      latest_.images[view->camera] =
          seen_image(*view, static_cast<int>(camera.width_px), static_cast<int>(camera.height_px));
    }
  };
  if (!seen.depth.empty()) return take(seen.depth);
  if (!seen.color.empty()) return take(seen.color);
  take(seen.stereo);
}

void MomentRecorder::planned(const PlanStep& step) {
  see(step.time_s, step.believed, step.view);
  latest_.result = step.result;
  points_.see(step.view);
  latest_.drawings = points_.drawings();
  latest_.drawings.insert(latest_.drawings.end(), step.drawings.begin(), step.drawings.end());
}

/// No result and no drawings: those of the call before stay.
void MomentRecorder::planning(const PlanCallAhead& call) {
  see(call.time_s, call.believed, call.view);
}

std::vector<Moment> MomentRecorder::finish(double end_s) {
  while (next_s() < end_s) keep(next_s());
  // What was asked for after the end is shown once, as the end is.
  if (at_index_ < at_s_.size() || every_s_ > 0.0) keep(end_s);
  return std::move(moments_);
}

}  // namespace avoidbench
