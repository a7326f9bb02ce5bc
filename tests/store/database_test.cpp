#include "store/database.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "base/input_error.hpp"
#include "store/record_format.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "support/canonical_rows.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;
using test::canonical_rows;
using test::message_of;

double number(const Database& db, const std::string& sql) {
  Statement s(db.handle(), db.path(), sql);
  return s.step() ? s.real(0) : -1.0;
}

std::string word(const Database& db, const std::string& sql) {
  Statement s(db.handle(), db.path(), sql);
  return s.step() ? s.text(0) : "no row";
}

TEST(Database, GivesBackEveryColumnOfATrial) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  TrialRow in = trial_row("a", 1, 1, Outcome::collided);
  in.metrics = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                1.0 / 3.0};
  db.add_trial(in);

  const auto out = db.read_trial(in.key);
  ASSERT_TRUE(out.has_value());
  EXPECT_EQ(out->key, in.key);
  EXPECT_EQ(out->sweep, "forest");
  EXPECT_EQ(out->map_key, in.map_key);
  EXPECT_EQ(out->planner_label, "a");
  EXPECT_EQ(out->planner_file_digest, in.planner_file_digest);
  EXPECT_EQ(out->mission_index, 1);
  EXPECT_EQ(out->spec_json, in.spec_json);
  EXPECT_EQ(out->record.outcome, Outcome::collided);
  EXPECT_EQ(out->record.reason, in.record.reason);
  EXPECT_EQ(out->record.end_time_s, in.record.end_time_s);
  ASSERT_EQ(out->metrics.size(), 3U);
  EXPECT_TRUE(std::isnan(out->metrics[0]));
  EXPECT_EQ(out->metrics[1], in.metrics[1]);
  EXPECT_EQ(out->metrics[2], in.metrics[2]);

  EXPECT_EQ(sample_bytes(out->record.samples), sample_bytes(in.record.samples));
  ASSERT_EQ(out->record.plan_calls.size(), in.record.plan_calls.size());
  for (std::size_t i = 0; i < in.record.plan_calls.size(); ++i) {
    EXPECT_EQ(out->record.plan_calls[i].time_s, in.record.plan_calls[i].time_s);
    EXPECT_EQ(out->record.plan_calls[i].cpu_time_s, in.record.plan_calls[i].cpu_time_s);
    EXPECT_EQ(out->record.plan_calls[i].wall_time_s, in.record.plan_calls[i].wall_time_s);
    EXPECT_EQ(out->record.plan_calls[i].status, in.record.plan_calls[i].status);
    EXPECT_EQ(out->record.plan_calls[i].command_kind, in.record.plan_calls[i].command_kind);
  }
  ASSERT_EQ(out->record.collisions.size(), 1U);
  EXPECT_EQ(out->record.collisions[0].time_s, 12.5);
  EXPECT_EQ(out->record.collisions[0].speed_mps, 2.25);
  EXPECT_EQ(out->record.collisions[0].obstacle, 7);
  EXPECT_EQ(out->record.collisions[0].kind, "tree");
  EXPECT_FALSE(db.read_trial("no such key").has_value());
}

TEST(Database, StoresSamplesInTheDocumentedOrder) {
  const std::vector<Sample> samples{sample(3)};
  const std::vector<std::byte> bytes = sample_bytes(samples);
  ASSERT_EQ(bytes.size(), kSampleDoubles * 8);
  std::array<double, kSampleDoubles> n{};
  std::memcpy(n.data(), bytes.data(), bytes.size());
  const Sample& s = samples[0];
  EXPECT_EQ(n[0], s.time_s);
  EXPECT_EQ(n[1], s.position_world.x());
  EXPECT_EQ(n[6], s.velocity_world.z());
  EXPECT_EQ(n[7], s.acceleration_world.x());
  EXPECT_EQ(n[10], s.q_world_body.w());
  EXPECT_EQ(n[11], s.q_world_body.x());
  EXPECT_EQ(n[14], s.rates_body_radps.x());
  EXPECT_TRUE(std::isnan(n[17]));
  EXPECT_EQ(n[20], s.clearance_m);
  EXPECT_EQ(n[21], s.rotor_power_w);
}

TEST(Database, GivesBackEveryColumnOfAMap) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db", 0);
  const MapRow in = map_row(3, 3, true);
  db.add_map(in, "forest");
  const auto out = db.read_map(in.record.key);
  ASSERT_TRUE(out.has_value());
  EXPECT_EQ(out->generator, in.generator);
  EXPECT_EQ(out->spec_json, in.spec_json);
  EXPECT_EQ(out->map_seed, in.map_seed);
  EXPECT_EQ(out->record.key, in.record.key);
  EXPECT_EQ(out->record.world_digest, in.record.world_digest);
  EXPECT_EQ(out->record.obstacle_count, in.record.obstacle_count);
  EXPECT_EQ(out->record.triangle_count, in.record.triangle_count);
  EXPECT_EQ(out->record.traversability, in.record.traversability);
  EXPECT_EQ(out->record.traversability_normalized_ratio, in.record.traversability_normalized_ratio);
  EXPECT_TRUE(std::isnan(out->record.relative_gap_size));
  EXPECT_EQ(out->record.obstacle_density_1pm2, in.record.obstacle_density_1pm2);
  EXPECT_EQ(out->record.free_volume_ratio, in.record.free_volume_ratio);
  ASSERT_EQ(out->record.missions.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const MissionRecord& a = in.record.missions[i];
    const MissionRecord& b = out->record.missions[i];
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(a.mission.start_world, b.mission.start_world);
    EXPECT_EQ(a.mission.goal_world, b.mission.goal_world);
    EXPECT_EQ(a.mission.start_yaw_rad, b.mission.start_yaw_rad);
    EXPECT_EQ(a.is_valid, b.is_valid);
    EXPECT_EQ(a.invalid_reason, b.invalid_reason);
    EXPECT_TRUE(a.reference_length_m == b.reference_length_m || !b.is_valid);
    if (!b.is_valid) continue;
    EXPECT_EQ(a.difficulty.traversability_obstruction, b.difficulty.traversability_obstruction);
    EXPECT_EQ(a.difficulty.view_occlusion, b.difficulty.view_occlusion);
    EXPECT_EQ(a.difficulty.angle_over_length_1pm, b.difficulty.angle_over_length_1pm);
  }
  EXPECT_TRUE(std::isnan(out->record.missions[2].reference_length_m));
  EXPECT_FALSE(db.read_map("no such key").has_value());
}

TEST(Database, KeepsEverythingWhenOpenedAgain) {
  const TemporaryFolder folder;
  const TrialRow trial = trial_row("a", 0, 0, Outcome::reached_goal);
  {
    Database db = begun(folder / "r.db");
    db.add_trial(trial);
  }
  const Database reader = Database::open_for_reading(folder / "r.db");
  EXPECT_EQ(reader.finished_keys(), std::set<std::string>{trial.key});
  EXPECT_EQ(reader.finished_trials().at(trial.key), Outcome::reached_goal);
  ASSERT_EQ(reader.metrics().size(), 3U);
  EXPECT_EQ(reader.metrics()[2].name, "processing_time_ms");
  EXPECT_EQ(reader.metrics()[2].version, 2);
  EXPECT_TRUE(reader.metrics()[2].is_measured);
  EXPECT_EQ(reader.metrics()[0].population, Population::finished);
  EXPECT_EQ(reader.metrics()[1].better, Better::more);
  EXPECT_EQ(reader.read_trial(trial.key)->record.samples.size(), 20U);
}

TEST(Database, AFinishedDatabaseIsOneFile) {
  const TemporaryFolder folder;
  { begun(folder / "r.db").add_trial(trial_row("a", 0, 0, Outcome::reached_goal)); }
  { EXPECT_EQ(Database::open_for_reading(folder / "r.db").finished_keys().size(), 1U); }
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Database, AddingTwiceChangesNothing) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  EXPECT_EQ(db.add_sweep(sweep_row()), 1);
  db.add_planner(planner_row("a"));
  db.add_map(map_row(0, 2), "forest");
  EXPECT_EQ(number(db, "SELECT count(*) FROM sweeps"), 1);
  EXPECT_EQ(number(db, "SELECT count(*) FROM planners"), 2);
  EXPECT_EQ(number(db, "SELECT count(*) FROM maps"), 2);
  EXPECT_EQ(number(db, "SELECT count(*) FROM missions"), 4);
}

TEST(Database, AMapMayGainMissionsButNotChange) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db", 1);
  db.add_map(map_row(0, 5), "forest");
  EXPECT_EQ(db.read_map(map_row(0, 0).record.key)->record.missions.size(), 5U);
  EXPECT_EQ(message_of([&] { db.add_map(map_row(0, 2), "forest"); }), "");
  // Each number that a map's or mission's record holds.
  using Number = double& (*)(MapRecord&);
  const Number numbers[] = {
      [](MapRecord& map) -> double& { return map.traversability; },
      [](MapRecord& map) -> double& { return map.traversability_normalized_ratio; },
      [](MapRecord& map) -> double& { return map.relative_gap_size; },
      [](MapRecord& map) -> double& { return map.obstacle_density_1pm2; },
      [](MapRecord& map) -> double& { return map.free_volume_ratio; },
      [](MapRecord& map) -> double& { return map.missions[1].mission.start_world.x(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.start_world.y(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.start_world.z(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.goal_world.x(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.goal_world.y(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.goal_world.z(); },
      [](MapRecord& map) -> double& { return map.missions[1].mission.start_yaw_rad; },
      [](MapRecord& map) -> double& { return map.missions[1].reference_length_m; },
      [](MapRecord& map) -> double& {
        return map.missions[1].difficulty.traversability_obstruction;
      },
      [](MapRecord& map) -> double& { return map.missions[1].difficulty.view_occlusion; },
      [](MapRecord& map) -> double& { return map.missions[1].difficulty.angle_over_length_1pm; }};
  const auto expect_refused = [&](const std::string& what, auto change) {
    MapRow other = map_row(0, 2);
    change(other.record);
    const std::string message = message_of([&] { db.add_map(other, "forest"); });
    EXPECT_TRUE(test::has(message, " is stored with other values")) << what << ": " << message;
  };
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    expect_refused("number " + std::to_string(i), [&](MapRecord& map) {
      double& number = numbers[i](map);
      number = std::isnan(number) ? 1.0 : std::nextafter(number, 1e9);
    });
  }
  expect_refused("world_digest", [](MapRecord& map) { map.world_digest[0] ^= 1; });
  expect_refused("obstacle_count", [](MapRecord& map) { ++map.obstacle_count; });
  expect_refused("triangle_count", [](MapRecord& map) { ++map.triangle_count; });
  expect_refused("is_valid", [](MapRecord& map) { map.missions[1].is_valid = false; });
  expect_refused("reason", [](MapRecord& map) { map.missions[1].invalid_reason = "none"; });
}

TEST(Database, AFurtherAttemptReplacesTheTrial) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  TrialRow first = trial_row("a", 0, 0, Outcome::collided);
  first.wall_time_s = 7.0;
  db.add_trial(first);
  TrialRow again = trial_row("a", 0, 0, Outcome::reached_goal);
  again.wall_time_s = 2.5;
  again.record.end_time_s = 3.5;
  again.spec_json = R"({"seed":2})";
  db.add_trial(again);
  const std::string key = trial_row("a", 0, 0, Outcome::collided).key;
  EXPECT_EQ(number(db, "SELECT attempt FROM trials"), 2);
  EXPECT_EQ(number(db, "SELECT count(*) FROM trajectories"), 1);
  EXPECT_EQ(number(db, "SELECT count(*) FROM events"), 0);
  EXPECT_EQ(db.read_trial(key)->record.outcome, Outcome::reached_goal);
  EXPECT_EQ(db.read_trial(key)->metrics[0], 4.0);
  EXPECT_EQ(db.read_trial(key)->wall_time_s, 2.5);
  EXPECT_EQ(db.read_trial(key)->record.end_time_s, 3.5);
  EXPECT_EQ(db.read_trial(key)->record.reason, "");
  EXPECT_EQ(db.read_trial(key)->spec_json, R"({"seed":2})");
}

TEST(Database, AChangedSweepIsARevisionThatTakesOverSharedTrials) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  const TrialRow first = trial_row("a", 0, 0, Outcome::reached_goal);
  const TrialRow second = trial_row("a", 0, 1, Outcome::reached_goal);
  db.add_trial(first);
  db.add_trial(second);
  EXPECT_EQ(db.add_sweep(sweep_row(R"({"trials":1})")), 2);
  db.add_map(map_row(0, 1), "forest");
  const std::vector<std::string> wanted{first.key, "of a trial that was never flown"};
  db.add_to_sweep("forest", wanted);

  EXPECT_EQ(db.read_sweep("forest", 1).trials.size(), 2U);
  const SweepResult result = db.read_sweep("forest", 2);
  ASSERT_EQ(result.trials.size(), 1U);
  EXPECT_EQ(result.trials[0].key, first.key);
  EXPECT_EQ(result.trials[0].reference_length_m, 40.0);
  EXPECT_EQ(result.trials[0].metrics[1], 100.0);
  ASSERT_EQ(result.maps.size(), 1U);
  EXPECT_EQ(result.maps[0].record.missions.size(), 1U);
  ASSERT_EQ(result.planners.size(), 1U);
  EXPECT_EQ(result.planners[0].label, "a");
  EXPECT_EQ(result.program_versions, std::vector<std::string>{"0.1.0 abcdef"});
  ASSERT_EQ(db.read_sweeps().size(), 2U);
  EXPECT_EQ(db.read_sweeps()[0].trial_count, 2);
  EXPECT_EQ(db.add_sweep(sweep_row()), 1);
}

TEST(Database, OneLabelOfTwoFilesIsTwoPlanners) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  PlannerRow rebuilt = planner_row("a");
  rebuilt.file_digest = key_of("rebuilt");
  db.add_planner(rebuilt);
  TrialRow trial = trial_row("a", 0, 1, Outcome::collided);
  trial.planner_file_digest = rebuilt.file_digest;
  db.add_trial(trial);
  EXPECT_EQ(db.read_sweep("forest", 1).planners.size(), 2U);
  EXPECT_EQ(number(db, "SELECT count(*) FROM planner_summary"), 2);
}

TEST(Database, RowsAreTheSameInAnyOrderOfInsertion) {
  const TemporaryFolder folder;
  std::vector<TrialRow> trials;
  for (const char* label : {"a", "b"}) {
    for (int map = 0; map < 2; ++map) {
      for (int mission = 0; mission < 2; ++mission) {
        trials.push_back(trial_row(label, map, mission,
                                   map == mission ? Outcome::collided : Outcome::reached_goal));
      }
    }
  }
  Database forward = begun(folder / "forward.db");
  for (const TrialRow& trial : trials) forward.add_trial(trial);

  Database backward = Database::open_for_run(folder / "backward.db", kMetrics);
  RunRow run = run_row();
  run.host = "another";
  backward.add_run(run);
  backward.add_sweep(sweep_row());
  backward.add_planner(planner_row("b"));
  backward.add_planner(planner_row("a"));
  for (const int i : {1, 0}) backward.add_map(map_row(i, 2), "forest");
  for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial) {
    TrialRow measured_anew = *trial;
    measured_anew.metrics[2] *= 1.5;  // what the host measures may differ
    measured_anew.record.plan_calls[0].cpu_time_s *= 1.5;
    backward.add_trial(measured_anew);
  }
  EXPECT_EQ(canonical_rows(forward), canonical_rows(backward));

  // One bit of one sample shows.
  TrialRow changed = trials[0];
  changed.record.samples[3].position_world.x() =
      std::nextafter(changed.record.samples[3].position_world.x(), 9.0);
  backward.add_trial(changed);
  EXPECT_NE(canonical_rows(forward), canonical_rows(backward));
}

TEST(Database, EveryTableSaysWhatItIs) {
  const TemporaryFolder folder;
  const Database db = begun(folder / "r.db");
  Statement s(db.handle(), db.path(),
              "SELECT name, sql FROM sqlite_schema WHERE type IN ('table', 'view')");
  int count = 0;
  while (s.step()) {
    EXPECT_NE(s.text(1).find("\n  -- "), std::string::npos) << s.text(0);
    ++count;
  }
  EXPECT_EQ(count, 20);
  EXPECT_EQ(number(db,
                   "SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND NOT strict "
                   "AND name NOT LIKE 'sqlite_%'"),
            0);
  EXPECT_EQ(number(db, "SELECT count(*) FROM pragma_foreign_key_check"), 0);
}

TEST(Database, ViewsAnswerPeoplesQuestions) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  db.add_trial(trial_row("a", 0, 1, Outcome::collided));
  db.add_trial(trial_row("b", 1, 0, Outcome::reached_goal));
  EXPECT_EQ(number(db, "SELECT count(*) FROM trial_table"), 3);
  EXPECT_EQ(
      number(db, "SELECT path_optimality_pct FROM trial_table WHERE is_finished AND planner = 'a'"),
      4.0);
  EXPECT_EQ(number(db, "SELECT success_rate FROM planner_summary WHERE planner = 'a'"), 0.5);
  EXPECT_EQ(number(db, "SELECT mean_path_optimality_pct FROM planner_summary WHERE planner = 'a'"),
            4.0);
  EXPECT_EQ(number(db, "SELECT mission_count FROM map_summary WHERE success_rate = 0.5"), 2);
  EXPECT_EQ(number(db, "SELECT count(*) FROM plan_call_table"), 15);
  EXPECT_EQ(number(db, "SELECT count(*) FROM plan_call_table WHERE status = 1"), 3);
  EXPECT_EQ(word(db, "SELECT obstacle_kind FROM events"), "tree");
}

TEST(Database, LatestTrialsHasNoFormerRevision) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  db.add_trial(trial_row("a", 0, 1, Outcome::collided));
  db.add_sweep(sweep_row(R"({"trials":3})"));
  const std::vector<std::string> shared{trial_row("a", 0, 0, Outcome::reached_goal).key};
  db.add_to_sweep("forest", shared);
  EXPECT_EQ(number(db, "SELECT count(*) FROM trial_table"), 3);
  EXPECT_EQ(number(db, "SELECT count(*) FROM latest_trials"), 1);
  EXPECT_EQ(number(db, "SELECT avg(is_finished) FROM latest_trials"), 1.0);
  EXPECT_EQ(number(db, "SELECT revision FROM latest_trials"), 2);
  EXPECT_EQ(db.list_trials("forest", 1).size(), 2U);
  EXPECT_EQ(db.list_trials("forest", 2).size(), 1U);
  EXPECT_EQ(db.read_sweep("forest", 1).latest_revision, 2);
}

TEST(Database, AMetricOfANewerProgramBecomesAColumn) {
  const TemporaryFolder folder;
  {
    Database db = begun(folder / "r.db");
    db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  }
  std::vector<MetricDef> metrics(std::begin(kMetrics), std::end(kMetrics));
  MetricDef added = kMetrics[1];
  added.name = "min_clearance_m";
  metrics.insert(metrics.begin(), added);
  Database db = Database::open_for_run(folder / "r.db", metrics);
  const TrialRow old = trial_row("a", 0, 0, Outcome::reached_goal);
  const std::vector<double> values = db.read_trial(old.key)->metrics;
  ASSERT_EQ(values.size(), 4U);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 4.0);
  EXPECT_EQ(number(db, "SELECT count(min_clearance_m) FROM trial_table"), 0);
  EXPECT_EQ(Database::open_for_reading(folder / "r.db").metrics()[0].name, "min_clearance_m");
}

/// What some specs lack is NULL for their trials.
TEST(Database, AFieldIsThereWhereOneTrialHasIt) {
  const TemporaryFolder folder;
  Database db = begun(folder / "s.db");
  TrialRow with = finished();
  with.spec_json = R"({"seed":1,"mission":{"far_m":2.5}})";
  db.add_trial(with);
  db.add_trial(collided());
  const SweepResult result = db.read_sweep("forest", 1, {"mission.far_m"});
  ASSERT_EQ(result.trials.size(), 2U);
  int found = 0;
  for (const TrialSummary& trial : result.trials) {
    const bool is_with = trial.key == with.key;
    EXPECT_EQ(std::holds_alternative<std::monostate>(trial.fields.at(0)), !is_with);
    if (is_with) found += std::get<double>(trial.fields.at(0)) == 2.5;
  }
  EXPECT_EQ(found, 1);
  EXPECT_THROW(db.read_sweep("forest", 1, {"mission.fra_m"}), InputError);
}

}  // namespace
}  // namespace avoidbench
