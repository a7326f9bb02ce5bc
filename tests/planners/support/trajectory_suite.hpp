#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

/// What planners that command trajectories have in common: trajectory_suite.cpp, which a planner's
/// test binary compiles in and instantiates with its TrajectoryPlanner.
namespace avoidbench::kinematic {

struct TrajectoryPlanner {
  std::string name, file;
  double speed_limit_mps;  ///< with the tolerance of its own feasibility check
  double detour;           ///< flown over straight length where nothing is in the way, at most
  double height_band_m;    ///< it keeps within this of 2 m there
  double published_speed_limit_mps;
  bool is_random;  ///< another seed gives another flight
};

/// What test lists call it: without this the bytes of its pointers.
inline void PrintTo(const TrajectoryPlanner& planner, std::ostream* out) { *out << planner.name; }

class TrajectoryFlight : public testing::TestWithParam<TrajectoryPlanner> {};
class TrajectoryFlightSlow : public TrajectoryFlight {};

inline std::string name_of(const testing::TestParamInfo<TrajectoryPlanner>& info) {
  return info.param.name;
}

}  // namespace avoidbench::kinematic
