#include "sweep/schedule.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "base/digest.hpp"
#include "sweep/key_maker.hpp"

namespace avoidbench {
namespace {

/// Whether each of the keys has been there before.
/// Different settings may have one key, such as two that differ in what their mode does not use.
std::vector<bool> repeated(const std::vector<std::string>& keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    // Equal keys in the order of the trials: the first one is flown, later ones are its repeats.
    const int compared = keys[a].compare(keys[b]);
    return compared != 0 ? compared < 0 : a < b;
  });
  std::vector<bool> is_repeated(keys.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) {
    is_repeated[order[i]] = keys[order[i]] == keys[order[i - 1]];
  }
  return is_repeated;
}

bool is_ready(const MapPlan& map) { return map.record.has_value() && waiting_count(map) > 0; }

/// The group with most trials, the first of several; the end where none has any.
/// The largest first, so that the end of a run is not one long group on one worker.
template <class Groups>
auto largest(Groups& groups) {
  const auto found = std::max_element(groups.begin(), groups.end(),
                                      [](const TrialGroup& one, const TrialGroup& other) {
                                        return one.waiting.size() < other.waiting.size();
                                      });
  return found == groups.end() || found->waiting.empty() ? groups.end() : found;
}

/// Of these maps' groups the largest; null where none has any trial.
struct Largest {
  std::size_t map = 0;
  TrialGroup* group = nullptr;

  void look_at(Schedule& schedule, std::size_t index) {
    MapPlan& there = schedule.maps[index];
    if (!is_ready(there)) return;
    const auto candidate = largest(there.groups);
    const std::size_t most = group != nullptr ? group->waiting.size() : 0;
    if (candidate->waiting.size() <= most) return;
    map = index;
    group = &*candidate;
  }
};

Assignment taken(std::size_t map, TrialGroup& group) {
  const std::size_t trial = group.waiting.back();
  group.waiting.pop_back();
  return {map, trial};
}

}  // namespace

std::vector<PlannedTrial> trials_of(const Shard& shard, std::vector<PlannedTrial> trials) {
  if (shard.count <= 1) return trials;
  // Groups differ in time, by planner and by map; four or more of them even that out.
  constexpr std::size_t kLeastGroups = 4;  // a shard, so that shards are of about one size
  KeyMaker keys;
  // What stays together in a shard: trials of one planner on one map, whose building they share.
  std::vector<std::string> units;
  for (const PlannedTrial& trial : trials) {
    units.push_back(Digest().add(keys.map_key(trial)).add(trial.planner_label()).hex());
  }
  const auto count = static_cast<std::size_t>(shard.count);
  // Too few groups to share out: single trials.
  if (std::set<std::string>(units.begin(), units.end()).size() < kLeastGroups * count) {
    std::transform(trials.begin(), trials.end(), units.begin(),
                   [&](const PlannedTrial& trial) { return keys.trial_key(trial); });
  }
  // By the order of digests, which is as good as random and the same on every machine.
  std::map<std::string, std::size_t> rank;
  for (const std::string& unit : units) rank[unit] = 0;
  std::size_t next = 0;
  for (auto& [unit, number] : rank) number = next++;
  std::vector<PlannedTrial> kept;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const bool is_ours = rank[units[i]] % count == static_cast<std::size_t>(shard.index - 1);
    if (is_ours) kept.push_back(std::move(trials[i]));
  }
  return kept;
}

TrialGroup& group_of(MapPlan& map, const std::string& planner_label) {
  const auto found =
      std::find_if(map.groups.begin(), map.groups.end(),
                   [&](const TrialGroup& group) { return group.planner_label == planner_label; });
  if (found != map.groups.end()) return *found;
  map.groups.push_back({.planner_label = planner_label, .waiting = {}});
  return map.groups.back();
}

std::size_t waiting_count(const MapPlan& map) {
  std::size_t count = 0;
  for (const TrialGroup& group : map.groups) count += group.waiting.size();
  return count;
}

Schedule make_schedule(std::vector<PlannedTrial> trials,
                       const std::set<std::string>& finished_keys) {
  Schedule schedule;
  schedule.trials = std::move(trials);
  KeyMaker keys;
  std::map<std::string, std::size_t> map_by_key;
  schedule.keys.reserve(schedule.trials.size());
  schedule.map_of.reserve(schedule.trials.size());
  for (std::size_t i = 0; i < schedule.trials.size(); ++i) {
    const PlannedTrial& trial = schedule.trials[i];
    schedule.keys.push_back(keys.trial_key(trial));
    const auto [entry, is_new] = map_by_key.emplace(keys.map_key(trial), schedule.maps.size());
    if (is_new) {
      // Any trial of the map stands for it: its key says that they agree in all that the map needs.
      MapPlan plan;
      plan.key = entry->first;
      plan.spec = trial.spec();
      schedule.maps.push_back(std::move(plan));
    }
    schedule.map_of.push_back(entry->second);
  }
  const std::vector<bool> is_twice = repeated(schedule.keys);
  for (std::size_t i = 0; i < schedule.trials.size(); ++i) {
    if (is_twice[i] || finished_keys.contains(schedule.keys[i])) {
      ++schedule.done_before;
      continue;
    }
    const std::string& label = schedule.trials[i].planner_label();
    group_of(schedule.maps[schedule.map_of[i]], label).waiting.push_back(i);
  }
  for (MapPlan& map : schedule.maps) {
    // Taken from the back: reversed, missions are flown in their order.
    for (TrialGroup& group : map.groups) std::reverse(group.waiting.begin(), group.waiting.end());
  }
  return schedule;
}

void add_waiting(Schedule& schedule, std::size_t trial, const std::string& map_key,
                 const std::string& planner_label) {
  auto map = std::find_if(schedule.maps.begin(), schedule.maps.end(),
                          [&](const MapPlan& one) { return one.key == map_key; });
  if (map == schedule.maps.end()) {
    map = schedule.maps.insert(map, MapPlan{});
    map->key = map_key;
    map->record.emplace();
  }
  group_of(*map, planner_label).waiting.push_back(trial);
}

/// In this order: the same planner on the map at hand, any planner there, a map to measure, the
/// largest group anywhere.
std::optional<Assignment> next_assignment(Schedule& schedule, const Memory& memory) {
  if (memory.map && is_ready(schedule.maps[*memory.map])) {
    for (TrialGroup& group : schedule.maps[*memory.map].groups) {
      const bool is_own = group.planner_label == memory.planner_label;
      if (is_own && !group.waiting.empty()) return taken(*memory.map, group);
    }
    // A worker that has only measured the map need not make it again.
    Largest there;
    there.look_at(schedule, *memory.map);
    if (there.group != nullptr) return taken(there.map, *there.group);
  }
  for (std::size_t i = 0; i < schedule.maps.size(); ++i) {
    MapPlan& map = schedule.maps[i];
    if (map.record || map.is_requested || waiting_count(map) == 0) continue;
    // Maps before trials elsewhere: each one measured makes work for another worker.
    map.is_requested = true;
    return Assignment{i, std::nullopt};
  }
  Largest anywhere;
  for (std::size_t i = 0; i < schedule.maps.size(); ++i) anywhere.look_at(schedule, i);
  if (anywhere.group == nullptr) return std::nullopt;
  return taken(anywhere.map, *anywhere.group);
}

std::string first_planner(const Schedule& schedule, std::size_t map) {
  const std::vector<TrialGroup>& groups = schedule.maps[map].groups;
  const auto first = largest(groups);
  return first == groups.end() ? std::string() : first->planner_label;
}

}  // namespace avoidbench
