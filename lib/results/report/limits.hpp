#pragma once

#include <string>
#include <vector>

#include "statistics/limit_curve.hpp"
#include "store/rows.hpp"
#include "sweep/limit_rule.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// How far a planner goes.
struct PlannerLimit {
  std::string planner, version;  ///< label without the field
  LimitEstimate estimate;
  std::vector<std::int64_t> trials, successes;  ///< at each level
  std::vector<double> flown_mps;  ///< sum of the mean speeds of these flights, at each level
};

/// Of two planners on the same maps; from kLeastMaps maps on.
struct LimitPair {
  std::size_t planner_1 = 0, planner_2 = 0;
  LimitContrast contrast;
};

/// What a sweep with a LimitRule has found, computed from its trials. Without such a rule
/// `planners` is empty.
struct LimitSummary {
  LimitRule rule;
  std::int64_t map_count = 0;
  std::vector<PlannerLimit> planners;  ///< by label
  std::vector<LimitPair> pairs;
};

/// `result` has the rule's field among its fields. Throws InputError where a trial's value is none
/// of the rule's.
LimitSummary limits_of(const SweepResult& result, const LimitRule& rule);

/// The table `limit_speeds`, of a limit over max_speed_mps alone: how fast flights at lower, middle
/// and higher settings were.
Table limit_speed_table(const LimitSummary& summary);

/// The tables `limits`, `limit_pairs` and `limit_curve`; without rows for other sweeps.
Table limit_table(const LimitSummary& summary);
Table limit_pair_table(const LimitSummary& summary);
Table limit_curve_table(const LimitSummary& summary);

/// What the limits can't carry.
std::vector<std::string> warnings_of(const LimitSummary& summary);

}  // namespace avoidbench
