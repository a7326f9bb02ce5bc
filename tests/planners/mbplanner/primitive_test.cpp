#include "primitive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planning/random.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;

TEST(Primitive, IsConstantAccelerationBelowTheSpeedLimit) {
  Motion from{Vector3d(1, 2, 3), Vector3d(0.5, -0.2, 0.1), Vector3d(0.6, 0.8, -0.1)};
  const Limits limits{5.0, 4.0, 20.0};
  const std::vector<Motion> knots = rolled_out(from, from.acceleration, limits, 20);
  ASSERT_EQ(knots.size(), 20U);
  const double t = 1.0;
  const Vector3d expected = from.position + t * from.velocity + 0.5 * t * t * from.acceleration;
  EXPECT_LT((knots.back().position - expected).norm(), 1e-12);
  EXPECT_LT((knots.back().velocity - from.velocity - t * from.acceleration).norm(), 1e-12);
}

/// That knots keep the limits between them too: the host joins them with quintics.
void expect_within(const std::vector<Motion>& knots, const Motion& from, const Limits& limits) {
  Motion before = from;
  for (const Motion& knot : knots) {
    const planning::Quintic piece = planning::quintic_between(before, knot, kStep_s);
    for (double t = 0.0; t <= kStep_s; t += kStep_s / 4) {
      const Motion at = planning::motion_at(piece, t);
      ASSERT_LE(at.velocity.norm(), limits.speed_mps + 1e-6);
      ASSERT_LE(at.acceleration.norm(), limits.acceleration_mps2 + 1e-6);
    }
    ASSERT_LE((knot.acceleration - before.acceleration).norm(), limits.jerk_mps3 * kStep_s + 1e-6);
    before = knot;
  }
}

TEST(Primitive, KeepsSpeedAccelerationAndJerkWhateverPullsFollow) {
  planning::Random random(4);
  const Limits limits{3.0, 4.0, 20.0};
  Motion from;
  for (int i = 0; i < 500; ++i) {
    Vector3d pull;
    for (double& part : pull) part = random.uniform(-1.0, 1.0);
    pull *= random.uniform() * 4.0 / pull.norm();
    const std::vector<Motion> knots = rolled_out(from, pull, limits, 18);
    expect_within(knots, from, limits);
    from = knots.back();
  }
}

/// At a pull that would lead beyond it, to 0.95 of the limit, and it stays there.
TEST(Primitive, GoesUpToItsSpeed) {
  const Limits limits{3.0, 4.0, 20.0};
  const std::vector<Motion> knots = rolled_out(Motion(), Vector3d(4.0, 0.0, 0.0), limits, 80);
  for (std::size_t i = 40; i < knots.size(); ++i) {
    EXPECT_NEAR(knots[i].velocity.x(), 0.95 * 3.0, 0.05) << i;
  }
}

/// What is beside the way is pulled for as before, also at full speed.
TEST(Primitive, TurnsAtItsSpeed) {
  const Motion from{Vector3d::Zero(), Vector3d(0.95 * 3.0, 0.0, 0.0), Vector3d::Zero()};
  const Motion to = stepped(from, Vector3d(4.0, 0.5, 0.0), {3.0, 4.0, 20.0});
  EXPECT_NEAR(to.acceleration.x(), 0.0, 1e-9);
  EXPECT_NEAR(to.acceleration.y(), 0.5, 1e-9);
}

TEST(Stop, EndsAtRestAtTheDistanceOfABrakeWithRamps) {
  const Motion from{Vector3d(1, 2, 3), Vector3d(3, 0, 0), Vector3d::Zero()};
  const std::vector<Motion> knots = stop_from(from, 4.0, {3.0, 5.7, 20.0});
  EXPECT_EQ(knots.back().velocity.norm(), 0.0);
  // v² / 2a + v a / 2j, with nine tenths of the jerk.
  const double way_m = (knots.back().position - from.position).norm();
  EXPECT_NEAR(way_m, 9.0 / 8.0 + 12.0 / 36.0, 0.06);
  expect_within(knots, from, {3.0, 4.0, 20.0});
}

TEST(Stop, GoesOnAsBeforeWhenBrakedAgain) {
  const Motion from{Vector3d(1, 2, 3), Vector3d(2.9, 0.4, 0), Vector3d(0.5, -1, 0)};
  const Limits limits{3.0, 5.7, 20.0};
  const std::vector<Motion> once = stop_from(from, 5.0, limits);
  ASSERT_GT(once.size(), 10U);
  Motion now = from;
  for (std::size_t i = 0; i + 8 < once.size(); i += 2) {
    now = stop_from(now, 5.0, limits)[1];
    EXPECT_LT((now.position - once[i + 1].position).norm(), 0.02);
  }
}

TEST(Stop, KeepsTheJerkWhateverTheMotion) {
  planning::Random random(7);
  for (int i = 0; i < 300; ++i) {
    Motion from;
    for (double& part : from.velocity) part = random.uniform(-1.7, 1.7);
    for (double& part : from.acceleration) part = random.uniform(-2.0, 2.0);
    const std::vector<Motion> knots = stop_from(from, 4.0, {3.0, 5.7, 20.0});
    EXPECT_EQ(knots.back().velocity.norm(), 0.0);
    Motion before = from;
    for (const Motion& knot : knots) {
      ASSERT_LE((knot.acceleration - before.acceleration).norm(), 20.0 * kStep_s + 1e-6);
      ASSERT_LE(knot.acceleration.norm(), 5.7 * 1.02);
      before = knot;
    }
  }
}

TEST(StopAt, EndsAtThePlaceWithinTheLimits) {
  const Motion from{Vector3d::Zero(), Vector3d(2.5, 0.3, 0), Vector3d(0, 1, 0)};
  const Limits limits{3.0, 4.0, 20.0};
  const std::vector<Motion> knots = stop_at(from, {6.0, 1.0, 0.3}, limits);
  ASSERT_FALSE(knots.empty());
  EXPECT_LT((knots.back().position - Vector3d(6.0, 1.0, 0.3)).norm(), 1e-9);
  expect_within(knots, from, limits);
}

/// A metre from rest to rest: the quintic's jerk is 60 m / T³ at both ends, so that 20 m/s³ need
/// 1.44 s; durations that are tried are 1.15 times each other, in whole steps. Its speed of
/// 1.875 m / T and its acceleration of 5.77 m / T² need less.
TEST(StopAt, TakesAsLongAsTheJerkWants) {
  const std::vector<Motion> knots = stop_at(Motion(), {0.6, 0.8, 0.0}, {3.0, 4.0, 20.0});
  const double duration_s = kStep_s * static_cast<double>(knots.size());
  EXPECT_GE(duration_s, std::cbrt(60.0 / 20.0));
  EXPECT_LE(duration_s, 1.15 * std::cbrt(60.0 / 20.0) + kStep_s);
}

}  // namespace
}  // namespace mbplanner
