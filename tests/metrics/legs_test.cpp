#include "metrics/legs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/known_world.hpp"
#include "metrics/metric_table.hpp"
#include "metrics/reference_path.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kLegGoalRadius_m = 0.8;

/// From (0, -15, 2) by (0, 0, 2) and (10, 0, 2) to (10, 10, 2).
Mission three_goals() {
  Mission mission = test::straight_mission();
  mission.waypoints_world = {{0, 0, 2}, {10, 0, 2}};
  mission.goal_world = {10, 10, 2};
  return mission;
}

MissionRecord record_of(const World& world, const Mission& mission) {
  const Scene scene(world);
  ClearanceGrid grid(scene, world.bounds, kMapCell_m);
  TrialSpec spec;
  spec.mission.goal_radius_m = kLegGoalRadius_m;
  return make_mission_record(spec, scene, grid, 0, {mission});
}

/// In an empty world each leg is straight from where the one before it ended to the next circle.
TEST(ReferenceLegs, AddUpToTheShortestPath) {
  const MissionRecord record = record_of(test::flight_world(), three_goals());
  ASSERT_TRUE(record.is_valid) << record.invalid_reason;
  ASSERT_EQ(record.leg_lengths_m.size(), 3U);
  const Vector3d entry(0, -kLegGoalRadius_m, 2);
  EXPECT_NEAR(record.leg_lengths_m[0], 15.0 - kLegGoalRadius_m, 1e-9);
  EXPECT_NEAR(record.leg_lengths_m[1], (Vector3d(10, 0, 2) - entry).norm() - kLegGoalRadius_m,
              1e-6);
  EXPECT_EQ(record.reference_length_m,
            record.leg_lengths_m[0] + record.leg_lengths_m[1] + record.leg_lengths_m[2]);
  // A mission of one goal has none.
  EXPECT_TRUE(record_of(test::flight_world(), test::straight_mission()).leg_lengths_m.empty());
}

TEST(ReferenceLegs, NameTheGoalThatCannotBeReached) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({0.2F, 40, 12}), {5, 0, 5}, "wall");
  const MissionRecord record = record_of(world, three_goals());
  EXPECT_FALSE(record.is_valid);
  EXPECT_EQ(record.invalid_reason, "goal 2 can't be reached");
  EXPECT_TRUE(std::isnan(record.reference_length_m));
  EXPECT_TRUE(record.leg_lengths_m.empty());
  const TrialSpec spec;
  const std::vector<std::string> problems = mission_problems(spec, Scene(world), {three_goals()});
  EXPECT_EQ(problems.front(), "goal 2 (10, 0, 2) can't be reached from goal 1");
}

TEST(ListedMissions, KeepTheRulesAtEachGoal) {
  const World world = test::flight_world();
  const Scene scene(world);
  const auto problem = [&](const std::vector<Vector3d>& waypoints, const MissionSpec& rules = {}) {
    TrialSpec spec;
    spec.mission = rules;
    Mission mission = test::straight_mission();
    mission.waypoints_world = waypoints;
    return mission_problems(spec, scene, {mission}).front();
  };
  EXPECT_EQ(problem({{0, 0, 2}}), "");
  EXPECT_EQ(problem({{0, 0, 2}, {0, 0, 0.5}}),
            "goal 2 (0, 0, 0.5) has a surface 0.50 m away, nearer than mission.free_radius_m, 1.3 "
            "m");
  EXPECT_EQ(problem({{0, 0, 2}, {0, 0.5, 4}}),
            "goal 1 (0, 0, 2) is 0.50 m from goal 2, within mission.goal_radius_m, 0.8 m");
  EXPECT_EQ(problem({{0, -14.8, 2}}),
            "start (0, -15, 2) is 0.20 m from goal 1, within mission.goal_radius_m, 0.8 m");
  MissionSpec rules;
  rules.goal_motion = {.path = GoalPath::line, .speed_mps = 1.0, .extent_m = 41.0};
  EXPECT_EQ(problem({}, rules),
            "goal (0, 15, 2) moves to where a surface is nearer than mission.free_radius_m, 1.3 m, "
            "or out of the flight bounds");
}

TEST(KnownWorldOfSeveralGoals, LeadsWellIntoEachCircle) {
  const World world = test::flight_world();
  const Scene scene(world);
  const TrialSpec spec;
  const Mission mission = three_goals();
  const auto path = known_world(spec, scene, mission).shortest_path_world(0.25);
  ASSERT_EQ(path.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR((path[i + 1] - mission.waypoints_world[i]).norm(), 0.4, 1e-6);
  }
  EXPECT_NEAR((path[3] - mission.goal_world).norm(), 0.8, 1e-6);
}

/// A flight at 2.5 m/s along these places, sampled ten times a second.
TrialRecord along(const std::vector<Vector3d>& places, Outcome outcome) {
  TrialRecord record;
  record.outcome = outcome;
  double time_s = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vector3d way = places[i] - places[i - 1];
    const int count = static_cast<int>(std::round(way.norm() / 0.25));
    for (int k = record.samples.empty() ? 0 : 1; k <= count; ++k) {
      Sample sample;
      sample.time_s = time_s + 0.1 * k;
      sample.position_world = places[i - 1] + way * k / count;
      record.samples.push_back(sample);
    }
    time_s += 0.1 * count;
  }
  record.end_time_s = time_s;
  return record;
}

double metric(const char* name, const MissionRecord& mission, const TrialRecord& record) {
  const TrialSpec spec;
  const std::vector<double> values = compute_metrics({spec, mission, record});
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (metric_table()[i].name == name) return values[i];
  }
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(FlownLegs, AddUpToTheFlight) {
  const MissionRecord mission = record_of(test::flight_world(), three_goals());
  const TrialRecord record =
      along({{0, -15, 2}, {0, 0, 2}, {10, 0, 2}, {10, 9.25, 2}}, Outcome::reached_goal);
  const std::vector<FlownLeg> legs = flown_legs(TrialSpec(), mission, record);
  ASSERT_EQ(legs.size(), 3U);
  double length_m = 0.0, time_s = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(legs[i].index, static_cast<std::int64_t>(i));
    EXPECT_TRUE(legs[i].is_reached);
    EXPECT_EQ(legs[i].begin_s, time_s);
    EXPECT_EQ(legs[i].reference_length_m, mission.leg_lengths_m[i]);
    EXPECT_NEAR(legs[i].path_length_m, 2.5 * (legs[i].end_s - legs[i].begin_s), 1e-9);
    time_s = legs[i].end_s;
    length_m += legs[i].path_length_m;
  }
  EXPECT_NEAR(legs[0].end_s, 5.7, 1e-9);  // 14.25 m: 0.75 m from the goal
  EXPECT_NEAR(legs[1].end_s, 6.0 + 3.7, 1e-9);
  EXPECT_NEAR(length_m, 15.0 + 10.0 + 9.25, 1e-9);
  EXPECT_EQ(time_s, record.end_time_s);
  EXPECT_EQ(metric("goals_reached_count", mission, record), 3.0);
  EXPECT_EQ(metric("mission_progress_pct", mission, record), 100.0);
  EXPECT_NEAR(metric("average_goal_velocity_mps", mission, record),
              mission.reference_length_m / record.end_time_s, 1e-12);
}

TEST(FlownLegs, EndWithTheOneThatWasNotFlown) {
  const MissionRecord mission = record_of(test::flight_world(), three_goals());
  const TrialRecord record = along({{0, -15, 2}, {0, 0, 2}, {4, 0, 2}}, Outcome::timed_out);
  const std::vector<FlownLeg> legs = flown_legs(TrialSpec(), mission, record);
  ASSERT_EQ(legs.size(), 2U);
  EXPECT_TRUE(legs[0].is_reached);
  EXPECT_FALSE(legs[1].is_reached);
  EXPECT_EQ(legs[1].end_s, record.end_time_s);
  EXPECT_EQ(metric("goals_reached_count", mission, record), 1.0);
  // One of three legs, and 4 m of the 10 m of the second.
  EXPECT_NEAR(metric("mission_progress_pct", mission, record), (100.0 + 40.0) / 3.0, 1e-9);
  // 6 m and the third leg's 10 m are left of 15 + 10 + 10 m.
  EXPECT_NEAR(metric("relative_end_distance_ratio", mission, record), 16.0 / 35.0, 1e-12);
}

TEST(FlownLegs, OfOneGoalAreTheFlight) {
  const MissionRecord mission = record_of(test::flight_world(), test::straight_mission());
  const TrialRecord record = along({{0, -15, 2}, {0, 3, 2}}, Outcome::timed_out);
  const std::vector<FlownLeg> legs = flown_legs(TrialSpec(), mission, record);
  ASSERT_EQ(legs.size(), 1U);
  EXPECT_FALSE(legs[0].is_reached);
  EXPECT_EQ(legs[0].reference_length_m, mission.reference_length_m);
  EXPECT_NEAR(legs[0].path_length_m, 18.0, 1e-9);
  EXPECT_NEAR(metric("mission_progress_pct", mission, record), 60.0, 1e-9);
  EXPECT_NEAR(metric("relative_end_distance_ratio", mission, record), 12.0 / 30.0, 1e-12);
  EXPECT_TRUE(flown_legs(TrialSpec(), mission, TrialRecord()).size() == 1U);
}

}  // namespace
}  // namespace avoidbench
