#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/input_error.hpp"
#include "base/words.hpp"
#include "store/log_check.hpp"
#include "store/merge.hpp"
#include "store/run_sql.hpp"
#include "store/statement.hpp"
#include "store/trial_fields.hpp"
#include "store/trial_table.hpp"
#include "support/sample_rows.hpp"

/// What a file's sweeps vary is a column of trial_table.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::run_sql;

/// Of one axis of maps and one of wind, and of a planner that is flown with two gains.
constexpr const char* kVaried = R"({"trials":2,
  "axes":[{"path":"map_seed","values":[1,2]},{"path":"map.poisson_radius_m","values":[2.5,3]},
          {"path":"wind.mean_world_mps","values":[[0,0,0],[2,0,0]]}],
  "planners":[{"plugin":"p","parameters":[{"name":"gain","number":1.0,"text":"","is_text":false},
                                          {"name":"mode","number":0.0,"text":"a","is_text":true}]},
              {"plugin":"p","parameters":[{"name":"gain","number":2.0,"text":"","is_text":false},
                                          {"name":"mode","number":0.0,"text":"a","is_text":true}]}]})";

/// The spec of a trial with this wind and gain.
std::string trial_spec(const std::string& wind_mps, const std::string& gain) {
  return R"({"seed":1,"wind":{"mean_world_mps":[)" + wind_mps +
         R"(,0.0,0.0]},"planner":{"label":"a","parameters":[{"name":"gain","number":)" + gain +
         R"(,"text":"","is_text":false}]}})";
}

std::vector<std::string> columns_of(const Database& db, const std::string& view) {
  Statement s(db.handle(), db.path(), "SELECT * FROM " + view + " LIMIT 0");
  std::vector<std::string> names;
  for (int i = 0; i < s.column_count(); ++i) names.push_back(s.column_name(i));
  return names;
}

/// The columns that are named by paths.
std::vector<std::string> paths_of(const Database& db, const std::string& view = "trial_table") {
  std::vector<std::string> paths = columns_of(db, view);
  std::erase_if(paths, [](const std::string& name) { return name.find('.') == std::string::npos; });
  return paths;
}

/// A file of this sweep with one trial on each of two maps.
void write_varied(const std::filesystem::path& file, const std::string& sweep = kVaried) {
  Database db = begun(file);
  db.add_sweep(sweep_row(sweep));
  for (int map = 0; map < 2; ++map) {
    db.add_map(map_row(map, 2), "forest");
    TrialRow row = trial_row("a", map, 0, Outcome::reached_goal);
    row.spec_json = map == 0 ? trial_spec("0.0", "1.0") : trial_spec("2.0", "2.0");
    db.add_trial(row);
  }
}

using Names = std::vector<std::string>;
const Names kPaths{"map.poisson_radius_m", "wind.mean_world_mps", "planner.gain"};

TEST(AxisColumns, WhatASweepVariesIsAColumnOfTheViews) {
  const TemporaryFolder folder;
  write_varied(folder / "r.db");
  const Database db = Database::open_for_reading(folder / "r.db");
  EXPECT_EQ(paths_of(db), kPaths);
  EXPECT_EQ(paths_of(db, "latest_trials"), kPaths);
  EXPECT_EQ(std::ranges::count(columns_of(db, "trial_table"), "map_seed"), 1);
  Statement s(db.handle(), db.path(),
              "SELECT \"map.poisson_radius_m\", \"wind.mean_world_mps\", \"planner.gain\", "
              "trial_key FROM trial_table ORDER BY 1");
  ASSERT_TRUE(s.step());
  EXPECT_EQ(s.real(0), 2.5);
  EXPECT_EQ(s.text(1), "[0.0,0.0,0.0]");
  EXPECT_EQ(s.real(2), 1.0);
  ASSERT_TRUE(s.step());
  EXPECT_EQ(s.real(0), 3.0);
  EXPECT_EQ(s.text(1), "[2.0,0.0,0.0]");
  EXPECT_EQ(s.real(2), 2.0);
}

/// For sqlite3, pandas and the like, which see the file's own views.
TEST(AxisColumns, TheFilesOwnViewsHaveThem) {
  const TemporaryFolder folder;
  write_varied(folder / "r.db");
  run_sql(folder / "r.db",
          // Without "v.", a name that is none would be a text.
          "CREATE TABLE copy AS SELECT v.\"map.poisson_radius_m\", v.\"wind.mean_world_mps\", "
          "v.\"planner.gain\" FROM latest_trials v");
}

TEST(AxisColumns, TheReaderHasThoseThatAreWanted) {
  const TemporaryFolder folder;
  write_varied(folder / "r.db");
  const Database db = Database::open_for_reading(folder / "r.db");
  const std::vector<SweepInfo> sweeps = db.read_sweeps();
  const auto rows = [&](const Names& axes) { return TrialTableReader(db, sweeps, axes); };
  const auto has = [&](const Names& axes, const std::string& name) {
    return contains(rows(axes).columns(), name);
  };
  EXPECT_FALSE(has({}, "planner.gain"));
  EXPECT_TRUE(has({"planner.gain"}, "planner.gain"));
  EXPECT_FALSE(has({"planner.gain"}, "wind.mean_world_mps"));
  // Also what no sweep of this file varies: files are read side by side.
  TrialTableReader reader = rows({"wind.mean_world_mps.0"});
  const auto& names = reader.columns();
  const auto at = std::ranges::find(names, "wind.mean_world_mps.0") - names.begin();
  std::set<double> winds_mps;
  while (reader.next()) {
    winds_mps.insert(std::get<double>(reader.row()[static_cast<std::size_t>(at)]));
  }
  EXPECT_EQ(winds_mps, (std::set<double>{0.0, 2.0}));
}

TEST(AxisColumns, TrialsAreListedWithTheirSetting) {
  const TemporaryFolder folder;
  write_varied(folder / "r.db");
  const Database db = Database::open_for_reading(folder / "r.db");
  Names fields = axis_fields(db.read_sweeps());
  EXPECT_EQ(fields,
            (Names{"map_seed", "map.poisson_radius_m", "wind.mean_world_mps", "planner.gain"}));
  fields.emplace_back("end_time_s");  // which no sweep varies
  EXPECT_EQ(db.list_trials(fields).at(1).setting,
            "poisson_radius_m 3, mean_world_mps [2.0,0.0,0.0]");
  EXPECT_EQ(db.list_trials().at(1).setting, "");
}

TEST(AxisColumns, AreMadeAnewWhenASweepIsAdded) {
  const TemporaryFolder folder;
  const std::string with_latency = R"({"axes":[{"path":"latency.ms","values":[0,40]}]})";
  Database db = begun(folder / "r.db");
  EXPECT_EQ(paths_of(db), Names{});
  db.add_sweep(sweep_row(kVaried));
  EXPECT_EQ(paths_of(db), kPaths);
  Names all = kPaths;
  all.emplace_back("latency.ms");
  // A log begins with the cookie after that of its file, whatever the schema's changes.
  const std::uint32_t before = read_cookie(db.handle(), db.path());
  db.add_sweep({.name = "other", .spec_json = with_latency});
  EXPECT_EQ(read_cookie(db.handle(), db.path()), cookie_of_next_transaction(before));
  EXPECT_EQ(paths_of(db), all);
  db.add_trial(finished());
  db.close();
  EXPECT_EQ(paths_of(Database::open_for_reading(folder / "r.db")), all);
  EXPECT_EQ(paths_of(Database::open_for_run(folder / "r.db", kMetrics)), all);
  run_sql(folder / "r.db", "CREATE TABLE copy AS SELECT v.\"latency.ms\" FROM latest_trials v");
}

TEST(AxisColumns, AreMadeAnewByAMerge) {
  const TemporaryFolder folder;
  write_varied(folder / "part.db");
  Database db = Database::open_for_run(folder / "all.db", kMetrics);
  EXPECT_EQ(paths_of(db), Names{});
  merge_database(db, folder / "part.db");
  EXPECT_EQ(paths_of(db), kPaths);
  db.close();
  run_sql(folder / "all.db", "CREATE TABLE copy AS SELECT v.\"planner.gain\" FROM trial_table v");
}

/// The file's columns after its sweep says this of itself.
Names paths_with(const std::string& spec_json) {
  const TemporaryFolder folder;
  write_varied(folder / "r.db");
  std::string quoted = spec_json;
  for (auto at = quoted.find('\''); at != std::string::npos; at = quoted.find('\'', at + 2)) {
    quoted.insert(at, 1, '\'');
  }
  run_sql(folder / "r.db", "UPDATE sweeps SET spec_json = '" + quoted + "'");
  const Database db = Database::open_for_reading(folder / "r.db");
  Statement s(db.handle(), db.path(), "SELECT * FROM latest_trials");
  int count = 0;
  while (s.step()) ++count;
  EXPECT_EQ(count, 2) << spec_json;
  return paths_of(db);
}

TEST(AxisColumns, ADamagedFilesPathsMakeNoColumns) {
  for (const std::string path :
       {R"(a.b\" AS x, (SELECT 1) AS \"y)", R"(a.b') FROM trials; DROP TABLE trials; --)", "a..b",
        ".a", "a.", ".", "a-b.c", "a.b c", "a.b[0]", "planner", "a.{metrics}"}) {
    EXPECT_EQ(paths_with(R"({"axes":[{"path":")" + path + R"(","values":[1,2]}]})"), Names{})
        << path;
    EXPECT_EQ(paths_with(R"({"planners":[{"plugin":"p","parameters":[{"name":")" + path +
                         R"(","number":1}]},{"plugin":"p","parameters":[{"name":")" + path +
                         R"(","number":2}]}]})"),
              path == "planner" ? Names{"planner.planner"} : Names{})
        << path;
  }
  EXPECT_EQ(paths_with(R"({"axes":[{"path":"a.)" + std::string(1000, 'b') + R"(","values":[]}]})"),
            Names{});
  for (const std::string spec :
       {"x", "[]", R"({"axes":5})", R"({"axes":[5]})", R"({"planners":[5,{"parameters":[5]}]})",
        R"({"planners":[{"plugin":5,"parameters":[{"name":7}]},{"plugin":"p","parameters":5}]})"}) {
    EXPECT_EQ(paths_with(spec), Names{}) << spec;
  }
}

TEST(AxisColumns, AFileOfThousandsOfAxesIsRead) {
  std::string axes;
  for (int i = 0; i < 3000; ++i) {
    axes += (i == 0 ? "" : ",") + (R"({"path":"a.b)" + std::to_string(i) + R"(","values":[]})");
  }
  EXPECT_EQ(paths_with(R"({"axes":[)" + axes + "]}").size(), 200U);
}

}  // namespace
}  // namespace avoidbench
