#include "wind/gust.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

using Eigen::Vector3d;

GustSpec one_gust() {
  GustSpec gust;
  gust.amplitude_world_mps = {3, -4, 1};
  gust.start_s = 2.0;
  gust.rise_s = 0.8;
  gust.hold_s = 0.5;
  return gust;
}

TEST(Gust, ProfileIsARaisedCosine) {
  const GustSpec gust = one_gust();
  EXPECT_EQ(gust_profile(gust, -1.0), 0.0);
  EXPECT_EQ(gust_profile(gust, 0.0), 0.0);
  EXPECT_NEAR(gust_profile(gust, 0.2), 0.5 * (1 - std::cos(M_PI * 0.2 / 0.8)), 1e-15);
  EXPECT_NEAR(gust_profile(gust, 0.4), 0.5, 1e-15);
  EXPECT_EQ(gust_profile(gust, 0.8), 1.0);
  EXPECT_EQ(gust_profile(gust, 1.2), 1.0);
  EXPECT_NEAR(gust_profile(gust, 1.7), 0.5, 1e-15);
  EXPECT_EQ(gust_profile(gust, 2.1), 0.0);
  EXPECT_EQ(gust_profile(gust, 9.0), 0.0);
}

TEST(Gust, IntegralIsAmplitudeTimesRiseAndHold) {
  const GustSpec gust = one_gust();
  Vector3d integral = Vector3d::Zero();
  for (int i = 0; i < 10000; ++i) integral += 1e-3 * gust_velocity_world(gust, 1, i * 1e-3);
  EXPECT_LT((integral - 1.3 * Vector3d(3, -4, 1)).norm(), 1e-6);
}

TEST(Gust, RepeatsEachPeriod) {
  GustSpec gust = one_gust();
  gust.period_s = 4.0;
  for (const double t : {2.3, 2.9, 3.6, 5.0}) {
    const Vector3d first = gust_velocity_world(gust, 1, t);
    EXPECT_LT((gust_velocity_world(gust, 1, t + 12.0) - first).norm(), 1e-12);
  }
  EXPECT_EQ(gust_velocity_world(gust, 1, 1.9), Vector3d::Zero());
  EXPECT_EQ(gust_velocity_world(gust, 1, 5.5), Vector3d::Zero());
}

TEST(Gust, JitterAndHeadingAreDrawnByTheGustsNumber) {
  GustSpec gust = one_gust();
  gust.period_s = 10.0;
  gust.start_jitter_s = 3.0;
  gust.random_heading = true;
  double least = 10.0, most = 0.0;
  Vector3d sum = Vector3d::Zero();
  constexpr int kGusts = 400;
  for (int k = 0; k < kGusts; ++k) {
    const double begin = gust.start_s + k * gust.period_s;
    double first = -1.0;
    Vector3d peak = Vector3d::Zero();
    for (double t = 0.005; t < 10.0; t += 0.01) {
      const Vector3d v = gust_velocity_world(gust, 7, begin + t);
      if (first < 0.0 && v.norm() > 0.0) first = t;
      if (v.norm() > peak.norm()) peak = v;
    }
    least = std::min(least, first);
    most = std::max(most, first);
    EXPECT_NEAR(peak.head<2>().norm(), 5.0, 1e-9);
    EXPECT_NEAR(peak.z(), 1.0, 1e-9);
    sum += peak;
  }
  EXPECT_LT(least, 0.1);
  EXPECT_GT(most, 2.9);
  EXPECT_LE(most, 3.02);
  EXPECT_LT(sum.head<2>().norm() / kGusts, 4 * 5.0 / std::sqrt(kGusts));
  EXPECT_EQ(gust_velocity_world(gust, 7, 15.0), gust_velocity_world(gust, 7, 15.0));
  EXPECT_NE(gust_velocity_world(gust, 7, 5.3), gust_velocity_world(gust, 8, 5.3));
}

}  // namespace
}  // namespace avoidbench
