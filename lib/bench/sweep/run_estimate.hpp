#pragma once

#include <vector>

#include "store/database.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// What the trials that a database lacks will take.
struct RunEstimate {
  std::size_t missing = 0;
  std::size_t unknown = 0;   ///< of the missing: of planners that it has no trial of
  double worker_time_s = 0;  ///< wall time of one worker for the others
  double bytes = 0;          ///< that they will add to the file
};

/// By the means of the trials of the same planners that the database has.
RunEstimate estimate_run(const std::vector<PlannedTrial>& trials, const Database& database);

}  // namespace avoidbench
