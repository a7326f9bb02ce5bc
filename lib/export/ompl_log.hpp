#pragma once

#include <functional>
#include <string>

#include "store/database.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {

/// One experiment in OMPL's words: the trials of a sweep on one map.
struct OmplExperiment {
  std::string name;  ///< without white space; also good as a file's name, another for each map
  SweepInfo sweep;
  MapRow map;
  MapFlights flights;
};

/// The experiments of a sweep, in the order of read_map_flights().
std::vector<OmplExperiment> ompl_experiments(const Database& database, const SweepInfo& sweep);

/// The experiment as a benchmark log of OMPL 1.6, in the grammar of its manual ("The benchmark
/// logfile format"), for ompl_benchmark_statistics.py and Planner Arena:
/// - planners by label (with the beginning of the key where two share one), white space and | as _;
///   common properties are version, file digest and parameters;
/// - run properties: `time` is the planner's CPU time in all its calls, s, as OMPL means it;
/// `solved`
///   the goal was reached; `status` the outcome as ENUM; `solution_length` the flown path, m, of
///   finished trials; then mission_index, reference_length_m and every metric under its own name.
///   What is not defined is empty;
/// - with `progress_period_s` > 0 the progress of each run at that period: time, goal_distance_m,
///   speed_mps and clearance_m.
/// The date is that of the first run in the database, so that equal databases give equal logs.
void write_ompl_log(const Database& database, const OmplExperiment& experiment,
                    double progress_period_s, const std::function<void(const std::string&)>& write);

}  // namespace avoidbench
