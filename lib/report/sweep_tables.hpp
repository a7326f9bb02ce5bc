#pragma once

#include "report/summary.hpp"
#include "report/table.hpp"

namespace avoidbench {

/// A sweep's tables: `planners` (rates and means), `groups` (the same by traversability),
/// `outcomes` (counts), `pairs` (contrast factors).
Section sweep_section(const SweepSummary& summary);

}  // namespace avoidbench
