#include "trial/goals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "support/flight_worlds.hpp"
#include "trial/flight.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

MissionSpec moving(GoalPath path, double speed_mps = 2.0, double extent_m = 6.0) {
  MissionSpec rules;
  rules.goal_motion = {.path = path, .speed_mps = speed_mps, .extent_m = extent_m};
  return rules;
}

TEST(GoalWay, OfALineGoesToAndFroAcrossTheWayToIt) {
  // Toward +y: left is -x.
  const GoalWay way = goal_way(moving(GoalPath::line), {1, 0, 5}, {1, 10, 2});
  EXPECT_EQ(place_at(way, 0.0), Vector3d(1, 10, 2));
  EXPECT_TRUE(place_at(way, 1.0).isApprox(Vector3d(-1, 10, 2)));
  EXPECT_TRUE(place_at(way, 1.5).isApprox(Vector3d(-2, 10, 2)));  // the end
  EXPECT_TRUE(place_at(way, 2.0).isApprox(Vector3d(-1, 10, 2)));
  EXPECT_TRUE(place_at(way, 4.5).isApprox(Vector3d(4, 10, 2)));  // the other one
  EXPECT_TRUE(place_at(way, 6.0).isApprox(Vector3d(1, 10, 2)));  // there and back: 12 m
  EXPECT_TRUE(place_at(way, 607.0).isApprox(place_at(way, 1.0)));
}

TEST(GoalWay, OfACircleLeavesThePlaceStraightAhead) {
  const GoalWay way = goal_way(moving(GoalPath::circle), {0, 10, 2}, {10, 10, 2});
  const Vector3d centre(10, 13, 2);  // left of +x
  EXPECT_EQ(place_at(way, 0.0), Vector3d(10, 10, 2));
  for (const double time_s : {0.3, 1.0, 5.0, 40.0}) {
    EXPECT_NEAR((place_at(way, time_s) - centre).norm(), 3.0, 1e-12) << time_s;
  }
  const Vector3d velocity = (place_at(way, 1e-6) - place_at(way, 0.0)) / 1e-6;
  EXPECT_NEAR(velocity.x(), 2.0, 1e-5);
  EXPECT_NEAR(velocity.y(), 0.0, 1e-5);
  const double half_round_s = math::kPi * 3.0 / 2.0;
  EXPECT_TRUE(place_at(way, half_round_s).isApprox(Vector3d(10, 16, 2), 1e-12));
}

TEST(GoalWay, WithoutACourseGoesAlongX) {
  const GoalWay way = goal_way(moving(GoalPath::circle), {3, 4, 1}, {3, 4, 2});
  EXPECT_EQ(way.ahead_world, Vector3d::UnitX());
  EXPECT_TRUE(place_at(way, 1.0).allFinite());
}

TEST(GoalWay, IsFreeWhereNothingIsNearAndNoBoundIsLeft) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({0.4F, 0.4F, 4}), {3, 0, 2}, "post");
  const Scene scene(world);
  const auto is_free = [&](const MissionSpec& rules, const Vector3d& place) {
    return is_way_free(scene, rules, goal_way(rules, place - Vector3d(0, 5, 0), place));
  };
  // Nearest are the post's faces, 2.8 m from x = 0.
  EXPECT_TRUE(is_free(moving(GoalPath::line, 1.0, 2.8), {0, 0, 2}));
  EXPECT_FALSE(is_free(moving(GoalPath::line, 1.0, 3.2), {0, 0, 2}));
  EXPECT_TRUE(is_free(moving(GoalPath::circle, 1.0, 3.2), {0, 0, 2}));  // to the left: away
  EXPECT_FALSE(is_free(moving(GoalPath::circle, 1.0, 8.0), {7, -4, 2}));
  EXPECT_TRUE(is_free(moving(GoalPath::line, 1.0, 2.0), {0, 19.5, 2}));
  EXPECT_FALSE(is_free(moving(GoalPath::line, 1.0, 2.0), {19.5, 0, 2}));  // out of the bounds
  EXPECT_TRUE(is_free(MissionSpec(), {0, 0, 2}));
}

TEST(MadeMissions, WaypointsMoveNeitherStartNorGoal) {
  const World world = test::flight_world();
  const Scene scene(world);
  MissionSpec rules;
  const Mission bare = *make_mission(scene, rules, 3, 4);
  EXPECT_TRUE(bare.waypoints_world.empty());
  rules.waypoints = 2;
  const Mission two = *make_mission(scene, rules, 3, 4);
  rules.waypoints = 5;
  const Mission five = *make_mission(scene, rules, 3, 4);
  ASSERT_EQ(five.waypoints_world.size(), 5U);
  ASSERT_EQ(two.waypoints_world.size(), 2U);
  for (const Mission* mission : {&two, &five}) {
    EXPECT_EQ(mission->start_world, bare.start_world);
    EXPECT_EQ(mission->goal_world, bare.goal_world);
    EXPECT_EQ(mission->waypoints_world[0], five.waypoints_world[0]);
    EXPECT_EQ(mission->waypoints_world[1], five.waypoints_world[1]);
    EXPECT_EQ(mission->start_yaw_rad,
              yaw_toward_goal_rad(bare.start_world, five.waypoints_world[0]));
  }
}

TEST(MadeMissions, WaypointsAreFreeAndApart) {
  World world = test::flight_world();
  for (int i = 0; i < 12; ++i) {
    test::add_obstacle(world, test::box_mesh({0.5F, 0.5F, 4}), {-16.0 + 3 * i, 0, 2}, "post");
  }
  const Scene scene(world);
  MissionSpec rules;
  rules.waypoints = 20;
  rules.goal_radius_m = 3.0;  // of which the chance to meet another by accident is not small
  Vector3d lowest = Vector3d::Constant(HUGE_VAL), highest = -lowest;
  for (std::int64_t index = 0; index < 5; ++index) {
    const Mission mission = *make_mission(scene, rules, 1, index);
    Vector3d before = mission.start_world;
    for (const Vector3d& goal : goals_of(mission)) {
      EXPECT_GE(scene.nearest(goal, 5.0).distance_m, rules.free_radius_m);
      EXPECT_GT((goal - before).head<2>().norm(), rules.goal_radius_m);
      before = goal;
    }
    for (const Vector3d& place : mission.waypoints_world) {
      lowest = lowest.cwiseMin(place);
      highest = highest.cwiseMax(place);
    }
  }
  // Anywhere in plan, at the heights of starts and goals.
  EXPECT_LT(lowest.head<2>().maxCoeff(), -15.0);
  EXPECT_GT(highest.head<2>().minCoeff(), 15.0);
  EXPECT_EQ(lowest.z(), 2.0);
  EXPECT_EQ(highest.z(), 2.0);
}

TEST(MadeMissions, AReturnAddsTheStartAsLastGoal) {
  const World world = test::flight_world();
  const Scene scene(world);
  MissionSpec rules;
  rules.waypoints = 1;
  const Mission there = *make_mission(scene, rules, 3, 4);
  rules.return_to_start = true;
  const Mission back = *make_mission(scene, rules, 3, 4);
  EXPECT_EQ(goals_of(back),
            (std::vector<Vector3d>{there.waypoints_world[0], there.goal_world, there.start_world}));
}

TEST(MadeMissions, AMovingGoalHasRoomForItsWay) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({0.4F, 0.4F, 4}), {0, 16, 2}, "post");
  const Scene scene(world);
  const MissionSpec rules = moving(GoalPath::line, 1.0, 10.0);
  for (std::int64_t index = 0; index < 20; ++index) {
    const Mission mission = *make_mission(scene, rules, 1, index);
    EXPECT_TRUE(is_way_free(scene, rules, last_goal_way(rules, mission)));
  }
}

/// A flight over the bare floor, steered straight to the goal that is shown.
struct GoalFlight {
  explicit GoalFlight(World given = test::flight_world()) : world(std::move(given)) {}

  World world;
  Scene scene{world};
  TrialSpec spec;
  Mission mission = test::straight_mission();
  std::vector<GoalView> shown = {};

  TrialRecord fly(std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_GOALS) {
    shown.clear();
    Flight flight = begin_flight(spec, scene, mission, needs);
    while (const PlannerView* view = next_plan(flight)) {
      if (view->goal) shown.push_back(*view->goal);
      const Vector3d goal = view->goal ? view->goal->place_world : mission.goal_world;
      Vector3d velocity = 2.0 * (goal - view->position_world);
      if (velocity.norm() > 3.0) velocity *= 3.0 / velocity.norm();
      PlanResult result;
      result.status = PlanStatus::command;
      result.command.kind = AB_COMMAND_VELOCITY;
      for (int i = 0; i < 3; ++i) result.command.velocity_world_mps[i] = velocity[i];
      result.command.yaw_rad = 0.5 * math::kPi;
      answer(flight, result);
    }
    return end_flight(std::move(flight));
  }
};

TEST(FlightsOfSeveralGoals, ReachThemInOrder) {
  GoalFlight flight;
  // The second one lies on the way to the first: passing it then counts nothing.
  flight.mission.waypoints_world = {{0, 0, 2}, {0, -8, 2}, {6, -8, 2}};
  flight.mission.goal_world = {6, 2, 2};
  const TrialRecord record = flight.fly();
  EXPECT_EQ(record.outcome, Outcome::reached_goal);
  const std::vector<double> times_s = goal_times_s(flight.spec.mission, flight.mission, record);
  ASSERT_EQ(times_s.size(), 4U);
  EXPECT_EQ(times_s.back(), record.end_time_s);
  for (std::size_t i = 1; i < times_s.size(); ++i) EXPECT_GT(times_s[i], times_s[i - 1]);
  // 14.2 m to the first and some 7 m back, at 3 m/s.
  EXPECT_NEAR(times_s[0], 14.2 / 3.0, 0.7);
  EXPECT_NEAR(times_s[1] - times_s[0], 7.0 / 3.0, 1.0);
  std::uint32_t index = 0;
  for (const GoalView& goal : flight.shown) {
    EXPECT_TRUE(goal.index == index || goal.index == index + 1);
    index = goal.index;
    EXPECT_EQ(goal.place_world, goals_of(flight.mission)[index]);
  }
  EXPECT_EQ(index, 3U);
}

TEST(FlightsOfSeveralGoals, HaveASampleWhereOneIsReached) {
  GoalFlight flight;
  flight.mission.waypoints_world = {{0, -5, 2}};
  const TrialRecord record = flight.fly();
  const double reached_s = goal_times_s(flight.spec.mission, flight.mission, record).front();
  // Physics' steps are of 1 ms: the first within the circle is hardly inside.
  const Sample* at = nullptr;
  for (const Sample& sample : record.samples) {
    if (sample.time_s == reached_s) at = &sample;
  }
  ASSERT_NE(at, nullptr);
  const double distance_m = (at->position_world - Vector3d(0, -5, 2)).head<2>().norm();
  EXPECT_LE(distance_m, 0.8);
  EXPECT_GT(distance_m, 0.8 - 0.0035);
}

TEST(FlightsOfSeveralGoals, MayReachTwoAtOnce) {
  GoalFlight flight;
  flight.mission.waypoints_world = {{0, -5, 2}, {0.1, -5, 2}};
  const TrialRecord record = flight.fly();
  const std::vector<double> times_s = goal_times_s(flight.spec.mission, flight.mission, record);
  ASSERT_EQ(times_s.size(), 3U);
  EXPECT_NEAR(times_s[1], times_s[0], 0.1);
  // From the start on, too.
  flight.mission.waypoints_world = {flight.mission.start_world};
  const TrialRecord begun = flight.fly();
  EXPECT_EQ(goal_times_s(flight.spec.mission, flight.mission, begun).front(), 0.0);
}

TEST(FlightsOfSeveralGoals, SayWhichOneWasMissed) {
  GoalFlight flight;
  flight.spec.mission.time_limit_s = 6.0;
  flight.mission.waypoints_world = {{0, -10, 2}};
  const TrialRecord record = flight.fly();
  EXPECT_EQ(record.outcome, Outcome::timed_out);
  EXPECT_NE(record.reason.find(" m from goal 2 of 2 at the time limit"), std::string::npos)
      << record.reason;
  EXPECT_EQ(goal_times_s(flight.spec.mission, flight.mission, record).size(), 1U);
}

TEST(FlightsOfSeveralGoals, DoNotReachAGoalInAContact) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({0.5F, 0.5F, 4}), {0, 0.2, 2}, "post");
  GoalFlight flight(std::move(world));
  flight.spec.mission.goal_radius_m = 0.05;
  // Where the vehicle's centre is when its body touches the post: 0.2 - 0.25 - half of the body.
  flight.mission.waypoints_world = {{0, -1, 2}, {0, 0, 2}};
  const TrialRecord record = flight.fly();
  ASSERT_EQ(record.outcome, Outcome::collided);
  EXPECT_EQ(goal_times_s(flight.spec.mission, flight.mission, record).size(), 1U);
  // As if a goal lay where the flight ended: it has only been touched.
  MissionSpec rules;
  rules.goal_radius_m = 1e-9;
  Mission mission;
  mission.waypoints_world = {record.samples.front().position_world,
                             record.samples.back().position_world};
  EXPECT_EQ(goal_times_s(rules, mission, record).size(), 1U);
}

TEST(FlightsToAMovingGoal, EndWhereItIs) {
  GoalFlight flight;
  flight.spec.mission.goal_motion = {.path = GoalPath::circle, .speed_mps = 1.0, .extent_m = 8.0};
  const TrialRecord record = flight.fly();
  ASSERT_EQ(record.outcome, Outcome::reached_goal);
  const GoalWay way = last_goal_way(flight.spec.mission, flight.mission);
  const Vector3d end = record.samples.back().position_world;
  const double away_m = (end - place_at(way, record.end_time_s)).head<2>().norm();
  EXPECT_LE(away_m, 0.8);
  EXPECT_GT((end - flight.mission.goal_world).norm(), 1.0);  // it has left its place
  for (std::size_t i = 1; i < flight.shown.size(); ++i) {
    const double step_m = (flight.shown[i].place_world - flight.shown[i - 1].place_world).norm();
    EXPECT_NEAR(step_m, 1.0 / 30.0, 2e-4);
  }
}

TEST(FlightsToOneGoal, AreTheSameWhetherItIsShown) {
  GoalFlight flight;
  const TrialRecord shown = flight.fly(), bare = flight.fly(AB_INPUT_STATE);
  EXPECT_TRUE(flight.shown.empty());
  ASSERT_EQ(shown.samples.size(), bare.samples.size());
  EXPECT_EQ(shown.samples.back().position_world, bare.samples.back().position_world);
  EXPECT_EQ(shown.reason, bare.reason);
}

TEST(GoalsDemand, NamesWhatAsksForTheInput) {
  Mission mission = test::straight_mission();
  EXPECT_EQ(goals_demand({}, mission), "");
  EXPECT_EQ(goals_demand(moving(GoalPath::line), mission), "a goal that moves");
  mission.waypoints_world = {{0, 0, 2}};
  EXPECT_EQ(goals_demand({}, mission), "several goals");
}

}  // namespace
}  // namespace avoidbench
