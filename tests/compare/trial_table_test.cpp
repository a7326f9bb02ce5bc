#include "compare/trial_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/input_error.hpp"
#include "compare/compare.hpp"
#include "compare/compare_samples.hpp"
#include "store/trial_table.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;

constexpr const char* kSpec = R"({"axes":[{"path":"map.poisson_radius_m","values":[2.5,3]},)"
                              R"({"path":"sensor.cameras.0.fov_x_deg","values":[60,90]}]})";

/// A database whose sweep has a map axis and one of trials, with planners a and b on two maps.
Database two_axes(const std::filesystem::path& path) {
  Database db = Database::open_for_run(path, kMetrics);
  db.add_run(run_row());
  db.add_sweep(sweep_row(kSpec));
  for (int i = 0; i < 2; ++i) db.add_map(map_row(i, 2), "forest");
  for (const char* label : {"a", "b"}) {
    db.add_planner(planner_row(label));
    for (int map = 0; map < 2; ++map) {
      for (const char* fov : {"60", "90"}) {
        TrialRow row = trial_row(label, map, 0, Outcome::reached_goal);
        row.key = key_of(row.key + fov);
        row.spec_json = std::string(R"({"sensor":{"cameras":[{"fov_x_deg":)") + fov + "}]}}";
        row.metrics[0] = fov == std::string("60") ? 1.0 / 3.0 : 0.1;
        db.add_trial(row);
      }
    }
  }
  return db;
}

TrialTable table_of(const Database& db) {
  const SweepInfo sweep = db.read_sweeps().back();
  return table_of_sweep(db, sweep, axis_paths(sweep.spec_json));
}

TEST(TrialTable, TrialsAreToldApartByAxes) {
  const TemporaryFolder folder;
  const TrialTable table = table_of(two_axes(folder / "r.db"));
  ASSERT_EQ(table.trials.size(), 8U);
  EXPECT_EQ(table.trials[0].identity.planner, "a");
  EXPECT_EQ(table.trials[0].identity.generator, "forest");
  EXPECT_EQ(table.trials[0].identity.setting, "poisson_radius_m=3.0 sensor.cameras.0.fov_x_deg=60");
  EXPECT_EQ(table.trials[1].identity.setting, "poisson_radius_m=3.0 sensor.cameras.0.fov_x_deg=90");
  EXPECT_NE(table.trials[0].map, table.trials[2].map);
  EXPECT_EQ(table.trials[0].mission, table.trials[1].mission);
  EXPECT_NE(table.trials[0].mission, table.trials[2].mission);
}

TEST(TrialTable, CsvKeepsEveryBit) {
  const TemporaryFolder folder;
  TrialTable table = table_of(two_axes(folder / "r.db"));
  table.trials[0].metrics[1] = -0.0;
  table.trials[1].metrics[0] = std::numeric_limits<double>::quiet_NaN();
  table.trials[2].metrics[0] = std::numeric_limits<double>::denorm_min();
  table.trials[3].identity.planner = "a, \"quoted\"";
  table.trials[2].identity.planner = "=a formula";
  compare_samples::sort(table);
  const std::string csv = csv_of_table(table);
  const TrialTable read = table_of_csv(csv, "t.csv");
  EXPECT_EQ(csv_of_table(read), csv);
  EXPECT_EQ(read.sweep, "forest");
  EXPECT_EQ(read.axes, table.axes);
  ASSERT_EQ(read.metrics.size(), 2U);  // the measured one is left out
  const ExactComparison comparison = compare_exactly(read, table);
  EXPECT_EQ(comparison.equal_count, 8);
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_EQ(comparison.metrics.size(), 2U);
  EXPECT_EQ(comparison.flight_count, 8);
}

TEST(TrialTable, ReadsTablesWithoutFlights) {
  const std::string metric = "# metric,path_length_m,1,m,neither,all\r\n";
  const std::string columns =
      "planner,generator,map_seed,setting,mission_index,map,mission,outcome";
  const std::string trial = "a,forest,1,,0,00000000000000aa,00000000000000bb,collided";
  const TrialTable table =
      table_of_csv("# avoidbench trials, format 1: as it wrote it\r\n" + metric + columns +
                       ",path_length_m\r\n" + trial + ",2.5\r\n",
                   "t.csv");
  EXPECT_EQ(table.trials.at(0).flight, 0U);
  EXPECT_EQ(table.trials.at(0).metrics.at(0), 2.5);
  const std::string error = test::message_of([&] {
    table_of_csv("# avoidbench trials, format 2: as it wrote it\r\n" + metric + columns +
                     ",path_length_m\r\n" + trial + ",2.5\r\n",
                 "t.csv");
  });
  EXPECT_NE(error.find("the columns are not those of this format"), std::string::npos) << error;
}

TEST(TrialTable, CsvKeepsEveryTrialWhateverItsLabel) {
  TrialTable table = compare_samples::empty_table("t.csv");
  for (const char* label : {"#1", "#", "# metric,x,1,m,less,all", "# axes: seed", "a\nb", "a\r\nb",
                            "a\r", "\n", "\"", "\n#1,\"", "'#1", "a#1", ""}) {
    for (int mission = 0; mission < 2; ++mission) {
      table.trials.push_back(compare_samples::trial(label, 0, mission, true));
      table.trials.back().identity.setting = "note=x\ny";
    }
  }
  compare_samples::sort(table);
  const std::string csv = csv_of_table(table);
  const TrialTable read = table_of_csv(csv, "t.csv");
  ASSERT_EQ(read.trials.size(), table.trials.size());
  EXPECT_EQ(csv_of_table(read), csv);
  for (std::size_t i = 0; i < read.trials.size(); ++i) {
    EXPECT_EQ(read.trials[i].identity.planner, table.trials[i].identity.planner);
    EXPECT_EQ(read.trials[i].identity.setting, "note=x\ny");
  }
  // Lines are counted on through fields of several.
  EXPECT_NE(test::message_of([&] { table_of_csv(csv + "x\r\n", "t.csv"); })
                .find("t.csv:" + std::to_string(1 + std::count(csv.begin(), csv.end(), '\n')) +
                      ": 1 fields instead of"),
            std::string::npos);
  EXPECT_NE(test::message_of([&] {
              table_of_csv(csv + "\"x\r\n", "t.csv");
            }).find("a quote is not closed"),
            std::string::npos);
}

TEST(TrialTable, DamagedCsvIsToldWithItsLine) {
  const TemporaryFolder folder;
  const std::string csv = csv_of_table(table_of(two_axes(folder / "r.db")));
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string changed = csv;
    changed.replace(changed.find(from), from.size(), to);
    return test::message_of([&] { table_of_csv(changed, "t.csv"); });
  };
  EXPECT_EQ(
      error_with("# avoidbench trials, format 2", "planner"),
      "t.csv: is neither a database of results nor a table of trials that `avoidbench compare` "
      "wrote");
  EXPECT_EQ(error_with("format 2", "format 3"),
            "t.csv:1: a table of another format than 1 and 2: a newer avoidbench wrote it");
  EXPECT_NE(error_with("reached_goal", "reached_gaol").find("t.csv:7: outcome: 'reached_gaol'"),
            std::string::npos)
      << error_with("reached_goal", "reached_gaol");
  EXPECT_NE(error_with("0.1,", "0.1x,").find("'0.1x' is not a valid number"), std::string::npos);
  EXPECT_NE(error_with(",outcome,", ",result,").find("columns"), std::string::npos);
  EXPECT_NE(error_with("%,less", "%,fewer").find("t.csv:4: a metric is"), std::string::npos);
  EXPECT_NE(test::message_of([&] {
              table_of_csv(csv + csv.substr(csv.rfind('\n', csv.size() - 2) + 1), "t.csv");
            }).find("is listed twice"),
            std::string::npos);
  EXPECT_NE(test::message_of([&] {
              table_of_csv(csv.substr(0, csv.find("\na,")), "t.csv");
            }).find("has no trials"),
            std::string::npos);
}

TEST(TrialTable, TwoPlannersOfOneLabelAreRefused) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  PlannerRow other = planner_row("a");
  other.file_digest = key_of("another file");
  db.add_planner(other);
  TrialRow row = trial_row("a", 0, 0, Outcome::collided);
  row.key = key_of("another trial");
  row.planner_file_digest = other.file_digest;
  db.add_trial(row);
  EXPECT_NE(test::message_of([&] { table_of(db); }).find("two trials of a on forest"),
            std::string::npos);
}

TEST(ReadTables, AnAxisOfOneSideTellsTrialsApartInBoth) {
  const TemporaryFolder folder;
  two_axes(folder / "new.db");
  {
    // The base flew one field of view only, so that it is no axis there.
    Database db = Database::open_for_run(folder / "base.db", kMetrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row(R"({"axes":[]})"));
    db.add_map(map_row(0, 2), "forest");
    db.add_planner(planner_row("a"));
    TrialRow row = trial_row("a", 0, 0, Outcome::reached_goal);
    row.spec_json = R"({"sensor":{"cameras":[{"fov_x_deg":90}]}})";
    db.add_trial(row);
  }
  const TablePair tables = read_tables(folder / "base.db", folder / "new.db", "");
  const auto pairs = paired_trials(tables.base, tables.now);
  EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(),
                          [](const TrialPair& pair) { return pair.is_whole(); }),
            1);
  EXPECT_EQ(tables.base.trials[0].identity.setting,
            "poisson_radius_m=2.5 sensor.cameras.0.fov_x_deg=90");
}

TEST(ReadTables, SweepsAreChosenByName) {
  const TemporaryFolder folder;
  {
    Database db = begun(folder / "r.db");
    db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
    db.add_sweep(sweep_row(R"({"trials":3})"));  // revision 2
    db.add_map(map_row(0, 2), "forest");
    db.add_trial(trial_row("b", 0, 0, Outcome::collided));
    db.add_sweep({.name = "hall", .spec_json = "{}"});
    db.add_map(map_row(1, 2), "hall");
    TrialRow row = trial_row("b", 1, 1, Outcome::collided);
    row.sweep = "hall";
    db.add_trial(row);
  }
  const std::filesystem::path file = folder / "r.db";
  EXPECT_NE(test::message_of([&] { read_tables(file, file, ""); }).find("which sweep?"),
            std::string::npos);
  EXPECT_NE(
      test::message_of([&] { read_tables(file, file, "forst"); }).find("did you mean forest?"),
      std::string::npos);
  const TablePair tables = read_tables(file, file, "forest@1:forest");
  EXPECT_EQ(tables.base.trials[0].identity.planner, "a");
  EXPECT_EQ(tables.now.trials[0].identity.planner, "b");
  EXPECT_EQ(tables.now.sweep, "forest@2");
  EXPECT_EQ(read_table(file, "hall").trials.size(), 1U);
  std::ofstream(folder / "t.csv") << csv_of_table(read_table(file, "hall"));
  EXPECT_EQ(read_tables(folder / "t.csv", file, "").now.sweep, "hall");
  EXPECT_NE(test::message_of([&] {
              read_tables(folder / "t.csv", file, "forest");
            }).find("is a table of sweep hall, not of forest"),
            std::string::npos);
}

TEST(TablePair, TwoPlannersOfOneTableArePairedByTheirMissions) {
  using namespace compare_samples;
  TrialTable both = finished_table("r.db", 3, 4, "ego");
  for (const TableTrial& one : finished_table("", 3, 4, "mine").trials) both.trials.push_back(one);
  for (const TableTrial& one : finished_table("", 3, 4, "a:b").trials) both.trials.push_back(one);
  compare_samples::sort(both);
  const TablePair pair = of_planners({.base = both, .now = both}, "ego:mine");
  EXPECT_EQ(pair.base.trials.size(), 12U);
  EXPECT_EQ(paired_trials(pair.base, pair.now).size(), 12U);
  EXPECT_EQ(pair.base.trials[0].identity.planner, "ego → mine");
  EXPECT_EQ(pair.now.source, "mine of r.db");
  // One planner alone, and labels with a colon of their own.
  const TablePair alone = of_planners({.base = both, .now = both}, "a:b");
  EXPECT_EQ(alone.now.trials.size(), 12U);
  EXPECT_EQ(alone.now.trials[0].identity.planner, "a:b");
  EXPECT_EQ(of_planners({.base = both, .now = both}, "a:b:ego").now.source, "ego of r.db");
  EXPECT_NE(test::message_of([&] {
              of_planners({.base = both, .now = both}, "ego:min");
            }).find("min: r.db has no such planner (did you mean mine?)"),
            std::string::npos);
}

}  // namespace
}  // namespace avoidbench
