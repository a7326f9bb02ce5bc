#pragma once

#include <span>

#include "base/math.hpp"
#include "trial/mission.hpp"

namespace avoidbench {

/// How hard a trial's movers make it, whoever flies. NaN where it has none.
struct MoverDifficulty {
  double density_1pm2 = math::kNaN;            ///< movers over the flight box's area
  double speed_mps = math::kNaN;               ///< their mean speed
  double dynamic_traversability = math::kNaN;  ///< share of straight flights that meet nothing
};

/// Of the trial's movers on the map of `map`.
MoverDifficulty mover_difficulty(const TrialSpec& spec, const Scene& map, const Mission& mission);

/// Of the first minute, at most the flight's time limit: the mean over movers and over time, by
/// seconds. Those that stand count too.
double mean_mover_speed_mps(std::span<const Motion> motions, std::int64_t mover_count,
                            double time_limit_s);

/// The share of 100 straight flights of 10 m at `speed_mps` and at the height of the mission's
/// start in which a ball of `radius_m` meets neither the map nor what moves. Each begins at a free
/// place of the flight box drawn from `seed`, within the first 30 s, at most the time limit, and
/// ends within the box. NaN where a box has no such flight.
double dynamic_traversability(Scene& scene, const Eigen::Vector3d& start_world, double radius_m,
                              double speed_mps, double time_limit_s, std::uint64_t seed);

}  // namespace avoidbench
