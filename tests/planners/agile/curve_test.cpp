#include "curve.hpp"

#include <gtest/gtest.h>

namespace agile {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;

Situation turned_situation() {
  Situation situation;
  situation.frame.yaw_rad = 0.7;
  situation.start = {{3.0, -2.0, 1.5}, {1.0, 2.0, -0.3}, {0.5, -1.0, 0.2}};
  situation.goal_world = {20.0, 10.0, 2.0};
  situation.desired_speed_mps = 3.0;
  return situation;
}

/// A curve that begins with the start's motion is its own projection.
TEST(Projection, OfPointsOnSuchACurveIsThatCurve) {
  const Situation situation = turned_situation();
  const Motion end{{7.0, 1.0, 2.0}, {2.0, 1.0, 0.0}, {0.3, 0.0, -0.4}};
  const Quintic curve = quintic_between(situation.start, end, kHorizon_s);
  const Quintic again = projected(situation, points_of(situation, curve));
  EXPECT_DOUBLE_EQ(again.duration_s, kHorizon_s);
  // The points are floats.
  for (int i = 0; i <= 20; ++i) {
    const Motion a = motion_at(curve, 0.1 * i), b = motion_at(again, 0.1 * i);
    EXPECT_LT((a.position - b.position).norm(), 2e-6);
    EXPECT_LT((a.velocity - b.velocity).norm(), 2e-5);
  }
}

TEST(Projection, BeginsWithTheStartWhateverThePoints) {
  const Situation situation = turned_situation();
  ModePoints points{};
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {float(i % 3), -0.5F, float(i)};
  const Motion begin = motion_at(projected(situation, points), 0.0);
  EXPECT_EQ(begin.position, situation.start.position);
  EXPECT_EQ(begin.velocity, situation.start.velocity);
  EXPECT_TRUE(begin.acceleration.isApprox(situation.start.acceleration));
}

/// No other curve of the family is nearer to the points.
TEST(Projection, IsTheNearest) {
  const Situation situation = turned_situation();
  ModePoints points{};
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {0.1F * float(i), 0.3F, -0.1F};
  const auto off = [&](const Quintic& curve) {
    const ModePoints at = points_of(situation, curve);
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = double(at[i][axis]) - double(points[i][axis]);
        sum += d * d;
      }
    }
    return sum;
  };
  const Quintic best = projected(situation, points);
  for (int power = 3; power <= 5; ++power) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-2, 1e-2}) {
        Quintic other = best;
        other.coefficients(axis, power) += step;
        EXPECT_GT(off(other), off(best)) << power << ", " << axis;
      }
    }
  }
}

TEST(Demand, OfKnownMotions) {
  Quintic curve;
  curve.duration_s = 2.0;
  curve.coefficients.col(1) = Vector3d(3.0, 0.0, 0.0);
  curve.coefficients.col(2) = Vector3d(0.0, 1.0, 0.0);  // 2 m/s²
  const Demand demand = demand_of(curve);
  EXPECT_NEAR(demand.speed_mps, 5.0, 1e-12);  // 3 and 4 at the end
  EXPECT_NEAR(demand.acceleration_mps2, 2.0, 1e-12);
  EXPECT_NEAR(demand.jerk_mps3, 0.0, 1e-12);
  curve.coefficients(2, 3) = 0.5;
  EXPECT_NEAR(demand_of(curve).jerk_mps3, 3.0, 1e-12);
}

}  // namespace
}  // namespace agile
