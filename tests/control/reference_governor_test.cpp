#include "control/reference_governor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

struct Extremes {
  double speed = 0, acceleration = 0, jerk = 0, yaw_rate = 0;
};

Reference run(const VehicleModel& model, Reference reference, const GovernorTarget& target,
              double duration_s, Extremes& most, double dt_s = 1e-3) {
  for (int i = 0; i < static_cast<int>(duration_s / dt_s); ++i) {
    reference = governed(model, reference, target, dt_s);
    most.speed = std::max(most.speed, reference.velocity_world.norm());
    most.acceleration = std::max(most.acceleration, reference.acceleration_world.norm());
    most.jerk = std::max(most.jerk, reference.jerk_world.norm());
    most.yaw_rate = std::max(most.yaw_rate, std::abs(reference.yaw_rate_radps));
  }
  return reference;
}

void expect_within(const Extremes& most, const VehicleSpec& spec) {
  EXPECT_LE(most.speed, spec.max_speed_mps * (1 + 1e-3));
  EXPECT_LE(most.acceleration, spec.max_acceleration_mps2 * (1 + 1e-12));
  EXPECT_LE(most.jerk, spec.max_jerk_mps3 * (1 + 1e-12));
  EXPECT_LE(most.yaw_rate, spec.max_yaw_rate_radps * (1 + 1e-3));
}

TEST(BrakingCurve, IsSmoothAndBrakesWithinItsDeceleration) {
  for (const double max_speed : {0.5, 2.0, 8.0, 20.0}) {
    VehicleSpec spec;
    spec.max_speed_mps = max_speed;
    const BrakingCurve curve = make_model(spec).speed_curve;
    Speed before = allowed_speed(curve, 0.0);
    EXPECT_EQ(before.value, 0.0);
    for (double d = 1e-3; d < curve.cap_from + 1; d += 1e-3) {
      const Speed now = allowed_speed(curve, d);
      EXPECT_GE(now.value, before.value);
      EXPECT_LE(now.value, max_speed);
      EXPECT_NEAR(now.value - before.value, 0.5e-3 * (now.slope + before.slope), 1e-5);
      EXPECT_LE(now.value * now.slope, curve.deceleration * (1 + 1e-9));
      before = now;
    }
    EXPECT_EQ(before.value, max_speed);
  }
}

TEST(ReferenceGovernor, PositionStepsKeepTheLimitsAndDoNotOvershoot) {
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    for (const double distance : {0.05, 0.5, 2.0, 10.0, 60.0}) {
      const Vector3d direction = Vector3d(2, -1, 0.5).normalized();
      const GovernorTarget target{GovernorGoal::position, distance * direction, false, 2.5};
      Reference r;
      Extremes most;
      double furthest = 0, sideways = 0;
      for (int i = 0; i < 20000; ++i) {
        r = run(model, r, target, 1e-3, most);
        furthest = std::max(furthest, r.position_world.dot(direction));
        sideways = std::max(sideways, r.position_world.cross(direction).norm());
      }
      expect_within(most, spec);
      EXPECT_LT(furthest, distance * 1.001);
      EXPECT_LT(sideways, 1e-12);
      EXPECT_LT((r.position_world - target.value_world).norm(), 1e-6);
      EXPECT_LT(r.velocity_world.norm(), 1e-6);
      EXPECT_NEAR(r.yaw_rad, 2.5, 1e-6);
    }
  }
}

TEST(ReferenceGovernor, ComesToRestAtRest) {
  const VehicleModel model = make_model(hummingbird_spec());
  const GovernorTarget target{GovernorGoal::position, {3, 4, 5}, false, -1.0};
  Extremes most;
  const Reference r = run(model, {}, target, 60.0, most);
  Extremes later;
  const Reference after = run(model, r, target, 1.0, later);
  EXPECT_LT(later.speed, 1e-12);
  EXPECT_LT(later.jerk, 1e-9);
  EXPECT_LT((after.position_world - r.position_world).norm(), 1e-12);
}

TEST(ReferenceGovernor, VelocitiesAreReachedWithoutOvershoot) {
  const VehicleModel model = make_model(hummingbird_spec());
  for (const double speed : {0.1, 1.0, 4.0, 8.0, 30.0}) {
    Extremes most;
    const Reference r =
        run(model, {}, {GovernorGoal::velocity, {0, speed, 0}, true, 9.0}, 8.0, most);
    expect_within(most, model.spec);
    const double reached = std::min(speed, 8.0);
    EXPECT_NEAR(r.velocity_world.y(), reached, 1e-6 * reached);
    EXPECT_LT(most.speed, 1.001 * reached);
    EXPECT_NEAR(r.yaw_rate_radps, model.spec.max_yaw_rate_radps, 1e-9);
  }
}

TEST(ReferenceGovernor, AccelerationHoldsUntilTheSpeedLimit) {
  const VehicleModel model = make_model(hummingbird_spec());
  const GovernorTarget target{GovernorGoal::acceleration, {2, 0, 0}, true, 0};
  Extremes most;
  const Reference early = run(model, {}, target, 1.5, most);
  EXPECT_NEAR(early.acceleration_world.x(), 2.0, 1e-6);
  const Reference late = run(model, early, target, 10.0, most);
  EXPECT_NEAR(late.velocity_world.x(), 8.0, 1e-6);
  EXPECT_NEAR(late.acceleration_world.norm(), 0.0, 1e-5);
  expect_within(most, model.spec);
  const Reference coasting =
      run(model, early, {GovernorGoal::acceleration, {0, 0, 0}, true, 0}, 2.0, most);
  EXPECT_NEAR(coasting.acceleration_world.norm(), 0.0, 1e-9);
  EXPECT_GT(coasting.velocity_world.x(), 2.5);
}

TEST(ReferenceGovernor, AnyStartSettlesAtAnyTarget) {
  const VehicleModel model = make_model(hummingbird_spec());
  RandomStream random(7);
  const auto any = [&](double size) {
    const double x = random.uniform(-size, size);
    const double y = random.uniform(-size, size);
    const double z = random.uniform(-size, size);
    return Vector3d(x, y, z);
  };
  for (int trial = 0; trial < 60; ++trial) {
    Reference r;
    r.velocity_world = any(4.0);
    r.acceleration_world = any(3.0);
    GovernorTarget target{GovernorGoal::position, any(20.0), false, random.uniform(-3.0, 3.0)};
    Extremes most;
    r = run(model, r, target, 25.0, most, trial % 2 == 0 ? 1e-3 : 4e-3);
    EXPECT_LT((r.position_world - target.value_world).norm(), 1e-6);
    EXPECT_LE(most.jerk, model.spec.max_jerk_mps3 * (1 + 1e-12));
    EXPECT_LE(most.acceleration, model.spec.max_acceleration_mps2 * (1 + 1e-12));
  }
}

TEST(ReferenceGovernor, TurnsTheShortWay) {
  const VehicleModel model = make_model(hummingbird_spec());
  Reference r;
  r.yaw_rad = 3.0;
  Extremes most;
  r = run(model, r, {GovernorGoal::velocity, Vector3d::Zero(), false, -3.0}, 5.0, most);
  EXPECT_NEAR(r.yaw_rad, 2 * M_PI - 3.0, 1e-6);
  EXPECT_LT(most.yaw_rate, 1.0);
}

}  // namespace
}  // namespace avoidbench
