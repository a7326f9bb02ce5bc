#include "store/row_digest.hpp"

#include <gtest/gtest.h>

#include "store/merge.hpp"
#include "store/run_sql.hpp"
#include "store/statement.hpp"
#include "store/trial_table.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;
using test::has;
using test::message_of;
using test::run_sql;

/// A file with two trials, made once; copied and changed by `sql`.
std::filesystem::path changed_file(const TemporaryFolder& folder, const std::string& sql) {
  static const TemporaryFolder samples;
  if (!std::filesystem::exists(samples / "s.db")) {
    Database db = begun(samples / "s.db");
    db.add_trial(finished());
    db.add_trial(collided());
  }
  copy_file(samples / "s.db", folder / "s.db", std::filesystem::copy_options::overwrite_existing);
  run_sql(folder / "s.db", sql);
  return folder / "s.db";
}

std::string message_of_check(const std::filesystem::path& file, bool flights) {
  return message_of([&] { check_digests(Database::open_for_reading(file), flights); });
}

TEST(RowDigest, ShowsEveryChangeOfATrial) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of_check(changed_file(folder, ""), true), "");
  for (const std::string change :
       {"map_key = (SELECT max(map_key) FROM maps)", "mission_index = 1 - mission_index",
        "planner_key = (SELECT max(planner_key) FROM planners)", "outcome = 'timed_out'",
        "reason = reason || ' '", "end_time_s = end_time_s + 1e-9", "end_time_s = NULL",
        "spec_json = '{\"seed\":2}'", "wall_time_s = 1.0", "path_optimality_pct = 1.0",
        "mission_progress_pct = NULL", "processing_time_ms = 3.4", "flight_digest = NULL",
        "row_digest = 'x'"}) {
    std::string file = changed_file(folder, "UPDATE trials SET " + change).string();
    // Two planners or maps in order: the greater one may be the one that stands there.
    if (message_of_check(file, false) == "" && has(change, "max(")) {
      std::string other = change;
      other.replace(other.find("max"), 3, "min");
      file = changed_file(folder, "UPDATE trials SET " + other).string();
    }
    EXPECT_TRUE(has(message_of_check(file, false), "s.db: damaged: table trials, row ")) << change;
  }
  EXPECT_EQ(message_of_check(changed_file(folder, "UPDATE trials SET attempt = 7"), true), "");
}

TEST(TrialReader, ReadsOnAfterADamagedTrial) {
  const TemporaryFolder folder;
  const std::string file = changed_file(
      folder, "UPDATE trajectories SET samples = x'00' WHERE trial_key = '" + collided().key + "'");
  const Database db = Database::open_for_reading(file);
  TrialReader reader(db);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_TRUE(has(message_of([&] { reader.read(collided().key); }), "can't be unpacked"));
    EXPECT_FALSE(reader.read("no such key").has_value());
    const std::optional<TrialRow> row = reader.read(finished().key);
    ASSERT_TRUE(row.has_value());
    EXPECT_EQ(row->record.samples.size(), finished().record.samples.size());
    EXPECT_EQ(row->record.plan_calls.size(), finished().record.plan_calls.size());
  }
}

TEST(RowDigest, NamesTheTrial) {
  const TemporaryFolder folder;
  const std::string file =
      changed_file(folder, "UPDATE trials SET outcome = 'reached_goal' WHERE outcome = 'collided'");
  const std::string row = "damaged: table trials, row " + collided().key.substr(0, 12) + ": ";
  EXPECT_TRUE(has(message_of_check(file, false), row));
  const Database db = Database::open_for_reading(file);
  EXPECT_TRUE(has(message_of([&] { db.read_trial(collided().key); }), row));
  EXPECT_EQ(message_of([&] { db.read_trial(finished().key); }), "");
  Database into = begun(folder / "into.db");
  EXPECT_TRUE(has(message_of([&] { merge_database(into, file); }), row));
  EXPECT_TRUE(into.finished_keys().empty());
}

TEST(RowDigest, ShowsEveryChangeBesideTheTrial) {
  const TemporaryFolder folder;
  for (const std::string change :
       {"UPDATE events SET speed_mps = 9.0", "UPDATE events SET obstacle_index = 1",
        "UPDATE events SET obstacle_kind = 'rock'", "UPDATE events SET time_s = 1.0",
        "DELETE FROM events", "DELETE FROM trajectories", "DELETE FROM plan_calls",
        "UPDATE trajectories SET samples_digest = upper(samples_digest)",
        "UPDATE trajectories SET sample_count = 2", "UPDATE plan_calls SET call_count = 2",
        "UPDATE plan_calls SET calls_digest = 'x'",
        "INSERT INTO events SELECT trial_key, 1, kind, time_s, speed_mps, obstacle_index, "
        "obstacle_kind FROM events"}) {
    const std::string file = changed_file(folder, change);
    EXPECT_TRUE(has(message_of_check(file, true), "damaged: table trials, row ")) << change;
    EXPECT_EQ(message_of_check(file, false), "") << change;
    const Database db = Database::open_for_reading(file);
    EXPECT_TRUE(has(message_of([&] { db.read_trial(collided().key); }), "damaged: ")) << change;
  }
}

TEST(RowDigest, SamplesAndCallsAreCheckedWhenRead) {
  const TemporaryFolder folder;
  for (const auto& [change, table] :
       {std::pair<std::string, std::string>{
            "UPDATE trajectories SET samples = (SELECT x.samples FROM trajectories x WHERE "
            "x.trial_key <> trajectories.trial_key) WHERE trial_key = (SELECT trial_key FROM "
            "trials WHERE outcome = 'collided')",
            "trajectories"},
        {"UPDATE trajectories SET samples = zeroblob(3520)", "trajectories"},
        {"UPDATE trajectories SET samples = zeroblob(40)", "trajectories"},
        {"UPDATE plan_calls SET calls_json = replace(calls_json, ',8', ',4')", "plan_calls"},
        {"UPDATE plan_calls SET calls_json = '[]'", "plan_calls"}}) {
    const Database db = Database::open_for_reading(changed_file(folder, change));
    EXPECT_TRUE(has(message_of([&] { db.read_trial(collided().key); }),
                    "damaged: table " + table + ", row "))
        << change;
  }
}

TEST(RowDigest, OneThatWasTakenOutIsDamage) {
  const TemporaryFolder folder;
  for (const char* both : {"", ", flight_digest = NULL"}) {
    const std::string file =
        changed_file(folder, std::string("UPDATE trials SET row_digest = NULL") + both +
                                 ", reason = 'other' WHERE outcome = 'collided'");
    const std::string message = "row " + collided().key.substr(0, 12) + ": it has no row_digest";
    EXPECT_TRUE(has(message_of_check(file, false), message));
    const Database db = Database::open_for_reading(file);
    EXPECT_TRUE(has(message_of([&] { db.read_trial(collided().key); }), message));
    Database into = begun(folder / "into.db");
    EXPECT_TRUE(has(message_of([&] { merge_database(into, file); }), message));
    EXPECT_TRUE(into.finished_keys().empty());
  }
}

/// Of a flight and its calls the rows say the digests; the bytes themselves are looked at where
/// they are read, and where they go to another file.
TEST(RowDigest, MergeRefusesBytesThatAreNotTheDigests) {
  const TemporaryFolder folder;
  for (const auto& [change, table] :
       {std::pair<std::string, std::string>{
            "UPDATE trajectories SET samples = (SELECT x.samples FROM trajectories x WHERE "
            "x.trial_key <> trajectories.trial_key)",
            "trajectories"},
        {"UPDATE plan_calls SET calls_json = replace(calls_json, ',8', ',4')", "plan_calls"}}) {
    const std::string file = changed_file(folder, change);
    const std::string message = "s.db: damaged: table " + table + ", row ";
    EXPECT_EQ(message_of_check(file, true), "");
    Database into = begun(folder / "into.db");
    EXPECT_TRUE(has(message_of([&] { merge_database(into, file); }), message)) << change;
    EXPECT_TRUE(into.finished_keys().empty());
    const Database db = Database::open_for_reading(file);
    EXPECT_TRUE(has(message_of([&] { check_all(db); }), message)) << change;
  }
  EXPECT_EQ(check_all(Database::open_for_reading(changed_file(folder, ""))), 2);
}

TEST(RowDigest, LaterMetricsAndAttemptsKeepIt) {
  const TemporaryFolder folder;
  const std::filesystem::path file = changed_file(folder, "");
  std::vector<MetricDef> metrics(std::begin(kMetrics), std::end(kMetrics));
  MetricDef added = kMetrics[1];
  added.name = "a_new_metric";
  metrics.insert(metrics.begin(), added);
  {
    Database db = Database::open_for_run(file, metrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row());
    db.add_planner(planner_row("a"));
    TrialRow again = finished();
    again.record.reason = "flown anew";
    again.metrics.insert(again.metrics.begin(), 2.0);
    db.add_trial(again);
  }
  const Database db = Database::open_for_reading(file);
  check_digests(db, true);
  EXPECT_EQ(db.read_trial(finished().key)->record.reason, "flown anew");
}

TEST(RowDigest, MergeKeepsIt) {
  const TemporaryFolder folder;
  const std::filesystem::path file = changed_file(folder, "");
  {
    Database into = begun(folder / "into.db");
    into.add_run(run_row());  // so that numbers of runs change
    into.add_trial(trial_row("b", 1, 0, Outcome::collided));
    RunRow run = run_row();
    run.sandbox = "landlock 4, seccomp";
    into.add_run(run);
    EXPECT_EQ(merge_database(into, file).new_trials, 2);
  }
  {
    Database other = begun(folder / "other.db");
    EXPECT_EQ(merge_database(other, folder / "into.db").new_trials, 3);
  }
  const Database db = Database::open_for_reading(folder / "other.db");
  check_digests(db, true);
  Statement s(db.handle(), db.path(), "SELECT max(sandbox) FROM runs");
  s.step();
  EXPECT_EQ(s.text(0), "landlock 4, seccomp");
}

}  // namespace
}  // namespace avoidbench
