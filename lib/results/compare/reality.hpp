#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/interval.hpp"
#include "store/database.hpp"
#include "table/table.hpp"

/// Real flights beside simulations of them: how near each simulation comes.
namespace avoidbench {

/// One planner's real flights and those of one simulation, mission by mission.
struct RealityGap {
  std::string simulation, planner;
  std::int64_t pair_count = 0, same_outcome_count = 0;
  double real_rate = 0.0, simulated_rate = 0.0;  ///< of success, over the pairs
  /// Contrast factor of the simulation over reality (AvoidBench, eq. (10)): failures per metre,
  /// with Jeffreys-smoothed rates; above 1: it is harder than reality.
  double contrast_factor = 0.0;
  Interval contrast_interval = {};  ///< BCa bootstrap over missions, 95 %
  double distance_m = 0.0;          ///< median over missions of path_distance_m()
  std::int64_t nearer_count = 0;    ///< missions on which it is nearer than the first simulation
  /// Wilcoxon's of the distances' ratios to the first simulation's, Holm over all rows that have
  /// one; NaN for the first simulation.
  double p = 0.0;
};

/// Mean distance between two paths at equal times, until the first of them ends, m. NaN where one
/// has no samples.
double path_distance_m(std::span<const Sample> a, std::span<const Sample> b);

/// By simulation, as they are given, then planner. `real` has one sweep of real flights, each other
/// database one of simulated ones; trials are paired by planner and mission. Throws InputError
/// where a database has none or several, a mission of a simulation is another one than the real
/// one, or nothing is paired.
std::vector<RealityGap> reality_gaps(const Database& real, std::span<const Database> simulations);

Table reality_table(const std::vector<RealityGap>& gaps);

}  // namespace avoidbench
