#include "sweep/schedule.hpp"

#include <algorithm>
#include <map>

namespace avoidbench {

Schedule make_schedule(std::vector<TrialSpec> trials, const std::set<std::string>& finished_keys) {
  Schedule schedule;
  schedule.trials = std::move(trials);
  std::map<std::string, std::size_t> map_by_key;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < schedule.trials.size(); ++i) {
    const TrialSpec& spec = schedule.trials[i];
    schedule.keys.push_back(trial_key(spec));
    const auto [entry, is_new] = map_by_key.emplace(map_key(spec), schedule.maps.size());
    if (is_new) {
      MapPlan plan;
      plan.key = entry->first;
      plan.spec = spec;
      schedule.maps.push_back(std::move(plan));
    }
    schedule.map_of.push_back(entry->second);
    const bool is_twice = !seen.insert(schedule.keys[i]).second;
    const bool is_done = finished_keys.contains(schedule.keys[i]);
    if (is_done || is_twice) ++schedule.done_before;
    if (!is_done && !is_twice) schedule.maps[entry->second].waiting.push_back(i);
  }
  for (MapPlan& map : schedule.maps) std::reverse(map.waiting.begin(), map.waiting.end());
  return schedule;
}

std::optional<Assignment> next_assignment(Schedule& schedule,
                                          std::optional<std::size_t> preferred_map) {
  const auto trial_of = [&](std::size_t index) {
    MapPlan& map = schedule.maps[index];
    const std::size_t trial = map.waiting.back();
    map.waiting.pop_back();
    return Assignment{index, trial};
  };
  const auto is_ready = [&](std::size_t index) {
    const MapPlan& map = schedule.maps[index];
    return map.record.has_value() && !map.waiting.empty();
  };
  if (preferred_map && is_ready(*preferred_map)) return trial_of(*preferred_map);
  for (std::size_t i = 0; i < schedule.maps.size(); ++i) {
    MapPlan& map = schedule.maps[i];
    if (map.record || map.is_requested || map.waiting.empty()) continue;
    map.is_requested = true;
    return Assignment{i, std::nullopt};
  }
  std::optional<std::size_t> fullest;
  for (std::size_t i = 0; i < schedule.maps.size(); ++i) {
    const std::size_t most = fullest ? schedule.maps[*fullest].waiting.size() : 0;
    if (is_ready(i) && schedule.maps[i].waiting.size() > most) fullest = i;
  }
  if (fullest) return trial_of(*fullest);
  return std::nullopt;
}

}  // namespace avoidbench
