#include "control/position_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "control/perfect_tracking.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A smooth path with known derivatives.
Reference lissajous(double t) {
  Reference r;
  const Vector3d size(3, 2, 1), rate(1.1, 1.7, 0.9), phase(0.3, 1.0, 2.0);
  for (int i = 0; i < 3; ++i) {
    const double w = rate[i], s = std::sin(w * t + phase[i]), c = std::cos(w * t + phase[i]);
    r.position_world[i] = size[i] * s;
    r.velocity_world[i] = size[i] * w * c;
    r.acceleration_world[i] = -size[i] * w * w * s;
    r.jerk_world[i] = -size[i] * w * w * w * c;
  }
  r.yaw_rad = 0.4 * t + 0.5 * std::sin(t);
  r.yaw_rate_radps = 0.4 + 0.5 * std::cos(t);
  return r;
}

TEST(FlatState, FollowsThePathUnderDrag) {
  const Vector3d drag(0.3, 0.2, 0.1);
  for (double t = 0; t < 6; t += 0.37) {
    const Reference r = lissajous(t);
    const FlatState flat = flat_state(r, drag, 9.81);
    const Matrix3d& R = flat.R_world_body;
    EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-12);
    const Vector3d acceleration = flat.thrust_mps2 * R.col(2) - 9.81 * Vector3d::UnitZ() -
                                  R * drag.cwiseProduct(R.transpose() * r.velocity_world);
    EXPECT_LT((acceleration - r.acceleration_world).norm(), 1e-10);
  }
}

TEST(FlatState, RatesAreTheAttitudesDerivative) {
  for (const Vector3d& drag : {Vector3d(0, 0, 0), Vector3d(0.3, 0.2, 0.1), Vector3d(0.2, 0.2, 0)}) {
    for (double t = 0; t < 6; t += 0.37) {
      constexpr double h = 1e-5;
      const Matrix3d before = flat_state(lissajous(t - h), drag, 9.81).R_world_body;
      const Matrix3d after = flat_state(lissajous(t + h), drag, 9.81).R_world_body;
      const FlatState flat = flat_state(lissajous(t), drag, 9.81);
      const Matrix3d hat = flat.R_world_body.transpose() * (after - before) / (2 * h);
      const Vector3d rates(hat(2, 1), hat(0, 2), hat(1, 0));
      EXPECT_LT((rates - flat.rates_body_radps).norm(), 1e-7) << t << ' ' << drag.transpose();
    }
  }
}

TEST(PerfectTracking, TheStateIsThatOfItsReference) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState before = hovering_at(model.spec, {9, 9, 9}, 0.0);
  before.tick = 360;
  const Reference reference = lissajous(1.3);
  const VehicleState on = state_on(reference, model, before);
  EXPECT_EQ(on.tick, 360);
  EXPECT_EQ(on.position_world, reference.position_world);
  EXPECT_EQ(on.velocity_world, reference.velocity_world);
  const FlatState flat = flat_state(reference, model.drag_per_s, model.spec.gravity_mps2);
  EXPECT_LT((on.q_world_body.toRotationMatrix() - flat.R_world_body).norm(), 1e-12);
  EXPECT_EQ(on.rates_body, flat.rates_body_radps);
  EXPECT_GT(on.rates_body.norm(), 0.1);
  // The thrust of rotors at these speeds, over the mass.
  double thrust_n = 0.0;
  for (const double speed : on.rotor_speed_radps) {
    thrust_n += model.spec.thrust_coefficient_ns2 * speed * speed;
  }
  EXPECT_NEAR(thrust_n / model.spec.mass_kg, flat.thrust_mps2, 1e-9);
}

TEST(PositionControl, AsksForNothingButHoverAtItsReference) {
  const VehicleModel model = make_model(hummingbird_spec());
  const VehicleState state = hovering_at(model.spec, {1, 2, 3}, 0.8);
  Reference reference;
  reference.position_world = {1, 2, 3};
  reference.yaw_rad = 0.8;
  const RateTarget target = position_control(model, state, reference);
  EXPECT_LT(target.rates_body_radps.norm(), 1e-12);
  EXPECT_NEAR(target.thrust_mps2, 9.81, 1e-12);
}

TEST(PositionControl, GainsAreAsStated) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0);
  Reference reference;
  reference.position_world = {0.1, 0, 0.02};
  state.velocity_world = {-0.02, 0, 0.1};
  const RateTarget target = position_control(model, state, reference);
  const double ax = 10 * 0.1 + 4 * 0.02, az = 15 * 0.02 - 6 * 0.1 + 9.81;
  EXPECT_NEAR(target.thrust_mps2, az, 1e-12);
  EXPECT_NEAR(target.rates_body_radps.y(), 2 * 12 * std::sin(0.5 * std::atan2(ax, az)), 1e-12);
  EXPECT_NEAR(target.rates_body_radps.x(), 0.0, 1e-12);
}

TEST(PositionControl, KeepsTheLimits) {
  VehicleSpec spec = hummingbird_spec();
  spec.max_tilt_rad = 0.3;
  const VehicleModel model = make_model(spec);
  VehicleState state = hovering_at(spec, {0, 0, 0}, 0);
  Reference reference;
  reference.position_world = {100, 0, 0};
  const RateTarget tilting = position_control(model, state, reference);
  EXPECT_NEAR(tilting.rates_body_radps.y(), 2 * 12 * std::sin(0.15), 1e-9);
  reference.position_world.setZero();
  reference.yaw_rad = 2.0;
  EXPECT_EQ(position_control(model, state, reference).rates_body_radps.z(),
            spec.max_rates_radps[2]);
  reference.acceleration_world = {0, 0, 1000};
  EXPECT_NEAR(position_control(model, state, reference).thrust_mps2,
              4 * model.max_rotor_thrust_n / spec.mass_kg, 1e-9);
  reference.acceleration_world = {0, 0, -1000};
  EXPECT_EQ(position_control(model, state, reference).thrust_mps2, 1.0);
}

TEST(PositionControl, FindsItsWayFromUpsideDown) {
  const VehicleModel model = make_model(hummingbird_spec());
  for (const Eigen::Quaterniond& q :
       {Eigen::Quaterniond(0, 1, 0, 0), Eigen::Quaterniond(0, 0, 1, 0),
        Eigen::Quaterniond(0.1, 0.9, 0.3, -0.2)}) {
    VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0);
    state.q_world_body = q.normalized();
    const RateTarget target = position_control(model, state, Reference{});
    EXPECT_TRUE(target.rates_body_radps.allFinite());
    EXPECT_GT(target.rates_body_radps.norm(), 3.0);
  }
}

}  // namespace
}  // namespace avoidbench
