#include <gtest/gtest.h>

#include <cmath>

#include "planners/support/trajectory_flight.hpp"
#include "planners/support/trajectory_suite.hpp"

namespace avoidbench::kinematic {
namespace {

const TrajectoryPlanner kMbplanner{.name = "mbplanner",
                                   .file = PLANNER_FILE,
                                   .speed_limit_mps = 3.003,
                                   .detour = 1.03,
                                   .height_band_m = 0.5,
                                   .published_speed_limit_mps = 1.001,
                                   .is_random = true};

INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlight, testing::Values(kMbplanner), name_of);
INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlightSlow, testing::Values(kMbplanner), name_of);

/// Through a gap that only its tightest box fits in it creeps: a stop before it is free.
TEST(Mbplanner, SqueezesThroughANarrowGapSlowly) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-8.275, 15.0}, {-0.775, 15.0});
  add_hedge(course, {0.775, 15.0}, {8.275, 15.0});
  const TrajectoryResult result = fly_trajectories(planner, course);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  const std::vector<Eigen::Vector3d>& places = result.flight.positions;
  int count_in_gap = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const bool is_in_gap = std::abs(places[i].y() - 15.0) < 0.3 && std::abs(places[i].x()) < 0.8;
    if (!is_in_gap) continue;
    ++count_in_gap;
    EXPECT_LT(30.0 * (places[i] - places[i - 1]).norm(), 1.2) << places[i].transpose();
  }
  EXPECT_GT(count_in_gap, 10);  // not around the hedge
}

TEST(Mbplanner, GetsOutOfADeadEnd) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-3.0, 16.0}, {3.0, 16.0});
  add_hedge(course, {-3.0, 12.0}, {-3.0, 16.0});
  add_hedge(course, {3.0, 12.0}, {3.0, 16.0});
  const TrajectoryResult result = fly_trajectories(planner, course, 90.0);
  EXPECT_EQ(result.flight.ending, Ending::reached_goal) << result.flight.reason;
  EXPECT_LE(result.demands.speed_mps, kMbplanner.speed_limit_mps);
}

}  // namespace
}  // namespace avoidbench::kinematic
