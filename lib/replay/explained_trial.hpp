#pragma once

#include <string>
#include <vector>

#include "explain/causes.hpp"
#include "replay/replay.hpp"

namespace avoidbench {

/// Why a stored trial failed, and why that may be less than could be known.
struct ExplainedTrial {
  CauseFound explanation;
  std::vector<std::string> warnings;
};

/// Tells it from the stored flight, which is flown again in this process where that is needed.
/// Throws InputError where the map can't be had. The trial did not reach the goal.
ExplainedTrial explain_trial(const StoredTrial& stored, const ReplayFiles& files);

/// The same in a child process, so that no planner can harm this one.
ExplainedTrial explain_trial_apart(const StoredTrial& stored, const ReplayFiles& files);

}  // namespace avoidbench
