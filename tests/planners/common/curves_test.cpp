#include <gtest/gtest.h>

#include <cmath>

#include "planning/bspline.hpp"
#include "planning/polynomial.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

const Motion kStart{{1, 2, 3}, {1, -0.5, 0.2}, {0.3, 0.1, -0.4}};
const Motion kEnd{{5, 1, 2.5}, {-0.2, 1.0, 0.0}, {0.0, -0.6, 0.2}};

TEST(Quintic, JoinsTwoMotions) {
  const Quintic quintic = quintic_between(kStart, kEnd, 2.7);
  for (const auto& [time_s, motion] : {std::pair(0.0, kStart), std::pair(2.7, kEnd)}) {
    EXPECT_TRUE(motion_at(quintic, time_s).position.isApprox(motion.position, 1e-12));
    EXPECT_TRUE(motion_at(quintic, time_s).velocity.isApprox(motion.velocity, 1e-12));
    EXPECT_LT((motion_at(quintic, time_s).acceleration - motion.acceleration).norm(), 1e-11);
  }
  constexpr double kStep = 1e-5;
  for (double t = 0.1; t < 2.6; t += 0.25) {
    const Vector3d slope =
        (motion_at(quintic, t + kStep).position - motion_at(quintic, t - kStep).position) /
        (2 * kStep);
    EXPECT_LT((slope - motion_at(quintic, t).velocity).norm(), 1e-8);
    const Vector3d bend =
        (motion_at(quintic, t + kStep).velocity - motion_at(quintic, t - kStep).velocity) /
        (2 * kStep);
    EXPECT_LT((bend - motion_at(quintic, t).acceleration).norm(), 1e-8);
  }
}

TEST(Quintic, TrapezoidTimes) {
  EXPECT_NEAR(trapezoid_time_s(10.0, 2.0, 4.0), 5.0 + 0.5, 1e-12);  // 10 / 2 + 2 / 4
  EXPECT_NEAR(trapezoid_time_s(1.0, 10.0, 4.0), 1.0, 1e-12);        // 2 √(1 / 4)
}

Bspline spline_of_quintic(double interval_s, int knots) {
  const Quintic quintic = quintic_between(kStart, kEnd, interval_s * (knots - 1));
  std::vector<Vector3d> way_points;
  for (int i = 0; i < knots; ++i) {
    way_points.push_back(motion_at(quintic, i * interval_s).position);
  }
  return fitted(way_points, interval_s, kStart, kEnd);
}

TEST(Bspline, FitHasItsEndsExactlyAndItsWayPointsNearly) {
  for (const int knots : {4, 5, 8, 20}) {
    const Bspline spline = spline_of_quintic(0.24, knots);
    EXPECT_EQ(spline.points.cols(), knots + 2);
    EXPECT_NEAR(spline.duration_s(), 0.24 * (knots - 1), 1e-12);
    EXPECT_TRUE(position_at(spline, 0.0).isApprox(kStart.position, 1e-12));
    EXPECT_TRUE(velocity_at(spline, 0.0).isApprox(kStart.velocity, 1e-12));
    EXPECT_TRUE(acceleration_at(spline, 0.0).isApprox(kStart.acceleration, 1e-11));
    EXPECT_TRUE(position_at(spline, 1e9).isApprox(kEnd.position, 1e-12));
    EXPECT_LT((velocity_at(spline, 1e9) - kEnd.velocity).norm(), 1e-11);
    EXPECT_LT((acceleration_at(spline, 1e9) - kEnd.acceleration).norm(), 1e-10);
  }
  const Bspline spline = spline_of_quintic(0.24, 20);
  const Quintic quintic = quintic_between(kStart, kEnd, 0.24 * 19);
  for (double t = 0.0; t < spline.duration_s(); t += 0.1) {
    EXPECT_LT((position_at(spline, t) - motion_at(quintic, t).position).norm(), 0.01) << t;
  }
}

TEST(Bspline, DerivativesAreThoseOfThePosition) {
  const Bspline spline = spline_of_quintic(0.3, 9);
  constexpr double kStep = 1e-5;
  for (double t = 0.37 * 0.3; t < spline.duration_s(); t += 0.3) {  // within the knot spans
    const auto slope = [&](const auto& f) {
      return Vector3d((f(spline, t + kStep) - f(spline, t - kStep)) / (2 * kStep));
    };
    EXPECT_LT((slope(position_at) - velocity_at(spline, t)).norm(), 1e-7);
    EXPECT_LT((slope(velocity_at) - acceleration_at(spline, t)).norm(), 1e-6);
    EXPECT_LT((slope(acceleration_at) - jerk_at(spline, t)).norm(), 1e-4);
  }
}

TEST(Bspline, StretchKeepsTheLimits) {
  Bspline spline = spline_of_quintic(0.1, 12);
  const double ratio = stretch_needed(spline, {2.0, 3.0, 1e6});
  ASSERT_GT(ratio, 1.0);
  spline.interval_s *= ratio;
  EXPECT_NEAR(stretch_needed(spline, {2.0, 3.0, 1e6}), 1.0, 1e-9);
  EXPECT_LT(stretch_needed(spline, {2.0, 3.0, 1e6, LimitOf::axes}), 0.99);
  for (double t = 0.0; t < spline.duration_s(); t += 0.01) {
    EXPECT_LE(velocity_at(spline, t).cwiseAbs().maxCoeff(), 2.0 + 1e-9);
    EXPECT_LE(acceleration_at(spline, t).cwiseAbs().maxCoeff(), 3.0 + 1e-9);
  }
}

}  // namespace
}  // namespace planning
