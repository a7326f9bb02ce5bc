#pragma once

#include <cstdint>
#include <optional>

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// How many trials tell two success rates apart.
struct PowerQuestion {
  double success_rate = 0.9;  ///< of the better planner, or of the base version
  double detect = 0.05;       ///< the loss to find
  double power = 0.8, alpha = 0.05;
  /// Share of missions on which two planners that fly the same ones end differently; none: what
  /// independent planners of these rates would have.
  std::optional<double> discordance;
  std::optional<std::int64_t> trials;  ///< a planner that one has: what these find
};

/// Tables `trials` (needed, by test) and, where the question gives trials, `found` (power and
/// interval with these). Throws InputError for rates, levels or losses that are none.
Section power_section(const PowerQuestion& question);

/// How many maps tell two planners' v90 apart that differ by `detect_mps`, by how much a pilot
/// sweep's differences vary over its maps. Table `maps`, a row a pair of planners. Throws
/// InputError where the pilot has no pair with a v90 on kLeastMaps maps or more.
Section speed_power_section(const SweepSummary& pilot, double detect_mps, double power,
                            double alpha);

}  // namespace avoidbench
