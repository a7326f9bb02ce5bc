#include "sweep/cause_counts.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace avoidbench {

std::vector<CauseCount> cause_counts(std::span<const TrialSummary> trials,
                                     std::span<const PlannerRow> planners) {
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < planners.size(); ++i) index_of[planner_key(planners[i])] = i;
  std::map<std::pair<std::size_t, std::string>, std::int64_t> counts;
  std::vector<std::int64_t> failures(planners.size(), 0);
  bool is_any_told = false;
  for (const TrialSummary& trial : trials) {
    if (trial.outcome == Outcome::reached_goal) continue;
    const std::size_t planner = index_of.at(trial.planner_key);
    ++failures[planner];
    ++counts[{planner, trial.cause}];
    is_any_told = is_any_told || !trial.cause.empty();
  }
  std::vector<CauseCount> found;
  if (!is_any_told) return found;
  for (const auto& [key, count] : counts) {
    found.push_back({.planner = key.first,
                     .cause = key.second,
                     .count = count,
                     .failure_count = failures[key.first]});
  }
  std::stable_sort(found.begin(), found.end(), [](const CauseCount& a, const CauseCount& b) {
    if (a.planner != b.planner) return a.planner < b.planner;
    if (a.cause.empty() != b.cause.empty()) return b.cause.empty();
    return a.count > b.count;
  });
  return found;
}

}  // namespace avoidbench
