#include "sweep/limit_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace avoidbench {
namespace {

constexpr std::size_t kLevels = 41, kMaps = 6;
constexpr std::int64_t kMissions = 20;

LimitRule rule_of(bool is_paired, std::int64_t most = 120) {
  LimitRule rule;
  rule.field = "planner.max_speed_mps";
  for (std::size_t i = 0; i < kLevels; ++i)
    rule.values.push_back(1.0 + 0.1 * static_cast<double>(i));
  rule.width = 0.6;
  rule.most_trials = most;
  rule.is_paired = is_paired;
  return rule;
}

std::vector<LimitTrial> all_trials(const std::vector<std::string>& planners) {
  std::vector<LimitTrial> trials;
  for (std::size_t level = 0; level < kLevels; ++level) {
    for (std::size_t map = 0; map < kMaps; ++map) {
      for (std::int64_t mission = 0; mission < kMissions; ++mission) {
        for (const std::string& planner : planners) {
          trials.push_back({.key = planner + " " + std::to_string(level) + " " +
                                   std::to_string(map) + " " + std::to_string(mission),
                            .planner = planner,
                            .map = "map " + std::to_string(map),
                            .level = level,
                            .mission_index = mission});
        }
      }
    }
  }
  return trials;
}

struct Flown {
  std::map<std::string, bool> successes;
  std::map<std::string, std::vector<const LimitTrial*>> of_planner;
};

/// Flies rounds until there is none; planner `far` has twice the limit of the other. `known` are
/// successes that are there before.
Flown fly(const LimitRule& rule, const std::vector<LimitTrial>& trials,
          const std::function<bool(const LimitTrial&)>& can_be_flown) {
  Flown flown;
  LimitSearch search(rule, trials);
  while (true) {
    const std::vector<std::size_t> round = search.next_round(flown.successes);
    if (round.empty()) return flown;
    for (const std::size_t i : round) {
      const LimitTrial& trial = trials[i];
      flown.of_planner[trial.planner].push_back(&trial);
      if (!can_be_flown(trial)) continue;
      const std::size_t limit = trial.planner == "far" ? 28 : 14;
      flown.successes[trial.key] = trial.level < limit;
    }
  }
}

const auto kAll = [](const LimitTrial&) { return true; };

TEST(LimitSearch, NoTrialIsFlownTwiceAndMapsTakeTurns) {
  const std::vector<LimitTrial> trials = all_trials({"far", "near"});
  const LimitRule rule = rule_of(false);
  const Flown flown = fly(rule, trials, kAll);
  for (const auto& [planner, own] : flown.of_planner) {
    std::set<std::string> keys;
    std::map<std::string, int> of_map;
    for (const LimitTrial* trial : own) {
      EXPECT_TRUE(keys.insert(trial->key).second) << trial->key;
      ++of_map[trial->map];
    }
    EXPECT_GE(own.size(), 18u);
    EXPECT_LE(own.size(), 120u);
    ASSERT_EQ(of_map.size(), kMaps);
    const auto [least, most] =
        std::minmax_element(of_map.begin(), of_map.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; });
    EXPECT_LE(most->second - least->second, 3) << planner;
  }
}

TEST(LimitSearch, FollowsFromResultsAlone) {
  const std::vector<LimitTrial> trials = all_trials({"far", "near"});
  const LimitRule rule = rule_of(false);
  const Flown first = fly(rule, trials, kAll), second = fly(rule, trials, kAll);
  EXPECT_EQ(first.successes, second.successes);
}

TEST(LimitSearch, PairsFlyTheSameTrials) {
  const std::vector<LimitTrial> trials = all_trials({"far", "near"});
  const LimitRule rule = rule_of(true);
  const Flown flown = fly(rule, trials, kAll);
  const auto places = [&](const std::string& planner) {
    std::vector<std::string> all;
    for (const LimitTrial* trial : flown.of_planner.at(planner)) {
      all.push_back(trial->key.substr(planner.size()));
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(places("far"), places("near"));
}

TEST(LimitSearch, MissionsThatCantBeFlownDoNotHoldItUp) {
  const std::vector<LimitTrial> trials = all_trials({"near"});
  const LimitRule rule = rule_of(false);
  const Flown flown =
      fly(rule, trials, [](const LimitTrial& trial) { return trial.mission_index % 2 == 1; });
  EXPECT_LT(flown.successes.size(), flown.of_planner.at("near").size());
  const Flown none = fly(rule, trials, [](const LimitTrial&) { return false; });
  EXPECT_TRUE(none.successes.empty());
  EXPECT_LE(none.of_planner.at("near").size(), 120u);
}

}  // namespace
}  // namespace avoidbench
