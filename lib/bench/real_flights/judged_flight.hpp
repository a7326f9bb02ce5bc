#pragma once

#include <optional>
#include <string>
#include <vector>

#include "real_flights/smooth_path.hpp"
#include "render/scene.hpp"
#include "trial/mission.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// An attitude of the log, in the map's frame.
struct MeasuredAttitude {
  double time_s = 0.0;
  Eigen::Quaterniond q_world_body = Eigen::Quaterniond::Identity();
};

/// What is known of a real flight: its times begin with 0.
struct RecordedMotion {
  SmoothPath path;
  std::vector<MeasuredAttitude> attitudes;  ///< times rise; empty where the log has none
  double duration_s = 0.0;
};

/// A flight as a record, or why there is none.
struct JudgedFlight {
  TrialRecord record;
  std::string problem;  ///< that what is given contradicts the path; "": nothing
};

/// The flight sampled and ended by the rules of simulated ones: physics ticks are looked at in
/// order, and the first contact, exit from the bounds, entry into the goal's circle or the time
/// limit ends it. What `spec.recording` gives as the outcome is believed instead: reached_goal ends
/// where the path enters the circle, all others with the log. Without attitudes the body's z axis
/// follows from the acceleration and its heading from the velocity. NaN: body rates without
/// attitudes, the reference, the rotors' power.
JudgedFlight judge(const TrialSpec& spec, const Mission& mission, const Scene& scene,
                   const RecordedMotion& motion);

}  // namespace avoidbench
