#include "planning/trajectory_command.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "avoidbench/planner_eigen.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

TEST(Heading, TurnsTheShorterWayWithinItsLimitsAndStopsThere) {
  const HeadingLimits limits{1.5, 5.0};
  for (const double wanted : {0.3, 2.9, -2.9, 3.5, 40.0}) {
    Heading now{0.2, 0.0};
    double turned_rad = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Heading next = turned(now, wanted, limits, 0.01);
      EXPECT_LE(std::abs(next.rate_radps), 1.5 + 1e-12);
      EXPECT_LE(std::abs(next.rate_radps - now.rate_radps), 0.05 + 1e-12);
      turned_rad += std::abs(next.yaw_rad - now.yaw_rad);
      now = next;
    }
    EXPECT_NEAR(std::remainder(now.yaw_rad - wanted, 2.0 * M_PI), 0.0, 1e-3) << wanted;
    EXPECT_LE(turned_rad, M_PI + 0.1) << wanted;
    EXPECT_NEAR(turned_rad, std::abs(std::remainder(wanted - 0.2, 2.0 * M_PI)), 0.05) << wanted;
  }
}

TEST(Stopping, EndsAtRestWithinTheDeceleration) {
  const Motion from{Vector3d(1, 2, 3), Vector3d(3, 0, 0.5), Vector3d::Zero()};
  const Quintic stop = stopping(from, 4.0);
  const Motion end = motion_at(stop, stop.duration_s);
  EXPECT_NEAR(end.velocity.norm(), 0.0, 1e-9);
  EXPECT_NEAR(end.acceleration.norm(), 0.0, 1e-9);
  for (double part = 0.0; part <= 1.0; part += 0.01) {
    EXPECT_LE(motion_at(stop, part * stop.duration_s).acceleration.norm(), 4.0 + 1e-9);
    // It never turns back.
    EXPECT_GE(motion_at(stop, part * stop.duration_s).velocity.dot(from.velocity), -1e-9);
  }
  // v T / 2 with T = 1.5 v / a
  EXPECT_NEAR((end.position - from.position).norm(), 0.75 * from.velocity.squaredNorm() / 4.0,
              1e-9);
}

TimedMotion straight(double speed, double duration_s) {
  return {[speed](double t) {
            return Motion{Vector3d(0, speed * t, 1), Vector3d(0, speed, 0), Vector3d::Zero()};
          },
          duration_s};
}

TEST(TrajectoryPoints, SampleTheMotionAndComeToRest) {
  const TimedMotion motion = with_stop(straight(2.0, 1.0), 4.0);
  const auto points = trajectory_points(motion, 0.25, 0.1, {0.0, 0.0}, LookAhead{});
  ASSERT_GE(points.size(), 2U);
  EXPECT_EQ(points.front().time_s, 0.0);
  EXPECT_NEAR(points.front().position_world_m[1], 0.5, 1e-12);
  EXPECT_NEAR(points[3].position_world_m[1], 1.1, 1e-12);
  EXPECT_NEAR(points.back().velocity_world_mps[1], 0.0, 1e-9);
  EXPECT_GE(points.back().time_s, motion.duration_s - 0.25 - 1e-9);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].time_s, points[i - 1].time_s);
}

TEST(TrajectoryPoints, TurnTowardTheWayOrWhereTold) {
  const TimedMotion motion = with_stop(straight(2.0, 4.0), 4.0);
  const auto along = trajectory_points(motion, 0.0, 0.1, {0.0, 0.0}, LookAhead{});
  EXPECT_NEAR(along[30].yaw_rad, M_PI / 2, 0.01);
  EXPECT_NEAR(heading_at(along, 3.0).yaw_rad, M_PI / 2, 0.01);
  const auto told = trajectory_points(motion, 0.0, 0.1, {0.0, 0.0}, LookAhead{}, -1.0);
  EXPECT_NEAR(told[30].yaw_rad, -1.0, 0.01);
  // Half way between two points.
  EXPECT_NEAR(heading_at(along, 0.25).yaw_rad, 0.5 * (along[2].yaw_rad + along[3].yaw_rad), 1e-12);
  EXPECT_EQ(heading_at(along, 1e3).rate_radps, 0.0);
}

TEST(TrajectoryPoints, OfAMotionThatIsOverStayAtItsEnd) {
  const TimedMotion motion = with_stop(straight(2.0, 1.0), 4.0);
  const auto points = trajectory_points(motion, 100.0, 0.1, {0.5, 0.0}, LookAhead{});
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(avoidbench::as_vector(points[0].position_world_m),
            avoidbench::as_vector(points[1].position_world_m));
  EXPECT_EQ(points[1].yaw_rad, 0.5);
}

}  // namespace
}  // namespace planning
