#pragma once

#include <optional>
#include <vector>

#include "explain/struck_patch.hpp"
#include "trial/trial_observer.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// What the planner knew of the patch after a call.
struct CallKnowledge {
  double time_s = 0.0;
  std::optional<double> mapped_share;  ///< of the patch that it has as occupied; none: not said
};

/// Looks on while a flight is flown again: what the planner was shown and knew of what it struck in
/// the end. `spec`, `samples` of the stored flight and `patch` must outlive it.
class FlightWatch {
 public:
  FlightWatch(const TrialSpec& spec, const std::vector<Sample>& samples, const StruckPatch& patch);

  void planned(const PlanStep& step);

  /// Depth images and sweeps that it was shown.
  std::size_t depth_image_count() const { return depth_image_count_; }
  std::size_t sweep_count() const { return sweep_count_; }  ///< of these, sweeps
  bool has_pictures() const { return has_pictures_; }       ///< whether it was shown any of light
  /// Times of depth images on which the patch was at its depth, and of sweeps with points on it,
  /// ascending.
  const std::vector<double>& sensed_s() const { return sensed_s_; }
  const std::vector<CallKnowledge>& calls() const { return calls_; }

 private:
  bool shows_patch(const DepthView& image) const;
  bool shows_patch(const CloudView& cloud) const;

  const std::vector<Sample>* samples_;
  const StruckPatch* patch_;
  std::vector<CameraSetup> cameras_;
  std::vector<LidarSetup> lidars_;
  std::size_t depth_image_count_ = 0, sweep_count_ = 0;
  bool has_pictures_ = false;
  std::vector<double> sensed_s_;
  std::vector<CallKnowledge> calls_;
};

}  // namespace avoidbench
