#pragma once

#include "report/summary.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// The tables `speed` (v90, v50, mean goal velocity and crashes a planner) and `speed_curve`
/// (S(v)).
Table speed_table(const SweepSummary& summary);
Table speed_curve_table(const SweepSummary& summary);

/// What v90 can't say of these flights: too few, nine of ten did not arrive, or a setting was
/// chosen by it.
std::vector<std::string> speed_warnings(const SweepSummary& summary);

}  // namespace avoidbench
