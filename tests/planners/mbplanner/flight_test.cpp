#include <gtest/gtest.h>

#include <fstream>

#include "planners/support/conformance_expectation.hpp"
#include "trajectory_flight.hpp"

namespace avoidbench {
namespace {

using kinematic::Course;
using kinematic::Demands;
using kinematic::Ending;
using kinematic::TrajectoryResult;

TEST(Mbplanner, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

/// The vehicle's limits and the common speed limit, on all that was commanded in a flight.
void expect_flyable(const Demands& demands, double speed_mps = 3.0) {
  const PlannerSetup setup = kinematic::vehicle_setup();
  EXPECT_LE(demands.speed_mps, speed_mps * 1.001);
  EXPECT_LE(demands.acceleration_mps2, setup.max_acceleration_mps2);
  EXPECT_LE(demands.yaw_rate_radps, setup.max_yaw_rate_radps);
  EXPECT_LE(demands.body_rate_radps, 4.0);
  EXPECT_LE(demands.jump_m, 1e-3);
  EXPECT_LE(demands.speed_jump_mps, 0.02);
  EXPECT_LE(demands.end_speed_mps, 1e-9);
}

TEST(Mbplanner, FliesNearlyStraightWhereNothingIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const Course course = kinematic::meadow();
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  ASSERT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const double straight_m = (course.goal_world - course.start_world).norm() - 0.8;
  EXPECT_LT(result.flight.path_m, 1.03 * straight_m);
  EXPECT_LT(result.flight.time_s, straight_m / 2.5 + 2.0);
  EXPECT_GT(result.flight.lowest_m, 1.5);
  EXPECT_LT(result.flight.highest_m, 2.5);
  expect_flyable(result.demands);
}

/// Flights of the seeds 0 … count - 1 that reach the goal.
int reached_count(double poisson_radius_m, std::uint64_t count) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  int reached = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const TrajectoryResult result =
        kinematic::fly_trajectories(planner, kinematic::forest(poisson_radius_m, seed));
    EXPECT_NE(result.flight.ending, Ending::failed) << result.flight.reason;
    expect_flyable(result.demands);
    if (result.flight.ending == Ending::reached_goal) {
      ++reached;
    } else {
      std::cout << "seed " << seed << ": "
                << (result.flight.ending == Ending::collided ? "collided" : "timed out") << " at "
                << result.flight.time_s << " s, " << result.flight.positions.back().transpose()
                << '\n';
    }
  }
  return reached;
}

TEST(Mbplanner, ClearsASparseForest) { EXPECT_GE(reached_count(5.0, 6), 6); }

TEST(Mbplanner, IsDecentInADenseForest) { EXPECT_GE(reached_count(2.8, 4), 3); }

/// A row of trees so near each other that nothing passes between.
void add_hedge(Course& course, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double length_m = (to - from).norm();
  for (double s = 0.0; s <= length_m; s += 0.5) {
    course.cylinders.push_back({from + s / length_m * (to - from), 0.25});
  }
}

TEST(Mbplanner, FindsTheGapInAWall) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-8.0, 15.0}, {2.0, 15.0});
  add_hedge(course, {4.5, 15.0}, {8.0, 15.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
}

TEST(Mbplanner, GetsOutOfADeadEnd) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  Course course = kinematic::meadow();
  add_hedge(course, {-3.0, 16.0}, {3.0, 16.0});
  add_hedge(course, {-3.0, 12.0}, {-3.0, 16.0});
  add_hedge(course, {3.0, 12.0}, {3.0, 16.0});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, course, 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_LE(result.demands.speed_mps, 3.003);
}

TEST(Mbplanner, FliesThePublishedPreset) {
  PlannerInstance planner =
      kinematic::instance_of(PLANNER_FILE, {{"preset", ParameterValue{0.0, "published"}}});
  const TrajectoryResult result = kinematic::fly_trajectories(planner, kinematic::meadow(), 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  expect_flyable(result.demands, 1.0);
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4096;
}

TEST(Mbplanner, DoesNotGrowOverFiftyMissions) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  std::size_t before = 0;
  for (int i = 0; i < 50; ++i) {
    Course course = kinematic::forest(4.0, 3);
    course.goal_world.z() += i % 3;  // other heights make other grids
    const TrajectoryResult result = kinematic::fly_trajectories(planner, course, 0.5);
    ASSERT_NE(result.flight.ending, Ending::failed) << result.flight.reason;
    if (i == 10) before = resident_bytes();
  }
  EXPECT_LT(resident_bytes(), before + 4'000'000);
}

TEST(Mbplanner, GivesTheSameFlightForTheSameSeedAlone) {
  const Course course = kinematic::forest(4.0, 3);
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  const auto first = kinematic::fly_trajectories(planner, course, 6.0).flight.positions;
  const auto other = kinematic::fly_trajectories(planner, course, 6.0, 2).flight.positions;
  EXPECT_EQ(first, kinematic::fly_trajectories(planner, course, 6.0).flight.positions);
  EXPECT_NE(first, other);
}

}  // namespace
}  // namespace avoidbench
