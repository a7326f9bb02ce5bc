#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/input_error.hpp"
#include "export/export_flight.hpp"
#include "export/export_trials.hpp"
#include "report/parsed_csv.hpp"
#include "report/selection.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;

std::string exported(std::span<const Database> databases, const std::string& sweep,
                     TrialFormat format) {
  std::string text;
  export_trials(databases, sweep, format, [&](const std::string& line) { text += line; });
  return text;
}

/// A value of a row by its column's name.
std::string field(const std::vector<std::vector<std::string>>& rows, std::size_t row,
                  const std::string& column) {
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    if (rows.front()[i] == column) return rows.at(row).at(i);
  }
  ADD_FAILURE() << "no column " << column;
  return {};
}

std::vector<Database> one(Database database) {
  std::vector<Database> all;
  all.push_back(std::move(database));
  return all;
}

Database filled(const std::filesystem::path& path) {
  Database db = begun(path);
  for (const char* label : {"b", "a"}) {
    for (int map = 0; map < 2; ++map) {
      db.add_trial(trial_row(label, map, 0, Outcome::reached_goal));
      db.add_trial(trial_row(label, map, 1, Outcome::collided));
    }
  }
  return db;
}

TEST(ExportTrials, EveryTrialIsALineThatReadsBack) {
  const TemporaryFolder folder;
  const std::vector<Database> db = one(filled(folder / "r.db"));
  const auto rows = parsed_csv(exported(db, "", TrialFormat::csv));
  ASSERT_EQ(rows.size(), 9U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const int map = field(rows, i, "map_key") == key_of("map 0") ? 0 : 1;
    const int mission = std::atoi(field(rows, i, "mission_index").c_str());
    const bool is_finished = mission == 0;
    const TrialRow truth = trial_row(field(rows, i, "planner"), map, mission,
                                     is_finished ? Outcome::reached_goal : Outcome::collided);
    EXPECT_EQ(field(rows, i, "trial_key"), truth.key);
    EXPECT_EQ(field(rows, i, "reason"), truth.record.reason);  // with quotes and a line break
    EXPECT_EQ(field(rows, i, "map_seed"), std::to_string(map_row(map, 2).map_seed));
    EXPECT_EQ(field(rows, i, "path_optimality_pct"), is_finished ? "4" : "");
    EXPECT_EQ(field(rows, i, "relative_gap_size"), "");
    const double ratio = map_row(map, 2).record.traversability_normalized_ratio;
    EXPECT_EQ(std::strtod(field(rows, i, "traversability_normalized_ratio").c_str(), nullptr),
              ratio);
  }
  EXPECT_EQ(field(rows, 1, "planner"), "a");
  EXPECT_EQ(field(rows, 5, "planner"), "b");
}

TEST(ExportTrials, HasIdsStartsGoalsAndAxesAndTheWorstFirst) {
  const TemporaryFolder folder;
  Database database = begun(folder / "r.db");
  database.add_sweep(sweep_row(R"({"axes":[{"path":"map.poisson_radius_m","values":[2]},)"
                               R"({"path":"sensor.cameras.0.fov_x_deg","values":[60,90]}]})"));
  for (int map = 0; map < 2; ++map) {
    database.add_map(map_row(map, 2), "forest");
    TrialRow row = trial_row("a", map, 0, Outcome::reached_goal);
    row.spec_json =
        R"({"sensor":{"cameras":[{"fov_x_deg":)" + std::to_string(60 + 30 * map) + "}]}}";
    row.metrics[0] = 1.0 + map;
    database.add_trial(row);
  }
  const std::vector<Database> db = one(std::move(database));
  std::string text;
  export_trials(db, "", TrialFormat::csv, [&](const std::string& line) { text += line; },
                {.field = std::string(kMetrics[0].name), .limit = 5});
  const auto rows = parsed_csv(text);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(field(rows, 1, "sensor.cameras.0.fov_x_deg"), "90");  // less is better: the worse one
  EXPECT_EQ(field(rows, 2, "sensor.cameras.0.fov_x_deg"), "60");
  EXPECT_EQ(field(rows, 2, "trial_id"), "1");
  const Mission mission = map_row(0, 2).record.missions[0].mission;
  EXPECT_EQ(std::strtod(field(rows, 2, "goal_x_m").c_str(), nullptr), mission.goal_world.x());
  EXPECT_EQ(field(rows, 1, "map.poisson_radius_m"), "3");
  EXPECT_EQ(field(rows, 2, "map.poisson_radius_m"), "2.5");
}

TEST(ExportTrials, FilesOfOtherAxesStandInOneTable) {
  const TemporaryFolder folder;
  std::vector<Database> files;
  for (const std::string path : {"wind.speed_mps", "planner.gain"}) {
    Database& db = files.emplace_back(begun(folder / (path + ".db")));
    db.add_sweep(sweep_row(R"({"axes":[{"path":")" + path + R"(","values":[1,2]}]})"));
    db.add_map(map_row(0, 2), "forest");
    TrialRow row = trial_row(path == "planner.gain" ? "b" : "a", 0, 0, Outcome::reached_goal);
    row.spec_json =
        R"({"wind":{"speed_mps":1.5},"planner":{"parameters":[{"name":"gain","number":2.0}]}})";
    db.add_trial(row);
  }
  const auto rows = parsed_csv(exported(files, "", TrialFormat::csv));
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(field(rows, i, "wind.speed_mps"), "1.5");
    EXPECT_EQ(field(rows, i, "planner.gain"), "2");
  }
  // Of a sweep's own export, nothing that another one of the file varies.
  files[0].add_sweep({.name = "other", .spec_json = R"({"axes":[{"path":"a.b","values":[1]}]})"});
  const auto alone = parsed_csv(exported({files.data(), 1}, "forest", TrialFormat::csv));
  EXPECT_EQ(std::count(alone[0].begin(), alone[0].end(), "a.b"), 0);
  EXPECT_EQ(std::count(alone[0].begin(), alone[0].end(), "wind.speed_mps"), 1);
}

TEST(ExportTrials, JsonLinesHoldWhatTheCsvHolds) {
  const TemporaryFolder folder;
  const std::vector<Database> db = one(filled(folder / "r.db"));
  const auto rows = parsed_csv(exported(db, "", TrialFormat::csv));
  std::istringstream lines(exported(db, "", TrialFormat::jsonl));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    ++count;
    const nlohmann::json object = nlohmann::json::parse(line);
    ASSERT_EQ(object.size(), rows.front().size());
    for (const auto& [name, value] : object.items()) {
      const std::string text = field(rows, count, name);
      if (value.is_null()) {
        EXPECT_EQ(text, "") << name;
      } else if (value.is_string()) {
        EXPECT_EQ(text, value.get<std::string>()) << name;
      } else if (name == "map_seed") {
        EXPECT_EQ(text, std::to_string(value.get<std::uint64_t>()));
      } else {
        EXPECT_EQ(std::strtod(text.c_str(), nullptr), value.get<double>()) << name;
      }
    }
  }
  EXPECT_EQ(count + 1, rows.size());
}

TEST(ExportTrials, JsonLinesKeepLettersAsTheyAre) {
  const TemporaryFolder folder;
  {
    Database db = filled(folder / "r.db");
    TrialRow row = trial_row("a", 1, 1, Outcome::collided);
    row.record.reason = "touched größtes \"Ding\"";
    db.add_trial(row);
  }
  const std::vector<Database> db = one(Database::open_for_reading(folder / "r.db"));
  const std::string lines = exported(db, "", TrialFormat::jsonl);
  EXPECT_NE(lines.find(R"(touched größtes \"Ding\")"), std::string::npos) << lines;
}

TEST(ExportTrials, PartsInAnyOrderGiveTheWholesTable) {
  const TemporaryFolder folder;
  const std::vector<Database> whole = one(filled(folder / "whole.db"));
  std::vector<Database> parts;
  parts.push_back(begun(folder / "1.db"));
  parts.push_back(begun(folder / "2.db"));
  for (const char* label : {"a", "b"}) {
    for (int map = 0; map < 2; ++map) {
      parts[0].add_trial(trial_row(label, map, 0, Outcome::reached_goal));
      parts[1].add_trial(trial_row(label, map, 1, Outcome::collided));
    }
  }
  parts[1].add_trial(trial_row("a", 0, 0, Outcome::reached_goal));  // in both
  // Ids are of one file, so several have none.
  auto truth = parsed_csv(exported(whole, "", TrialFormat::csv));
  const auto id = std::find(truth[0].begin(), truth[0].end(), "trial_id") - truth[0].begin();
  for (std::vector<std::string>& row : truth) row.erase(row.begin() + id);
  const std::string together = exported(parts, "", TrialFormat::csv);
  EXPECT_EQ(parsed_csv(together), truth);
  std::swap(parts[0], parts[1]);
  EXPECT_EQ(exported(parts, "", TrialFormat::csv), together);
}

TEST(ExportTrials, SweepsAreChosenAsForReports) {
  const TemporaryFolder folder;
  Database db = filled(folder / "r.db");
  db.add_sweep(sweep_row(R"({"trials":3})"));  // revision 2
  db.add_map(map_row(0, 2), "forest");
  TrialRow row = trial_row("a", 0, 0, Outcome::timed_out);
  row.key = key_of("of revision 2");
  db.add_trial(row);
  const std::vector<Database> all = one(std::move(db));
  const auto count = [&](const std::string& sweep) {
    return parsed_csv(exported(all, sweep, TrialFormat::csv)).size() - 1;
  };
  EXPECT_EQ(count(""), 1U);
  EXPECT_EQ(count("forest"), 1U);
  EXPECT_EQ(count("forest@1"), 8U);
  EXPECT_EQ(count("forest@2"), 1U);
  EXPECT_THROW(count("forset"), InputError);
  EXPECT_THROW(count("forest@3"), InputError);
}

TEST(ExportTrials, FilesWithOtherMetricsAreNotMixed) {
  const TemporaryFolder folder;
  std::vector<Database> files;
  files.push_back(filled(folder / "1.db"));
  Database fewer = Database::open_for_run(folder / "2.db", std::span(kMetrics).first(2));
  fewer.add_run(run_row());
  fewer.add_sweep(sweep_row());
  fewer.add_planner(planner_row("a"));
  fewer.add_map(map_row(0, 2), "forest");
  TrialRow row = trial_row("a", 0, 0, Outcome::reached_goal);
  row.metrics.pop_back();
  fewer.add_trial(row);
  files.push_back(std::move(fewer));
  try {
    exported(files, "", TrialFormat::csv);
    FAIL() << "other columns went through";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("without processing_time_ms"), std::string::npos)
        << error.what();
  }
}

TEST(ExportTrajectory, CsvHoldsEverySampleWithAllDigits) {
  const std::vector<Sample> samples = {sample(0), sample(7)};
  const auto rows = parsed_csv(trajectory_csv(samples));
  ASSERT_EQ(rows.size(), 3U);
  const auto number = [&](const std::string& column) {
    return std::strtod(field(rows, 2, column).c_str(), nullptr);
  };
  const Sample& s = samples[1];
  EXPECT_EQ(number("time_s"), s.time_s);
  EXPECT_EQ(number("x_m"), s.position_world.x());
  EXPECT_EQ(number("y_m"), 1.0 / 3.0);
  EXPECT_EQ(number("vz_mps"), 10.0);
  EXPECT_EQ(number("az_mps2"), 6.0);
  EXPECT_EQ(number("qw"), 0.5);
  EXPECT_EQ(number("qx"), -0.5);
  EXPECT_EQ(number("rate_z_body_radps"), 9.0);
  EXPECT_EQ(field(rows, 2, "reference_x_m"), "");  // no commanded position
  EXPECT_EQ(number("rotor_power_w"), 107.0);
  EXPECT_EQ(field(rows, 2, "clearance_m"), "inf");
}

TEST(ExportTrajectory, TumHasEightNumbersALineWithTheScalarLast) {
  const std::vector<Sample> samples = {sample(0), sample(7)};
  std::istringstream lines(trajectory_tum(samples));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "# timestamp tx ty tz qx qy qz qw");
  for (const Sample& s : samples) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream words(line);
    std::vector<double> values;
    for (std::string word; words >> word;) values.push_back(std::strtod(word.c_str(), nullptr));
    const std::vector<double> truth = {
        s.time_s, s.position_world.x(), s.position_world.y(), s.position_world.z(), -0.5, 0.5, -0.5,
        0.5};
    EXPECT_EQ(values, truth);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(ExportTrajectory, CallsHaveTheirStatusInWords) {
  const TrialRow row = trial_row("a", 0, 0, Outcome::reached_goal);
  const auto rows = parsed_csv(plan_calls_csv(row.record.plan_calls));
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(field(rows, 1, "call_index"), "0");
  EXPECT_EQ(field(rows, 1, "status"), "command");
  EXPECT_EQ(field(rows, 3, "status"), "no_plan");
  EXPECT_EQ(field(rows, 3, "command_kind"), "");
  EXPECT_EQ(std::strtod(field(rows, 5, "time_s").c_str(), nullptr), 4.0 / 30.0);
  EXPECT_EQ(std::strtod(field(rows, 5, "cpu_time_s").c_str(), nullptr), 0.001 * 5.0 / 3.0);
}

}  // namespace
}  // namespace avoidbench
