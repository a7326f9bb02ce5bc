#include "report/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "report/sweep_tables.hpp"
#include "statistics/rates.hpp"
#include "support/sample_sweep.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;
using sample_sweep::has_warning;
using sample_sweep::result_of;

SweepSummary summary_of(const SweepResult& result) { return summarize(result); }

TEST(Summary, CountsRatesAndMeansOverTheirPopulations) {
  // a fails mission 3 of each map, b finishes only mission 0.
  const SweepResult result = result_of(3, 4, [](char planner, int, int mission) {
    return planner == 'a' ? mission != 3 : mission == 0;
  });
  const SweepSummary summary = summary_of(result);
  ASSERT_EQ(summary.overall.size(), 2U);
  const PlannerSummary& a = summary.overall[0];
  EXPECT_EQ(a.trial_count, 12);
  EXPECT_EQ(a.finished_count, 9);
  EXPECT_EQ(a.success_rate, 0.75);
  EXPECT_EQ(a.success_interval.lower, wilson_interval(9, 12).lower);
  EXPECT_EQ(a.outcome_counts[static_cast<std::size_t>(Outcome::collided)], 3);
  EXPECT_EQ(a.mean_reference_length_m, 41.5);
  ASSERT_EQ(summary.metrics.size(), 3U);
  EXPECT_EQ(a.means[0].mean, 5.0);  // 4, 5, 6 of the finished
  EXPECT_EQ(a.means[0].count, 9);
  EXPECT_NEAR(a.means[0].standard_deviation, std::sqrt(6.0 / 8.0), 1e-12);
  EXPECT_EQ(a.means[1].mean, (9 * 100.0 + 3 * 40.0) / 12.0);  // of all
  EXPECT_EQ(a.means[1].count, 12);
  EXPECT_EQ(summary.overall[1].success_rate, 0.25);
  EXPECT_EQ(summary.trial_count, 24);
  EXPECT_EQ(summary.mission_count, 12);
}

TEST(Summary, CausesAreCountedByPlanner) {
  SweepResult result = result_of(3, 4, [](char planner, int, int mission) {
    return planner == 'a' ? mission != 3 : mission == 0;
  });
  EXPECT_TRUE(summary_of(result).causes.empty()) << "none is told";
  std::size_t told = 0;
  for (TrialSummary& trial : result.trials) {
    if (trial.outcome == Outcome::reached_goal ||
        trial.planner_key != planner_key(planner_row("b")))
      continue;
    trial.cause = ++told <= 5 ? "occluded" : told <= 7 ? "trap" : "";
  }
  const SweepSummary summary = summary_of(result);
  ASSERT_EQ(summary.causes.size(), 4U);
  EXPECT_EQ(summary.causes[0].cause, "") << "of a none is told";
  EXPECT_EQ(summary.causes[0].count, 3);
  EXPECT_EQ(summary.causes[1].cause, "occluded");
  EXPECT_EQ(summary.causes[1].count, 5);
  EXPECT_EQ(summary.causes[1].failure_count, 9);
  EXPECT_EQ(summary.causes[2].cause, "trap");
  EXPECT_EQ(summary.causes[3].cause, "") << "those not told come last";
  EXPECT_EQ(summary.causes[3].count, 2);
  const Section section = sweep_section(summary, {}, Detail::brief);
  EXPECT_TRUE(std::any_of(section.notes.begin(), section.notes.end(),
                          [](const auto& note) { return note.first == "occluded"; }));
}

TEST(Summary, MapsAreShownWithWhatTheSweepVariesOfThem) {
  SweepResult result = result_of(2, 3, [](char, int, int) { return true; });
  result.maps[0].spec_json = R"({"poisson_radius_m":2.5,"walls":{"count":3},"area_m":[10.0,12.0]})";
  result.maps[1].spec_json = R"({"poisson_radius_m":3.5,"walls":{"count":4}})";
  result.spec_json = R"({"axes":[{"path":"map_seed","values":[1]},)"
                     R"({"path":"map.poisson_radius_m","values":[2.5,3.5]},)"
                     R"({"path":"map.walls.count","values":[3,4]},)"
                     R"({"path":"map.area_m","values":[[10.0,12.0]]},)"
                     R"({"path":"map.nowhere","values":[1]},)"
                     R"({"path":"wind.mean_world_mps","values":[[0,0,0]]}]})";
  const Section section = sweep_section(summary_of(result), std::vector<std::string>{"maps"});
  ASSERT_EQ(section.tables.size(), 1U);
  const Table& table = section.tables[0];
  ASSERT_EQ(table.rows.size(), 2U);
  const std::vector<std::pair<std::string, std::string>> columns{
      {"map.poisson_radius_m", "poisson_radius_m"},
      {"map.walls.count", "count"},
      {"map.area_m", "area_m"},
      {"map.nowhere", "nowhere"},
      {"obstacle_count", "obstacles"}};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    EXPECT_EQ(table.columns[2 + i].name, columns[i].first);
    EXPECT_EQ(table.columns[2 + i].header, columns[i].second);
  }
  // The less traversable map comes first.
  EXPECT_EQ(table.rows[0][2].value, TableValue(2.5));
  EXPECT_EQ(table.rows[1][2].value, TableValue(3.5));
  EXPECT_EQ(table.rows[1][3].value, TableValue(std::int64_t{4}));
  EXPECT_EQ(table.rows[0][4].value, TableValue(std::string("[10.0,12.0]")));
  EXPECT_EQ(table.rows[1][4].value, TableValue());
}

TEST(Summary, InvalidMissionsAreShownNotCounted) {
  SweepResult result = result_of(2, 3, [](char, int, int) { return true; });
  result.maps[1] = map_row(1, 4, true);
  const SweepSummary summary = summary_of(result);
  EXPECT_EQ(summary.mission_count, 7);
  EXPECT_EQ(summary.invalid_mission_count, 1);
  EXPECT_EQ(summary.overall[0].trial_count, 6);
}

TEST(Summary, GroupsAreOfEqualCountAndRiseInTraversability) {
  const auto all = [](char, int, int) { return true; };
  const SweepSummary ten = summary_of(result_of(10, 1, all));
  ASSERT_EQ(ten.groups.size(), 5U);
  std::int64_t trials = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(ten.groups[i].map_count, 2);
    EXPECT_LE(ten.groups[i].lowest_ratio, ten.groups[i].highest_ratio);
    if (i > 0) {
      EXPECT_GT(ten.groups[i].lowest_ratio, ten.groups[i - 1].highest_ratio);
    }
    trials += ten.groups[i].planners[0].trial_count;
  }
  EXPECT_EQ(trials, 10);
  EXPECT_EQ(summary_of(result_of(3, 1, all)).groups.size(), 3U);
  EXPECT_TRUE(summary_of(result_of(1, 5, all)).groups.empty());
  const SweepSummary seven = summary_of(result_of(7, 1, all));
  for (const MapGroup& group : seven.groups)
    EXPECT_TRUE(group.map_count == 1 || group.map_count == 2);
}

TEST(Summary, MarksTheBestOnlyWhereItIsSignificant) {
  const SweepSummary clear = summary_of(result_of(
      4, 10, [](char planner, int, int mission) { return planner == 'a' || mission < 2; }));
  EXPECT_TRUE(clear.overall[0].is_best_rate);
  EXPECT_FALSE(clear.overall[1].is_best_rate);
  EXPECT_FALSE(has_warning(clear, "can't be told apart"));
  const SweepSummary unclear = summary_of(result_of(2, 5, [](char planner, int, int mission) {
    return planner == 'a' ? mission < 3 : mission < 2;
  }));
  EXPECT_FALSE(unclear.overall[0].is_best_rate);
  EXPECT_TRUE(has_warning(unclear, "can't be told apart: a / b"));
  // Of more than ten pairs their number.
  const SweepSummary many = summary_of(
      result_of(2, 5, [](char, int, int) { return true; }, {"a", "b", "c", "d", "e", "f"}));
  EXPECT_TRUE(has_warning(many, "can't be told apart: 15 of 15 pairs; the table pairs names them"));
}

TEST(Summary, ABestRateIsSureOverMapsForEachOtherPlanner) {
  // On each map 10 of 10 against 5: of n equal differences, p = 2^(1 - n) over maps.
  const auto is_marked = [](int map_count, const std::vector<const char*>& labels) {
    const SweepSummary summary = summary_of(result_of(
        map_count, 10, [](char planner, int, int mission) { return planner == 'a' || mission < 5; },
        labels));
    EXPECT_LT(summary.contrasts.at(0).fisher_p, 1e-6);
    return summary.overall.at(0).is_best_rate;
  };
  EXPECT_TRUE(is_marked(6, {"a", "b"}));        // 0.031
  EXPECT_FALSE(is_marked(6, {"a", "b", "c"}));  // twice that: Bonferroni
  EXPECT_TRUE(is_marked(7, {"a", "b", "c"}));   // 0.031
  EXPECT_FALSE(is_marked(7, {"a", "b", "c", "d", "e"}));
}

TEST(Summary, MarksNoMeanThatIsBestByAnOutlierAlone) {
  SweepResult result = result_of(4, 10, [](char, int, int) { return true; });
  const std::string a = planner_key(planner_row("a"));
  bool is_first = true;
  for (TrialSummary& trial : result.trials) {
    if (trial.planner_key != a) continue;
    // Worse on all missions but one, on which it is so much better that its mean is.
    trial.metrics[0] += is_first ? -100.0 : 0.5 + 0.01 * static_cast<double>(trial.mission_index);
    trial.metrics[1] -= is_first ? -100.0 : 0.5 + 0.01 * static_cast<double>(trial.mission_index);
    is_first = false;
  }
  const SweepSummary summary = summary_of(result);
  for (const std::size_t metric : {0U, 1U}) {
    const bool is_less_better = metric == 0;
    EXPECT_EQ(summary.overall[0].means[metric].mean < summary.overall[1].means[metric].mean,
              is_less_better);
    EXPECT_FALSE(summary.overall[0].means[metric].is_best) << metric;
    EXPECT_FALSE(summary.overall[1].means[metric].is_best) << metric;
  }
}

TEST(Summary, MarksABetterMeanByPairedMissions) {
  SweepResult result = result_of(4, 10, [](char, int, int) { return true; });
  const std::string a = planner_key(planner_row("a"));
  for (TrialSummary& trial : result.trials) {
    if (trial.planner_key == a)
      trial.metrics[0] -= 0.5 + 0.01 * static_cast<double>(trial.mission_index);
  }
  SweepSummary summary = summary_of(result);
  EXPECT_TRUE(summary.overall[0].means[0].is_best);  // less is better
  EXPECT_FALSE(summary.overall[1].means[0].is_best);
  EXPECT_FALSE(summary.overall[0].means[1].is_best);  // equal
  for (TrialSummary& trial : result.trials) {
    if (trial.planner_key != a) trial.metrics[1] += 1.0 + 0.01 * trial.end_time_s;
  }
  summary = summary_of(result);
  EXPECT_TRUE(summary.overall[1].means[1].is_best);  // more is better
  EXPECT_FALSE(summary.overall[0].means[1].is_best);
}

TEST(Summary, ContrastFactorIsUndefinedAtSureRatesButSmoothed) {
  const auto half = [](char planner, int map, int mission) {
    return planner == 'a' || mission < 4 + map % 3;
  };
  const SweepSummary summary = summary_of(result_of(6, 10, half));
  ASSERT_EQ(summary.contrasts.size(), 1U);
  const Contrast& contrast = summary.contrasts[0];
  EXPECT_TRUE(std::isnan(contrast.factor));
  EXPECT_NEAR(contrast.smoothed_factor, std::log(60.5 / 61.0) / std::log(30.5 / 61.0), 1e-12);
  EXPECT_LT(contrast.smoothed_interval.lower, contrast.smoothed_factor);
  EXPECT_GT(contrast.smoothed_interval.upper, contrast.smoothed_factor);
  EXPECT_LT(contrast.fisher_p, 1e-4);
  const SweepSummary few = summary_of(result_of(4, 10, half));
  EXPECT_TRUE(std::isnan(few.contrasts[0].smoothed_interval.lower));  // 4 maps say too little
}

TEST(Summary, WarnsInsteadOfLying) {
  SweepResult result = result_of(2, 2, [](char, int, int) { return true; });
  EXPECT_TRUE(has_warning(summary_of(result), "fewer than 10 trials of a, b"));
  EXPECT_FALSE(has_warning(summary_of(result), "different versions"));
  result.program_versions.push_back("0.2.0 fedcba");
  EXPECT_TRUE(has_warning(summary_of(result),
                          "different versions of avoidbench: 0.1.0 abcdef, 0.2.0 fedcba"));
  TrialSummary windy = result.trials[0];
  windy.key = "another wind";
  EXPECT_FALSE(has_warning(summary_of(result), "merges them"));
  result.trials.push_back(windy);
  EXPECT_TRUE(has_warning(summary_of(result), "merges them"));
  result.planners[1].label = "a";
  for (TrialSummary& trial : result.trials) {
    if (trial.planner_key == planner_key(planner_row("b")))
      trial.planner_key = planner_key(result.planners[1]);
  }
  const SweepSummary shared = summary_of(result);
  EXPECT_TRUE(has_warning(shared, "share the label a"));
  EXPECT_NE(shared.planners[0], shared.planners[1]);
}

TEST(Summary, MeansHaveIntervalsOverMaps) {
  SweepResult result = result_of(8, 4, [](char, int, int) { return true; });
  for (TrialSummary& trial : result.trials) trial.metrics[1] = trial.map_key < "8" ? 40.0 : 60.0;
  const SweepSummary summary = summary_of(result);
  const MetricMean& mean = summary.overall[0].means[1];
  EXPECT_LT(mean.interval.lower, mean.mean);
  EXPECT_GT(mean.interval.upper, mean.mean);
  EXPECT_GE(mean.interval.lower, 40.0);
  EXPECT_LE(mean.interval.upper, 60.0);
  // More missions on the same maps say nothing new of how maps differ.
  SweepResult more = result_of(8, 40, [](char, int, int) { return true; });
  for (TrialSummary& trial : more.trials) trial.metrics[1] = trial.map_key < "8" ? 40.0 : 60.0;
  const MetricMean of_more = summary_of(more).overall[0].means[1];
  EXPECT_EQ(of_more.interval.lower, mean.interval.lower);
  EXPECT_EQ(of_more.interval.upper, mean.interval.upper);
}

TEST(Summary, TellsHowMuchOfTheSweepIsMissing) {
  SweepResult result = result_of(2, 3, [](char, int, int) { return true; });
  const auto asks_for = [](int trials) {
    return R"({"axes":[{"path":"map.poisson_radius_m","values":[2,3]}],"planners":[{},{}],"trials":)" +
           std::to_string(trials) + "}";
  };
  result.spec_json = asks_for(3);
  EXPECT_FALSE(has_warning(summary_of(result), "not finished"));
  result.spec_json = asks_for(5);
  EXPECT_TRUE(has_warning(summary_of(result), "8 of its 20 trials are not flown yet"));
  // A mission that nobody can fly is not missing.
  result.maps[1] = map_row(1, 4, true);
  result.spec_json = asks_for(4);
  EXPECT_TRUE(has_warning(summary_of(result), "2 of its 14 trials are not flown yet"));
}

/// The same trials in another setting.
void fly_again(SweepResult& result) {
  const std::vector<TrialSummary> once = result.trials;
  for (TrialSummary trial : once) {
    trial.key += " again";
    result.trials.push_back(trial);
  }
}

std::string asks_along(const std::string& path) {
  return R"({"axes":[{"path":")" + path + R"(","values":[1,2]}],"planners":[{},{}],"trials":4})";
}

TEST(Summary, SettingsThatShareAMapShareItsInvalidMissions) {
  SweepResult result = result_of(1, 3, [](char, int, int) { return true; });
  result.maps[0] = map_row(0, 4, true);
  fly_again(result);
  // Whatever body there is in the map, its mass makes no other mission.
  for (const std::string path : {"vehicle.mass_kg", "wind.mean_world_mps", "latency.ms"}) {
    result.spec_json = asks_along(path);
    const SweepSummary summary = summary_of(result);
    EXPECT_FALSE(has_warning(summary, "not finished")) << path;
    EXPECT_TRUE(has_warning(summary, "groups of planner," + path + " separate them")) << path;
  }
}

TEST(Summary, SettingsWithMapsOfTheirOwnLackTrialsOfTheirOwn) {
  SweepResult result = result_of(2, 3, [](char, int, int) { return true; });
  result.maps[1] = map_row(1, 4, true);
  for (const std::string path : {"seed", "map_seed", "map.poisson_radius_m",
                                 "mission.goal_radius_m", "vehicle.body_size_m"}) {
    result.spec_json = asks_along(path);
    EXPECT_TRUE(has_warning(summary_of(result), "2 of its 14 trials are not flown yet")) << path;
  }
}

/// Such a spec is a damaged one; who reads it from a database says so.
TEST(Summary, ASweepOfNoPlannersLacksNoTrials) {
  SweepResult result = result_of(2, 3, [](char, int, int) { return true; });
  result.spec_json = R"({"trial_count":40,"until":"success_rate ci<0.9"})";
  EXPECT_FALSE(has_warning(summary_of(result), "not finished"));
}

TEST(Summary, SaysWhereTheRuleStoppedAPlanner) {
  // Of 20 missions a map as many were flown as the rule needs; the last one is mission 9.
  SweepResult result = result_of(2, 10, [](char, int, int) { return true; });
  nlohmann::json spec{{"trial_count", 80}, {"trials", 20}, {"until", "success_rate ci<0.4"}};
  spec["planners"] = {{{"label", "a"}}, {{"label", "b"}}};
  result.spec_json = spec.dump();
  const SweepSummary summary = summary_of(result);
  EXPECT_TRUE(has_warning(summary, "a stopped after 10 of 20 missions per map"));
  EXPECT_TRUE(has_warning(summary, "b stopped after 10 of 20 missions per map"));
  EXPECT_FALSE(has_warning(summary, "not flown yet"));
}

TEST(Summary, TellsOfMeasuredLatency) {
  SweepResult result = result_of(1, 3, [](char, int, int) { return true; });
  EXPECT_FALSE(has_warning(summary_of(result), "latency"));
  result.has_measured_latency = true;
  EXPECT_TRUE(has_warning(summary_of(result), "latency was measured"));
}

TEST(Summary, AnUnknownMetricGetsASuggestion) {
  const SweepResult result = result_of(1, 1, [](char, int, int) { return true; });
  try {
    summarize(result, {.metrics = {"path_optimalty_pct"}, .group_by = {}, .where = {}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean path_optimality_pct?"),
              std::string::npos);
  }
}

/// The results with the metrics of computing times, the same in each trial.
SweepResult with_times(SweepResult result, double calls, double late, double wall_ms,
                       double cpu_ms) {
  for (const char* name : {"plan_call_count", "deadline_miss_count", "processing_wall_time_ms"}) {
    MetricRow metric;
    metric.name = name;
    result.metrics.push_back(metric);
  }
  for (TrialSummary& trial : result.trials) {
    trial.metrics[2] = cpu_ms;
    trial.metrics.insert(trial.metrics.end(), {calls, late, wall_ms});
  }
  return result;
}

TEST(Summary, WarnsOfPlannersThatComputeForLongerThanTheyMay) {
  const auto all = [](char, int, int) { return true; };
  SweepResult late = with_times(result_of(1, 2, all), 100, 95, 97.0, 0.05);
  late.spec_json =
      R"({"base":{"rates":{"plan_hz":30.0},"latency":{"mode":"fixed","ms":33.0}},"axes":[]})";
  EXPECT_TRUE(has_warning(summary_of(late),
                          "190 of 200 calls of a took longer than the plan period of 33.3 ms"));
  EXPECT_TRUE(has_warning(summary_of(late),
                          "calls of b took 97 ms of wall time, but "
                          "0.05 ms of CPU time"));
  late.spec_json =
      R"({"base":{"rates":{"plan_hz":30.0},"latency":{"mode":"measured","scale":1.0}},"axes":[]})";
  EXPECT_FALSE(has_warning(summary_of(late), "plan period"));
  SweepResult slow = with_times(result_of(1, 2, all), 100, 0, 20.0, 19.0);
  slow.spec_json =
      R"({"base":{"rates":{"plan_hz":30.0},"latency":{"mode":"fixed","ms":10.0}},"axes":[]})";
  EXPECT_TRUE(has_warning(summary_of(slow), "longer than the latency of 10 ms"));
  slow.spec_json =
      R"({"base":{"rates":{"plan_hz":30.0},"latency":{"mode":"fixed","ms":10.0}},
          "axes":[{"path":"latency.ms","values":[10,33]}]})";
  EXPECT_FALSE(has_warning(summary_of(slow), "latency of"));
  EXPECT_FALSE(
      has_warning(summary_of(with_times(result_of(1, 2, all), 100, 2, 2.0, 1.9)), "calls"));
}

TEST(Summary, SoManyPairsAreCountedInsteadOfShown) {
  SweepSummary summary = summary_of(result_of(1, 1, [](char, int, int) { return true; }));
  const auto pairs_of = [&](std::span<const std::string> tables) {
    const Section section = sweep_section(summary, tables);
    for (const Table& table : section.tables) {
      if (table.name == "pairs") return std::pair(table.is_for_people, section.notes.front());
    }
    throw std::logic_error("no pairs");
  };
  EXPECT_TRUE(pairs_of({}).first);
  summary.contrasts.resize(kMostShownPairs + 1, summary.contrasts.at(0));
  const auto [is_shown, note] = pairs_of({});
  EXPECT_FALSE(is_shown);
  EXPECT_EQ(note.first, "pairs");
  EXPECT_TRUE(
      note.second.starts_with("201 pairs of planners, not shown: ask for this table by name"))
      << note.second;
  const std::string name = "pairs";
  EXPECT_TRUE(pairs_of({&name, 1}).first) << "asked for by name";
}

TEST(Summary, NamesRevisionAndVersions) {
  SweepResult result = result_of(1, 2, [](char, int, int) { return true; });
  EXPECT_EQ(sweep_section(summary_of(result), {}).title.find("revision"), std::string::npos);
  result.latest_revision = 3;
  result.revision = 2;
  const Section section = sweep_section(summary_of(result), {});
  EXPECT_EQ(section.title.rfind("Sweep forest (revision 2 of 3): ", 0), 0U) << section.title;
  EXPECT_EQ(section.notes.back().second, "a 1.2, b 1.2");
}

TEST(Summary, SaysWhoSeesTracks) {
  SweepResult result = result_of(1, 2, [](char, int, int) { return true; });
  result.spec_json = R"({"planners":[{"label":"a"},{"label":"b","sees_tracks":true}]})";
  EXPECT_EQ(sweep_section(summary_of(result), {}).notes.back().second,
            "a 1.2, b 1.2 (sees tracks)");
}

TEST(Summary, ShardsTogetherAreTheWhole) {
  const auto some = [](char planner, int map, int mission) {
    return (planner + map + mission) % 3 != 0;
  };
  const SweepResult whole = result_of(6, 3, some);
  std::vector<SweepResult> shards(2, whole);
  for (std::size_t shard = 0; shard < 2; ++shard) {
    shards[shard].trials.clear();
    shards[shard].maps.clear();
    for (std::size_t i = 0; i < whole.maps.size(); ++i) {
      if (i % 2 == shard || i == 0) shards[shard].maps.push_back(whole.maps[i]);
    }
    for (std::size_t i = 0; i < whole.trials.size(); ++i) {
      if (i % 2 == shard || i == 0) shards[shard].trials.push_back(whole.trials[i]);
    }
  }
  const SweepSummary a = summary_of(whole);
  const SweepSummary b = summary_of(combined(shards));
  EXPECT_EQ(a.trial_count, b.trial_count);
  EXPECT_EQ(a.maps.size(), b.maps.size());
  EXPECT_EQ(a.mission_count, b.mission_count);
  EXPECT_EQ(a.overall[0].success_rate, b.overall[0].success_rate);
  EXPECT_EQ(a.contrasts[0].smoothed_interval.lower, b.contrasts[0].smoothed_interval.lower);
  EXPECT_EQ(a.overall[0].means[1].interval.upper, b.overall[0].means[1].interval.upper);
  shards[1].metrics[0].version = 9;
  EXPECT_THROW(combined(shards), InputError);
}

TEST(Summary, TheOrderOfDatabasesChangesNoBit) {
  const SweepResult whole = result_of(3, 7, [](char, int, int) { return true; });
  std::vector<SweepResult> parts(2, whole);
  for (std::size_t map = 0; map < whole.maps.size(); ++map) {
    for (std::size_t part = 0; part < 2; ++part) {
      std::erase_if(parts[part].maps[map].record.missions, [&](const MissionRecord& mission) {
        return mission.index % 3 == 0 ? part == 0 : part == 1;
      });
    }
  }
  const auto indices = [](const std::vector<SweepResult>& parts_in_order) {
    std::vector<std::int64_t> all;
    const SweepResult result = combined(parts_in_order);
    for (const MapRow& map : result.maps) {
      for (const MissionRecord& mission : map.record.missions) all.push_back(mission.index);
    }
    return all;
  };
  const std::vector<std::int64_t> in_order = indices({whole, parts[1]});
  EXPECT_EQ(indices({parts[0], parts[1]}), in_order);
  EXPECT_EQ(indices({parts[1], parts[0]}), in_order);
}

}  // namespace
}  // namespace avoidbench
