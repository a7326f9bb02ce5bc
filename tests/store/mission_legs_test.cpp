#include <gtest/gtest.h>

#include "store/merge.hpp"
#include "store/run_sql.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

/// Missions of several goals in the database.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::message_of;
using test::run_sql;

/// Two missions, the second one of three goals.
MapRow row_with_legs() {
  MapRow row = map_row(0, 2);
  MissionRecord& mission = row.record.missions[1];
  mission.mission.waypoints_world = {{0.1, 2.0, 3.0}, {4.0, 5.0, 1.0 / 3.0}};
  mission.leg_lengths_m = {3.5, 1.0 / 3.0, 7.25};
  return row;
}

Database with_legs(const std::filesystem::path& file) {
  Database db = Database::open_for_run(file, kMetrics);
  db.add_run(run_row());
  db.add_sweep(sweep_row());
  db.add_planner(planner_row("a"));
  db.add_map(row_with_legs(), "forest");
  return db;
}

void expect_legs(const Database& db) {
  const MapRow wanted = row_with_legs(), row = *db.read_map(wanted.record.key);
  ASSERT_EQ(row.record.missions.size(), 2U);
  EXPECT_TRUE(row.record.missions[0].mission.waypoints_world.empty());
  EXPECT_TRUE(row.record.missions[0].leg_lengths_m.empty());
  const MissionRecord &mission = row.record.missions[1], &other = wanted.record.missions[1];
  EXPECT_EQ(goals_of(mission.mission), goals_of(other.mission));
  EXPECT_EQ(mission.leg_lengths_m, other.leg_lengths_m);
  int found = 0;
  for (const MapRow& map : db.read_sweep("forest", 1).maps) {
    if (map.record.key != wanted.record.key) continue;
    EXPECT_EQ(map.record.missions[1].leg_lengths_m, other.leg_lengths_m);
    ++found;
  }
  EXPECT_EQ(found, 1);
}

TEST(MissionLegs, ComeBackToTheLastBit) {
  const TemporaryFolder folder;
  with_legs(folder / "r.db").close();
  expect_legs(Database::open_for_reading(folder / "r.db"));
}

TEST(MissionLegs, OfInvalidMissionsHaveNoLengths) {
  const TemporaryFolder folder;
  MapRow row = map_row(0, 2, true);
  row.record.missions[1].mission.waypoints_world = {{1.0, 2.0, 3.0}};
  {
    Database db = Database::open_for_run(folder / "r.db", kMetrics);
    db.add_sweep(sweep_row());
    db.add_map(row, "forest");
    db.add_map(row, "forest");  // the same again is no other map
  }
  const Database db = Database::open_for_reading(folder / "r.db");
  const MissionRecord mission = db.read_map(row.record.key)->record.missions[1];
  EXPECT_EQ(mission.mission.waypoints_world, row.record.missions[1].mission.waypoints_world);
  EXPECT_TRUE(mission.leg_lengths_m.empty());
}

TEST(MissionLegs, OtherGoalsMakeAnotherMap) {
  const TemporaryFolder folder;
  Database db = with_legs(folder / "r.db");
  MapRow other = row_with_legs();
  other.record.missions[1].mission.waypoints_world[0].x() += 1e-9;
  EXPECT_NE(message_of([&] { db.add_map(other, "forest"); }).find("is stored with other values"),
            std::string::npos);
}

TEST(MissionLegs, FilesOfOlderProgramsLackThem) {
  const TemporaryFolder folder;
  {
    Database db = Database::open_for_run(folder / "old.db", kMetrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row());
    db.add_planner(planner_row("a"));
    db.add_map(map_row(1, 2), "forest");
    db.add_trial(trial_row("a", 1, 0, Outcome::reached_goal));
  }
  run_sql(folder / "old.db", "DROP TABLE mission_legs");
  {
    const Database old = Database::open_for_reading(folder / "old.db");
    EXPECT_EQ(old.read_map(key_of("map 1"))->record.missions.size(), 2U);
  }
  // They are merged into newer ones, and take missions of several goals themselves.
  {
    Database into = with_legs(folder / "new.db");
    EXPECT_EQ(merge_database(into, folder / "old.db").new_trials, 1);
    expect_legs(into);
  }
  Database old = Database::open_for_run(folder / "old.db", kMetrics);
  old.add_sweep(sweep_row());
  EXPECT_EQ(merge_database(old, folder / "new.db").new_trials, 0);
  expect_legs(old);
}

TEST(MissionLegs, ThatAreDamagedAreFound) {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"DELETE FROM mission_legs WHERE leg_index = 1", "a leg before this one is missing"},
      {"DELETE FROM mission_legs WHERE leg_index = 2", "another last goal"},
      {"UPDATE mission_legs SET goal_x_m = 9 WHERE leg_index = 2", "another last goal"},
      {"UPDATE mission_legs SET goal_x_m = 9e999 WHERE leg_index = 0", "impossible numbers"},
      {"UPDATE mission_legs SET reference_length_m = -1", "impossible numbers"},
      {"UPDATE mission_legs SET reference_length_m = NULL", "impossible numbers"}};
  for (const auto& [sql, problem] : cases) {
    std::filesystem::remove(folder / "r.db");
    with_legs(folder / "r.db").close();
    run_sql(folder / "r.db", sql);
    const std::string message = message_of(
        [&] { Database::open_for_reading(folder / "r.db").read_map(row_with_legs().record.key); });
    EXPECT_NE(message.find(problem), std::string::npos) << sql << ": " << message;
  }
}

}  // namespace
}  // namespace avoidbench
