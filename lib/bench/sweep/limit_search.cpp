#include "sweep/limit_search.hpp"

#include <algorithm>

namespace avoidbench {
namespace {

/// The first round: a few trials over the whole range, before anything is known.
constexpr std::size_t kFirstLevels = 9, kFirstTrials = 2;
/// Trials of a round: few, since each round is chosen better; enough to keep workers busy.
constexpr std::size_t kRoundTrials = 8;

}  // namespace

LimitSearch::LimitSearch(const LimitRule& rule, std::vector<LimitTrial> trials)
    : rule_(rule), curve_(rule.curve()), trials_(std::move(trials)) {
  std::map<std::string, std::size_t> maps;
  for (const LimitTrial& trial : trials_) maps.emplace(trial.map, 0);
  // By name, so that a report, which knows the flown maps only, has them in the same order.
  std::size_t number = 0;
  for (auto& [place, map] : maps) map = number++;

  std::map<std::pair<std::string, std::size_t>, std::vector<std::size_t>> supplies;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    map_of_.push_back(maps.at(trials_[i].map));
    supplies[{trials_[i].planner, trials_[i].level}].push_back(i);
  }
  for (auto& [place, supply] : supplies) {
    // In the order in which they are flown: first missions of all maps, then second ones.
    std::stable_sort(supply.begin(), supply.end(), [&](std::size_t a, std::size_t b) {
      return trials_[a].mission_index < trials_[b].mission_index;
    });
    Planner& planner = planners_[place.first];
    planner.levels.resize(rule.values.size());
    planner.levels[place.second] = {.trials = supply,
                                    .is_taken = std::vector<bool>(supply.size(), false)};
  }
}

std::vector<LimitCell> LimitSearch::cells_of(const Planner& planner,
                                             const std::map<std::string, bool>& successes) const {
  std::map<std::pair<std::size_t, std::size_t>, LimitCell> cells;  // by level and map
  for (const std::size_t trial : planner.rounds) {
    const auto success = successes.find(trials_[trial].key);
    if (success == successes.end()) continue;  // an invalid mission
    LimitCell& cell = cells[{trials_[trial].level, map_of_[trial]}];
    cell.level = trials_[trial].level;
    cell.map = map_of_[trial];
    ++cell.trials;
    if (success->second) ++cell.successes;
  }
  std::vector<LimitCell> all;
  for (const auto& [place, cell] : cells) all.push_back(cell);
  return all;
}

/// The next trial there that follows the planner's last one in the order of missions, so that
/// trials go over all maps evenly, whatever their levels.
void LimitSearch::take(Planner& planner, std::size_t level, std::vector<std::size_t>& round) const {
  Supply& supply = planner.levels[level];
  const std::size_t count = supply.trials.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = (planner.taken + k) % count;
    if (supply.is_taken[at]) continue;
    supply.is_taken[at] = true;
    ++planner.taken;
    planner.rounds.push_back(supply.trials[at]);
    round.push_back(supply.trials[at]);
    return;
  }
}

std::vector<std::size_t> LimitSearch::levels_wanted(Planner& planner,
                                                    const std::vector<LimitCell>& cells,
                                                    double falls) const {
  const std::size_t last = curve_.level_count() - 1;
  std::vector<std::size_t> levels;
  if (planner.taken == 0) {
    for (std::size_t k = 0; k < kFirstTrials; ++k) {
      for (std::size_t i = 0; i < kFirstLevels; ++i) {
        levels.push_back(i * last / (kFirstLevels - 1));
      }
    }
    return levels;
  }
  const LimitEstimate now = curve_.estimate(cells, falls);
  const auto most = static_cast<std::size_t>(rule_.most_trials);
  if (now.state != LimitState::found || now.width() <= rule_.relative_width() ||
      planner.taken >= most) {
    planner.is_settled = true;
    return {};
  }
  std::vector<std::int64_t> room;
  for (const Supply& supply : planner.levels) {
    room.push_back(std::count(supply.is_taken.begin(), supply.is_taken.end(), false));
  }
  levels = curve_.next(cells, std::min(kRoundTrials, most - planner.taken), std::move(room), falls);
  planner.is_settled = levels.empty();
  return levels;
}

std::vector<std::size_t> LimitSearch::next_round(const std::map<std::string, bool>& successes) {
  std::map<std::string, std::vector<std::size_t>> wanted;  // by planner
  std::vector<std::size_t> together;
  std::vector<std::vector<LimitCell>> cells;
  for (const auto& [label, planner] : planners_) cells.push_back(cells_of(planner, successes));
  const std::vector<double> others = directions_of_others(curve_, cells);
  std::size_t index = 0;
  for (auto& [label, planner] : planners_) {
    const std::size_t own = index++;
    if (planner.is_settled) continue;
    wanted[label] = levels_wanted(planner, cells[own], others[own]);
    const std::vector<std::size_t>& levels = wanted[label];
    together.insert(together.end(), levels.begin(), levels.end());
  }
  std::vector<std::size_t> round;
  for (auto& [label, planner] : planners_) {
    // In pairs also those whose limit is known: they are compared on the same missions.
    const std::vector<std::size_t>& levels = rule_.is_paired ? together : wanted[label];
    for (const std::size_t level : levels) take(planner, level, round);
  }
  return round;
}

}  // namespace avoidbench
