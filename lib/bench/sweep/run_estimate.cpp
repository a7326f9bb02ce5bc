#include "sweep/run_estimate.hpp"

#include <map>
#include <set>
#include <string>

#include "sweep/key_maker.hpp"

namespace avoidbench {

RunEstimate estimate_run(const std::vector<PlannedTrial>& trials, const Database& database) {
  const std::map<std::string, TrialCost> costs = database.mean_costs();
  const std::set<std::string> finished = database.finished_keys();
  KeyMaker keys;
  RunEstimate estimate;
  for (const PlannedTrial& trial : trials) {
    if (finished.contains(keys.trial_key(trial))) continue;
    ++estimate.missing;
    // What a trial of a planner costs that has flown none, nobody knows.
    const auto cost = costs.find(trial.planner_label());
    if (cost == costs.end()) {
      ++estimate.unknown;
      continue;
    }
    estimate.worker_time_s += cost->second.wall_time_s;
    estimate.bytes += cost->second.bytes;
  }
  return estimate;
}

}  // namespace avoidbench
