#include "sweep/listed_missions.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "base/input_error.hpp"
#include "replay/replay.hpp"
#include "support/input_error_message.hpp"
#include "support/small_sweep.hpp"
#include "support/temporary_folder.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

InputProblem place_of(int line) {
  return {.file = "m.csv", .line = line, .column = 1, .message = {}};
}

/// The missions that are made for the small sweep's maps, listed by hand.
SweepSpec listing_sweep() {
  SweepSpec sweep = test::small_sweep();
  sweep.name = "listed";
  for (const std::uint64_t seed : {1U, 2U}) {
    const World world = make_world(sweep.base.map, seed);
    const Scene scene(world);
    for (std::int64_t index = 0; index < sweep.trials; ++index) {
      sweep.missions.push_back(
          {.map = std::to_string(seed),
           .mission = *make_mission(scene, sweep.base.mission, sweep.base.seed, index),
           .place = place_of(static_cast<int>(index) + 1)});
    }
  }
  return sweep;
}

class ListedMissions : public test::SweepTest {};

TEST_F(ListedMissions, FlyAsTheSameMissionsDoThatAreMade) {
  run(test::small_sweep(), "made.db", 1, true);
  run(listing_sweep(), "listed.db", 2);
  const Database made = Database::open_for_reading(folder_ / "made.db");
  const Database listed = Database::open_for_reading(folder_ / "listed.db");
  std::map<std::string, std::string> key_of;
  const auto name = [](const TrialListing& trial) {
    return trial.planner_label + std::to_string(trial.map_seed) +
           std::to_string(trial.mission_index);
  };
  for (const TrialListing& trial : made.list_trials()) key_of[name(trial)] = trial.key;
  ASSERT_EQ(listed.list_trials().size(), 8U);
  for (const TrialListing& trial : listed.list_trials()) {
    ASSERT_TRUE(key_of.contains(name(trial)));
    EXPECT_NE(trial.key, key_of[name(trial)]);
    const auto a = made.read_trial(key_of[name(trial)]), b = listed.read_trial(trial.key);
    EXPECT_TRUE(differences(a->record, b->record).empty());
    EXPECT_EQ(a->metrics[0], b->metrics[0]);
    const StoredTrial stored = read_stored_trial(listed, trial.key);
    EXPECT_FALSE(stored.spec.missions_digest.empty());
    EXPECT_EQ(trial_key(stored.spec), trial.key);
  }
}

TEST_F(ListedMissions, AreFoundAgainAndOnlyAChangedMapIsFlownAgain) {
  SweepSpec sweep = listing_sweep();
  run(sweep, "a.db", 1, true);
  EXPECT_EQ(run(sweep, "a.db", 1, true).progress.done_before, 8);
  sweep.missions.pop_back();  // map 2 keeps one mission
  const RunSummary summary = run(sweep, "a.db", 1, true);
  EXPECT_EQ(summary.progress.total, 6);
  EXPECT_EQ(summary.progress.done_before, 4);
  EXPECT_EQ(summary.revision, 2);
}

TEST(ListedMissionKeys, FollowFromTheirDigest) {
  TrialSpec spec;
  const std::string trial = trial_key(spec), map = map_key(spec);
  spec.missions_digest = "ab";
  EXPECT_NE(trial_key(spec), trial);
  EXPECT_NE(map_key(spec), map);
}

TEST(ListedMissionKeys, FollowFromAllThatAMissionIs) {
  std::vector<Mission> missions(2);
  std::set<std::string> digests{missions_digest(missions), missions_digest({})};
  missions[1].start_world.z() = 1e-9;
  digests.insert(missions_digest(missions));
  missions[1].goal_world.x() = 1e-9;
  digests.insert(missions_digest(missions));
  missions[0].start_yaw_rad = 1e-9;
  digests.insert(missions_digest(missions));
  EXPECT_EQ(digests.size(), 5U);
}

TEST(ListedMissionChecks, NameWhatCantBeFlownWithItsPlace) {
  SweepSpec sweep;
  sweep.name = "checked";
  sweep.planners = {test::preset_choice("straight_line")};
  sweep.base.map = HallSpec{.area_m = {10, 14}, .poisson_radius_m = 3.0};
  const World world = make_world(sweep.base.map, 1);
  const auto cylinder = std::find_if(world.obstacles.begin(), world.obstacles.end(),
                                     [](const Obstacle& one) { return one.kind == "cylinder"; });
  ASSERT_NE(cylinder, world.obstacles.end());
  const auto made = make_mission(Scene(world), sweep.base.mission, 1, 0);
  const auto add = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& goal) {
    const int line = static_cast<int>(sweep.missions.size()) + 1;
    sweep.missions.push_back({.map = "",
                              .mission = {.start_world = start, .goal_world = goal},
                              .place = place_of(line)});
  };
  Eigen::Vector3d inside = cylinder->position_world;
  inside.z() = 2.0;
  Eigen::Vector3d outside = made->start_world;
  outside.x() = -5.0;
  Eigen::Vector3d near_floor = made->start_world;
  near_floor.z() = 0.5;
  add(made->start_world, made->goal_world);
  add(inside, made->goal_world);
  add(made->start_world, outside);
  add(near_floor, made->goal_world);
  add(made->start_world, made->start_world);
  sweep.trials = 5;
  const std::string problems =
      test::message_of([&] { check_listed_missions(sweep, expand(sweep)); });
  std::vector<std::string> lines;
  std::istringstream stream(problems);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U) << problems;
  const auto has = [&](std::size_t at, const std::string& place, const std::string& text) {
    EXPECT_TRUE(lines[at].starts_with(place)) << lines[at];
    EXPECT_NE(lines[at].find(text), std::string::npos) << lines[at];
  };
  has(0, "m.csv:2:1: start (", "is inside an obstacle (map 1)");
  has(1, "m.csv:3:1: goal (-5, ", "is out of the flight bounds, [");
  has(2, "m.csv:4:1: start (",
      "has a surface 0.50 m away, nearer than mission.free_radius_m, 1.3 m");
  has(3, "m.csv:5:1: start (", "is 0.00 m from the goal, within mission.goal_radius_m, 0.8 m");
  // A database that has not measured the map knows nothing of them.
  const test::TemporaryFolder folder;
  const Database empty = Database::open_for_run(folder / "empty.db", metric_table());
  EXPECT_EQ(test::message_of([&] { check_listed_missions(sweep, expand(sweep), &empty); }),
            problems);
  sweep.trials = 1;  // the others are not flown
  EXPECT_EQ(test::message_of([&] { check_listed_missions(sweep, expand(sweep)); }), "");
}

}  // namespace
}  // namespace avoidbench
