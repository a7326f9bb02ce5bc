#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "store/merge.hpp"
#include "store/row_digest.hpp"
#include "store/run_sql.hpp"
#include "store/stored_text.hpp"
#include "store/trial_table.hpp"
#include "support/canonical_rows.hpp"
#include "support/input_error_message.hpp"
#include "support/redigest.hpp"
#include "support/sample_rows.hpp"

/// Rows that the program never writes: found and named, whoever reads them.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::canonical_rows;
using test::has;
using test::run_sql;

constexpr const char* kTwoSeedsJson =
    R"({"trials":2,"planners":[{},{}],"axes":[{"path":"map_seed","values":[1,2]}]})";

/// A file whose digests fit, so that what is wrong in its rows is met by those who read them.
std::filesystem::path damaged_file(const TemporaryFolder& folder, const std::string& sql) {
  static const TemporaryFolder samples;
  if (!std::filesystem::exists(samples / "s.db")) {
    Database db = begun(samples / "s.db");
    db.add_sweep(sweep_row(kTwoSeedsJson));
    for (int map = 0; map < 2; ++map) db.add_map(map_row(map, 2), "forest");
    db.add_trial(finished());
    db.add_trial(collided());
  }
  std::filesystem::path file = folder / "s.db";
  copy_file(samples / "s.db", file, std::filesystem::copy_options::overwrite_existing);
  run_sql(file, "PRAGMA ignore_check_constraints = ON; " + sql);
  try {
    test::redigest(file);
  } catch (const InputError&) {  // SQLite writes no row that breaks its types
  }
  return file;
}

/// Reads all there is, by each of the ways that commands have.
void read_all(const std::filesystem::path& file) {
  const Database db = Database::open_for_reading(file);
  check_digests(db, true);
  db.finished_trials();
  db.read_planners();
  db.mean_costs();
  const std::vector<SweepInfo> sweeps = db.read_sweeps();
  for (const SweepInfo& sweep : sweeps) {
    const std::vector<std::string> paths = axis_paths(sweep.spec_json);
    visit_trials(db, sweep.name, sweep.revision, paths, [](const VisitedTrial&) {});
    db.read_sweep(sweep.name, sweep.revision, {"planner", "map.poisson_radius_m"});
    for (const MapFlights& flights : read_map_flights(db, sweep)) db.read_map(flights.map_key);
  }
  TrialTableReader rows(db, sweeps);
  while (rows.next()) {
  }
  for (const TrialListing& trial : db.list_trials()) db.read_trial(trial.key);
  canonical_rows(db);
  sweep_completeness(db);
}

std::string message_of_reading(const std::string& sql) {
  const TemporaryFolder folder;
  try {
    read_all(damaged_file(folder, sql));
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find((folder / "s.db: ").string()), 0U) << message;
    return message.substr((folder / "s.db: ").string().size());
  }
  return "";
}

TEST(DamagedRows, AnUnchangedFileIsRead) { EXPECT_EQ(message_of_reading("SELECT 1"), ""); }

TEST(DamagedRows, AreNamedByTableAndRow) {
  const std::string trial = "damaged: table trials, row ";
  const std::string mission = "damaged: table missions, row ";
  const std::string sweep = "damaged: table sweeps, row forest: ";
  for (const auto& [sql, expected] :
       {std::pair<std::string, std::string>{"UPDATE trials SET outcome = 'flew'", trial},
        {"UPDATE trials SET mission_index = -3", trial},
        {"UPDATE trials SET end_time_s = NULL", trial},
        {"UPDATE trials SET end_time_s = -1.0", trial},
        {"UPDATE trials SET end_time_s = 9e999", trial},
        {"DELETE FROM missions WHERE mission_index = 1", trial},
        {"UPDATE missions SET mission_index = mission_index - 5; UPDATE trials SET mission_index = "
         "mission_index - 5; UPDATE sweep_missions SET mission_index = mission_index - 5",
         mission},
        {"UPDATE missions SET mission_index = mission_index + 7; UPDATE trials SET mission_index = "
         "mission_index + 7; UPDATE sweep_missions SET mission_index = mission_index + 7",
         mission},
        {"UPDATE missions SET start_x_m = 9e999", mission},
        {"UPDATE missions SET goal_z_m = NULL", mission},
        {"UPDATE missions SET reference_length_m = -1", mission},
        {"UPDATE missions SET reference_length_m = 9e999", mission},
        {"UPDATE maps SET spec_json = '{'", "damaged: table maps, row "},
        {"UPDATE maps SET spec_json = '[]'", "damaged: table maps, row "},
        {"UPDATE maps SET obstacle_count = -1", "damaged: table maps, row "},
        {"UPDATE maps SET generator = CAST(x'ff' AS TEXT)", "damaged: table maps, row "},
        {"DELETE FROM maps", "its row in maps is not there"},
        {"DELETE FROM planners", "its row in planners is not there"},
        {"DELETE FROM runs", "its row in runs is not there"},
        {"DELETE FROM trials", "its row in trials is not there"},
        {"UPDATE planners SET name = 'x'", "damaged: table planners, row "},
        {"UPDATE planners SET parameters_json = 'x'", "damaged: table planners, row "},
        {"UPDATE sweeps SET spec_json = 'x'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"axes\":5}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"axes\":[{\"path\":\"a~b\",\"values\":[]}]}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"trials\":1e300}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"base\":5}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"base\":{\"latency\":\"x\"}}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"base\":{\"latency\":{\"ms\":\"x\"}}}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"base\":{\"rates\":{\"plan_hz\":[]}}}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"trials\":-1}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"trial_count\":4}'", sweep},
        {"UPDATE sweeps SET spec_json = '{\"trial_count\":4,\"planners\":[]}'", sweep},
        {"UPDATE trials SET spec_json = 'x'", "damaged: table trials, row "},
        {"UPDATE metric_definitions SET better = 'most'", "metric_definitions"},
        {"UPDATE plan_calls SET calls_json = '[[1,2]]'", "damaged: table plan_calls, row "},
        {"UPDATE plan_calls SET calls_json = '{\"a\":1}'", "damaged: table plan_calls, row "},
        {"UPDATE plan_calls SET calls_json = '[[0,0,0,\"x\",8]]'",
         "damaged: table plan_calls, row "},
        {"UPDATE plan_calls SET calls_json = '[[1e999,0,0,0,8]]'",
         "damaged: table plan_calls, row "},
        {"UPDATE plan_calls SET call_count = -1", "damaged: table plan_calls, row "},
        {"UPDATE trajectories SET sample_count = 9223372036854775807", "table trajectories, row "},
        {"UPDATE trials SET spec_json = "
         "'{\"mission\":{\"time_limit_s\":0.25},\"rates\":{\"sample_hz\":10}}'",
         "it has 20 samples; the trial's time limit and sample rate allow 17"},
        // 0.26 s at 10 Hz and at the 50 Hz of jerks: 15.6 samples, and one at each end.
        {"UPDATE trials SET spec_json = "
         "'{\"mission\":{\"time_limit_s\":0.26},\"rates\":{\"sample_hz\":10}}'",
         "it has 20 samples; the trial's time limit and sample rate allow 18"},
        {"UPDATE trajectories SET sample_count = -1", "damaged: table trajectories, row "},
        {"UPDATE trajectories SET samples = x'00'", "damaged: table trajectories, row "}}) {
    const std::string message = message_of_reading(sql);
    EXPECT_TRUE(has(message, expected)) << sql << ": " << message;
  }
}

TEST(DamagedRows, ValuesOfOtherTypesAreNamed) {
  // As SQLite lets nobody write it into a STRICT table, only what writes pages can.
  const auto with_type = [](const std::string& table, const std::string& sql) {
    return "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(replace(sql, ') "
           "STRICT, W', ') /*S*/ W'), ') STRICT', ') /*S*/') WHERE name = '" +
           table + "'; PRAGMA writable_schema = RESET; " + sql +
           "; PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(replace(sql, ') "
           "/*S*/ W', ') STRICT, W'), ') /*S*/', ') STRICT') WHERE name = '" +
           table + "'";
  };
  EXPECT_TRUE(has(message_of_reading(with_type("events", "UPDATE events SET time_s = 'noon'")),
                  "damaged: table events, row "));
  EXPECT_TRUE(
      has(message_of_reading(with_type("plan_calls", "UPDATE plan_calls SET call_count = 'x'")),
          "damaged: table plan_calls, row "));
  EXPECT_TRUE(has(message_of_reading(with_type("trials", "UPDATE trials SET end_time_s = 'x'")),
                  "damaged"));
}

TEST(DamagedRows, WordsOfPeopleAndPlannersAreReadInAnyBytes) {
  const TemporaryFolder folder;
  const std::filesystem::path file =
      damaged_file(folder,
                   "UPDATE trials SET reason = CAST(x'6100ff62' AS TEXT); UPDATE runs SET host = "
                   "CAST(x'ff' AS TEXT)");
  EXPECT_NO_THROW(read_all(file));
  const Database db = Database::open_for_reading(file);
  EXPECT_EQ(db.read_trial(collided().key)->record.reason, std::string("a\0\uFFFDb", 6));
}

TEST(DamagedRows, WhatIsNoUtf8IsReplacedBeforeItIsStored) {
  const TemporaryFolder folder;
  {
    Database db = begun(folder / "r.db");
    PlannerRow planner = planner_row("a");
    planner.name = "na\xefme";
    planner.label = "\xff";
    db.add_planner(planner);
    TrialRow row = collided();
    row.planner_label = planner.label;
    row.record.reason = "\xc3(";
    row.record.collisions[0].kind = "\xed\xa0\x80";
    db.add_trial(row);
  }
  const Database db = Database::open_for_reading(folder / "r.db");
  check_digests(db, true);
  EXPECT_EQ(db.read_trial(collided().key)->record.reason, "\uFFFD(");
  EXPECT_EQ(db.read_trial(collided().key)->planner_label, "\uFFFD");
}

TEST(StoredText, Utf8) {
  for (const char* good : {"", "a", "é", "€", "😀", "\xf4\x8f\xbf\xbf"}) EXPECT_TRUE(is_utf8(good));
  for (const char* bad : {"\x80", "\xc0\xaf", "\xc3", "\xe2\x82", "\xed\xa0\x80",
                          "\xf5\x80\x80\x80", "\xf4\x90\x80\x80", "\xff", "a\xe0\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bad)) << bad;
    EXPECT_TRUE(is_utf8(as_utf8(bad)));
  }
}

TEST(StoredText, NestedTooDeepIsNoObject) {
  std::string deep = "{\"a\":";
  for (int i = 0; i < 70; ++i) deep += "[";
  for (int i = 0; i < 70; ++i) deep += "]";
  EXPECT_THROW(stored_object(deep + "}"), BadText);
  // Many that stand beside each other are not deep, nor is a long text.
  std::string flat = "{\"a\":[0";
  for (int i = 0; i < 200; ++i) flat += ",[],{}";
  EXPECT_EQ(stored_object(flat + "],\"text\":\"" + std::string(300, 'x') + "\"}").at("a").size(),
            401U);
  EXPECT_NO_THROW(
      stored_object("{\"a\":\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["
                    "[[[[[[\\\"[\"}"));
}

}  // namespace
}  // namespace avoidbench
