#include "wind/kicks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

using Eigen::Vector3d;

KickSpec six_a_minute() {
  KickSpec spec;
  spec.rate_per_min = 6.0;
  spec.force_n = 4.0;
  spec.torque_nm = 0.05;
  spec.duration_s = 0.125;
  return spec;
}

TEST(Kicks, NumberAndGapsAreThoseOfAPoissonProcess) {
  const auto kicks = make_kicks(six_a_minute(), 9, 36000.0);
  EXPECT_NEAR(static_cast<double>(kicks.size()), 3600.0, 4 * 60.0);
  double sum = 0.0, square = 0.0;
  for (std::size_t i = 1; i < kicks.size(); ++i) {
    ASSERT_GE(kicks[i].from, kicks[i - 1].from);
    const double gap = seconds(kicks[i].from - kicks[i - 1].from);
    sum += gap;
    square += gap * gap;
  }
  const double count = static_cast<double>(kicks.size() - 1);
  const double mean = sum / count;
  EXPECT_NEAR(mean, 10.0, 0.7);
  EXPECT_NEAR(std::sqrt(square / count - mean * mean) / mean, 1.0, 0.1);
}

TEST(Kicks, HaveTheirSizeDurationAndNoPreferredDirection) {
  const auto kicks = make_kicks(six_a_minute(), 9, 36000.0);
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero(), squares = Vector3d::Zero();
  for (const Kick& kick : kicks) {
    EXPECT_EQ(seconds(kick.until - kick.from), 0.125);
    EXPECT_NEAR(kick.force_world_n.norm(), 4.0, 1e-12);
    EXPECT_NEAR(kick.torque_body_nm.norm(), 0.05, 1e-14);
    force += kick.force_world_n / 4.0;
    torque += kick.torque_body_nm / 0.05;
    squares += (kick.force_world_n / 4.0).cwiseAbs2();
  }
  const double count = static_cast<double>(kicks.size());
  EXPECT_LT(force.norm() / count, 4.0 / std::sqrt(count));
  EXPECT_LT(torque.norm() / count, 4.0 / std::sqrt(count));
  EXPECT_LT((squares / count - Vector3d::Constant(1.0 / 3.0)).cwiseAbs().maxCoeff(), 0.03);
}

TEST(Kicks, FollowFromTheSeedAndALongerFlightOnlyAddsMore) {
  const auto kicks = make_kicks(six_a_minute(), 9, 600.0);
  const auto longer = make_kicks(six_a_minute(), 9, 1200.0);
  ASSERT_GT(longer.size(), kicks.size());
  for (std::size_t i = 0; i < kicks.size(); ++i) {
    EXPECT_EQ(kicks[i].from, longer[i].from);
    EXPECT_EQ(kicks[i].force_world_n, longer[i].force_world_n);
  }
  EXPECT_NE(make_kicks(six_a_minute(), 10, 600.0).front().from, kicks.front().from);
}

TEST(Kicks, NoneWithoutRateOrStrength) {
  KickSpec spec = six_a_minute();
  spec.rate_per_min = 0.0;
  EXPECT_TRUE(make_kicks(spec, 1, 1e4).empty());
  spec = six_a_minute();
  spec.force_n = spec.torque_nm = 0.0;
  EXPECT_TRUE(make_kicks(spec, 1, 1e4).empty());
}

}  // namespace
}  // namespace avoidbench
