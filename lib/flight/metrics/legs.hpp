#pragma once

#include <cstdint>
#include <vector>

#include "metrics/map_record.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// What was flown toward one goal: from the start, or from where the goal before it was reached.
struct FlownLeg {
  std::int64_t index = 0;      ///< of goals_of()
  Eigen::Vector3d goal_world;  ///< where it is at the start
  bool is_reached = false;
  double begin_s = 0.0, end_s = 0.0;
  double path_length_m = 0.0;
  double reference_length_m = 0.0;  ///< of the shortest path: its part of d_min
};

/// The legs that were begun, in order; their times and lengths add up to the flight's.
std::vector<FlownLeg> flown_legs(const TrialSpec& spec, const MissionRecord& mission,
                                 const TrialRecord& record);

}  // namespace avoidbench
