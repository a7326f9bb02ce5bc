#pragma once

#include "sweep/run_state.hpp"

namespace avoidbench {

/// Flies what the run's schedule holds in worker processes, until all is done or the run is to
/// stop. Whatever a worker does, or what a planner does to it, is the outcome of its own trial.
/// When it returns, no process is left of those that it and its planners started.
void run_in_workers(Run& run);

}  // namespace avoidbench
