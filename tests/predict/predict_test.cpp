#include "predict/predict.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

/// Maps of two kinds, `mission_count` flights of 20 m on each, which fail by one law: exp(-3.5 - 4
/// (x - 0.5)) times a metre, x being the traversability.
FlownSet flown(std::uint64_t seed, std::int64_t maps_of_kind, std::int64_t mission_count) {
  FlownSet set;
  RandomStream random(seed);
  for (const char* kind : {"forest", "hall"}) {
    for (std::int64_t i = 0; i < maps_of_kind; ++i) {
      const double x = random.uniform(0.3, 0.8);
      const std::size_t map = set.map_of(kind + std::to_string(i), {kind, x});
      const double rate = math::exp(-3.5 - 4.0 * (x - 0.5));
      for (std::int64_t mission = 0; mission < mission_count; ++mission) {
        const bool has_reached = random.uniform() < math::exp(-20.0 * rate);
        set.planner_of("ego").trials.push_back({map, 20.0, has_reached});
        set.planner_of("blind").trials.push_back({map, 20.0, false});
      }
    }
  }
  return set;
}

std::string problem_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

double number_at(const Section& section, std::size_t table, std::size_t row, const char* name) {
  const std::vector<Column>& columns = section.tables[table].columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name != name) continue;
    const TableValue& value = section.tables[table].rows[row][i].value;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return std::get<double>(value);
  }
  ADD_FAILURE() << "no column " << name;
  return math::kNaN;
}

TEST(Predict, KnowsWhereAPlannerFlew) {
  const auto models = planner_models(flown(1, 10, 5));
  ASSERT_EQ(models.size(), 2U);
  EXPECT_EQ(models[0].label, "blind");
  EXPECT_EQ(models[0].reached_count, 0);
  const PlannerModel& ego = models[1];
  EXPECT_EQ(ego.trial_count, 100);
  EXPECT_EQ(ego.map_count, 20U);
  EXPECT_EQ(ego.kinds, (std::set<std::string>{"forest", "hall"}));
  EXPECT_EQ(ego.shortest_m, 20.0);

  MapQuestion question{.name = "m", .kind = "hall", .traversability = 0.5, .lengths_m = {20.0}};
  EXPECT_EQ(extrapolation(ego, question), "");
  question.lengths_m = {9.0, 20.0};
  EXPECT_EQ(extrapolation(ego, question), "distance (flown: 20 to 20 m)");
  question = {.name = "m", .kind = "maze", .traversability = 0.95, .lengths_m = {20.0}};
  const std::string beyond = extrapolation(ego, question);
  EXPECT_TRUE(beyond.starts_with("kind maze (flown: forest, hall); traversability (flown: 0.3"))
      << beyond;
}

TEST(Predict, SuccessOfAMapByTheLaw) {
  const auto models = planner_models(flown(2, 25, 32));
  const MapQuestion question{
      .name = "m", .traversability = 0.6, .lengths_m = std::vector<double>(30, 40.0)};
  const Section section = prediction_section(models, question, 0.9);
  const double expected = std::exp(-40.0 * std::exp(-3.5 - 4.0 * 0.1));
  EXPECT_NEAR(number_at(section, 0, 1, "predicted_success_rate"), expected, 0.05);
  EXPECT_LT(number_at(section, 0, 1, "predicted_success_rate_lower"), expected - 0.05);
  EXPECT_GT(number_at(section, 0, 1, "predicted_success_rate_upper"), expected + 0.05);
  EXPECT_NEAR(number_at(section, 0, 1, "failures_per_km"), 1000.0 * std::exp(-3.9), 4.0);
  EXPECT_LT(number_at(section, 0, 1, "slope_lower"), -4.0);
  EXPECT_GT(number_at(section, 0, 1, "slope_upper"), -4.0);
  EXPECT_LT(number_at(section, 0, 0, "predicted_success_rate"), 0.02);
}

TEST(Predict, EachKindFromTheOther) {
  const auto judged = leave_kinds_out(flown(3, 25, 16), 0.9);
  EXPECT_EQ(judged.size(), 100U);
  const Section section = judgement_section(judged, "t", 0.9);
  ASSERT_EQ(section.tables.size(), 3U);
  // Of ego, the second planner: one law for both kinds, so that the other tells of it.
  EXPECT_EQ(number_at(section, 0, 1, "mission_count"), 800.0);
  const double success_rate = number_at(section, 0, 1, "success_rate");
  EXPECT_NEAR(number_at(section, 0, 1, "predicted_success_rate"), success_rate, 0.05);
  EXPECT_LT(number_at(section, 0, 1, "brier"), number_at(section, 0, 1, "plain_brier"));
  EXPECT_GT(number_at(section, 0, 1, "within_interval"), 0.85);
  // Blind fails always, and is expected to.
  EXPECT_LT(number_at(section, 0, 0, "brier"), 0.001);
  EXPECT_EQ(section.tables[0].rows.size(), 3U);  // with all of them
  EXPECT_EQ(section.tables[1].rows.size(), 4U);
}

TEST(Predict, OtherFlightsOfThePlannersInCommon) {
  FlownSet later = flown(5, 3, 4);
  std::erase_if(later.planners, [](const FlownPlanner& one) { return one.label == "blind"; });
  const auto judged = judged_by(flown(4, 10, 10), later, 0.9);
  EXPECT_EQ(judged.size(), 6U);
  later.planners[0].label = "ego_real";  // as `import` calls real flights
  EXPECT_EQ(judged_by(flown(4, 10, 10), later, 0.9).size(), 6U);
  later.planners[0].label = "mine";
  EXPECT_EQ(problem_of([&] { judged_by(flown(4, 2, 2), later, 0.9); }),
            "no planner of these flights (mine) was flown before: blind, ego");
}

TEST(Predict, RefusesWhatTellsNothing) {
  FlownSet one_kind;
  one_kind.planner_of("ego").trials.push_back({one_kind.map_of("a", {"forest", 0.5}), 20.0, true});
  EXPECT_EQ(problem_of([&] { leave_kinds_out(one_kind, 0.9); }),
            "maps of only one kind (forest): there is no other to predict it from");
  FlownSet unmeasured;
  unmeasured.planner_of("ego").trials.push_back(
      {unmeasured.map_of("a", {"forest", math::kNaN}), 20.0, true});
  EXPECT_EQ(problem_of([&] { planner_models(unmeasured); }),
            "no trial was flown on a map whose traversability is known");
}

SweepResult sweep_of(const std::string& sensor, const std::string& map_key) {
  SweepResult sweep;
  sweep.name = sensor;
  sweep.fields = {"sensor"};
  const PlannerRow planner{
      .label = "ego", .name = "ego", .version = "1", .file_digest = "", .parameters_json = "{}"};
  sweep.planners = {planner};
  MapRow map;
  map.generator = "forest";
  map.record.key = map_key;
  map.record.traversability_normalized_ratio = 0.5;
  sweep.maps = {map};
  sweep.trials.push_back({.planner_key = planner_key(planner),
                          .map_key = map_key,
                          .outcome = Outcome::reached_goal,
                          .reference_length_m = 20.0,
                          .fields = {sensor}});
  return sweep;
}

TEST(FlownSet, WhatASweepVariesOfItsSensorIsASetting) {
  const SweepInfo sweep{.name = "s",
                        .spec_json = R"({"axes": [{"path": "sensor.width_px", "values": [64, 80]},
    {"path": "map.poisson_radius_m", "values": [3, 4]}]})"};
  EXPECT_EQ(setting_fields(sweep),
            (std::vector<std::string>{"sensor", "vehicle", "sensor.width_px"}));
}

TEST(FlownSet, SettingsAreApartOnlyWhereTheyDiffer) {
  FlownSet same, apart;
  add_sweeps(same, {sweep_of("depth_ideal", "a"), sweep_of("depth_ideal", "b")});
  ASSERT_EQ(same.planners.size(), 1U);
  EXPECT_EQ(same.planners[0].label, "ego");
  EXPECT_EQ(same.planners[0].trials.size(), 2U);
  EXPECT_EQ(same.maps.size(), 2U);
  add_sweeps(apart, {sweep_of("depth_ideal", "a"), sweep_of("stereo_sgm", "a")});
  ASSERT_EQ(apart.planners.size(), 2U);
  EXPECT_EQ(apart.planners[1].label, "ego, sensor stereo_sgm");
  EXPECT_EQ(apart.maps.size(), 1U);
}

}  // namespace
}  // namespace avoidbench
