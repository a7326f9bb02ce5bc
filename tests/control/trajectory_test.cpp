#include "control/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/flights.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Reference polynomial(double t) {
  const Vector3d a(1, -2, 0.5), b(0.3, 0.1, -0.2), c(0.05, -0.04, 0.02), d(0.01, 0.02, -0.03);
  Reference r;
  r.position_world = a * t + b * t * t + c * t * t * t + d * std::pow(t, 5);
  r.velocity_world = a + 2 * b * t + 3 * c * t * t + 5 * d * std::pow(t, 4);
  r.acceleration_world = 2 * b + 6 * c * t + 20 * d * t * t * t;
  r.jerk_world = 6 * c + 60 * d * t * t;
  r.yaw_rad = 1 + 0.5 * t - 0.2 * t * t + 0.05 * t * t * t;
  r.yaw_rate_radps = 0.5 - 0.4 * t + 0.15 * t * t;
  return r;
}

std::vector<TrajectoryPoint> points_of(const std::vector<double>& times) {
  std::vector<TrajectoryPoint> points;
  for (const double t : times) {
    const Reference r = polynomial(t);
    points.push_back({t, r.position_world, r.velocity_world, r.acceleration_world, r.jerk_world,
                      r.yaw_rad, r.yaw_rate_radps});
  }
  return points;
}

TEST(Trajectory, QuinticsAndCubicsAreReproduced) {
  const auto points = points_of({0.0, 0.4, 1.5, 2.0});
  std::size_t piece = 0;
  for (const double t : {0.1, 0.39, 0.4, 0.9, 1.7, 0.2, 1.99}) {
    const Reference got = sample_trajectory(points, t, piece), want = polynomial(t);
    EXPECT_LT((got.position_world - want.position_world).norm(), 1e-12);
    EXPECT_LT((got.velocity_world - want.velocity_world).norm(), 1e-12);
    EXPECT_LT((got.acceleration_world - want.acceleration_world).norm(), 1e-11);
    EXPECT_LT((got.jerk_world - want.jerk_world).norm(), 1e-10);
    EXPECT_NEAR(got.yaw_rad, want.yaw_rad, 1e-12);
    EXPECT_NEAR(got.yaw_rate_radps, want.yaw_rate_radps, 1e-12);
  }
}

TEST(Trajectory, EndsAreTheEndPoints) {
  const auto points = points_of({0.5, 1.0});
  std::size_t piece = 0;
  EXPECT_EQ(sample_trajectory(points, 0.0, piece).position_world, points[0].position_world);
  EXPECT_EQ(sample_trajectory(points, 7.0, piece).position_world, points[1].position_world);
}

TEST(Trajectory, YawGoesTheShortWay) {
  std::vector<TrajectoryPoint> points(2);
  points[0].yaw_rad = 3.0;
  points[1].yaw_rad = -3.0;
  points[1].time_s = 1.0;
  std::size_t piece = 0;
  EXPECT_NEAR(sample_trajectory(points, 0.5, piece).yaw_rad, M_PI, 1e-12);
}

TEST(Command, ProblemsAreNamed) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(command_problem(fly_at({1, 2, 3})), "");
  EXPECT_EQ(command_problem(fly_at({1, nan, 3})), "velocity is not finite");
  EXPECT_EQ(command_problem(go_to({1, 2, 3}, nan)), "yaw is not finite or beyond 1e5");
  Command command = circle(2, 3, 1, 0.1);
  EXPECT_EQ(command_problem(command), "");
  command.trajectory[3].velocity_world.x() = nan;
  EXPECT_EQ(command_problem(command), "trajectory point 3 is not finite");
  command = circle(2, 3, 1, 0.1);
  command.trajectory[4].time_s = 0.3;
  EXPECT_EQ(command_problem(command), "trajectory point 4 is not later than the one before");
  command.trajectory.resize(2);
  EXPECT_EQ(command_problem(command), "");
  command.trajectory.resize(1);
  EXPECT_EQ(command_problem(command), "a trajectory of fewer than two points");
  command.kind = CommandKind::rates;
  command.thrust_mps2 = nan;
  EXPECT_EQ(command_problem(command), "rates or thrust are not finite");
  command = fly_at({0, 0, 0});
  command.horizon_s = -1;
  EXPECT_EQ(command_problem(command), "horizon_s is negative or not finite");
}

}  // namespace
}  // namespace avoidbench
