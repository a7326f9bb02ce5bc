#include <gtest/gtest.h>

#include <cmath>

#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kThrust = 8.54858e-6;

TEST(RotorTorque, RollingMomentAddsUpAgainstTheVelocity) {
  VehicleSpec spec = flat_hummingbird();
  VehicleModel model = make_model(spec);
  VehicleState state = still(model, model.hover_speed_radps[0]);
  state.velocity_world = {10, 0, 0};
  EXPECT_NEAR(-angular_acceleration_body(model, state, {}).x(), 2.6156, 1e-4);
  EXPECT_NEAR(-angular_acceleration_body(model, state, {}).x() * 0.007, 0.018309,
              1e-5 * 0.0183 + 5e-7);
  state.velocity_world = {0, 10, 0};
  EXPECT_NEAR(-angular_acceleration_body(model, state, {}).y(), 2.6156, 1e-4);
  spec.rolling_moment_follows_spin = true;
  model = make_model(spec);
  EXPECT_NEAR(angular_acceleration_body(model, state, {}).norm(), 0.0, 1e-12);
}

TEST(RotorTorque, ClockwisePairYawsCounterClockwise) {
  const VehicleModel model = make_model(without_drag(flat_hummingbird()));
  const double hover = model.hover_speed_radps[0];
  VehicleState state = still(model, hover);
  for (const int i : {0, 2}) state.rotor_speed_radps[i] = hover * std::sqrt(1.1);
  for (const int i : {1, 3}) state.rotor_speed_radps[i] = hover * std::sqrt(0.9);
  EXPECT_NEAR(angular_acceleration_body(model, state, {}).z() * 0.012, 0.011463, 1e-6);
  EXPECT_NEAR(acceleration_world(model, state, {}).norm(), 0.0, 1e-12);
  EXPECT_NEAR(coast(model, state, {}, 1000).rates_body.z(), 0.955212533, 1e-8);
}

TEST(RotorTorque, RollAndPitchSigns) {
  const VehicleModel model = make_model(flat_hummingbird());
  const double hover_n = 0.73103 * 9.8 / 4;
  const auto speeds = [&](int up, int down) {
    VehicleState state = still(model, std::sqrt(hover_n / kThrust));
    state.rotor_speed_radps[up] = std::sqrt((hover_n + 0.1) / kThrust);
    state.rotor_speed_radps[down] = std::sqrt((hover_n - 0.1) / kThrust);
    return angular_acceleration_body(model, state, {});
  };
  EXPECT_NEAR((speeds(1, 3) - Vector3d(4.857142857, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((speeds(2, 0) - Vector3d(0, 4.857142857, 0)).norm(), 0.0, 1e-9);
}

TEST(RotorTorque, SpinningRotorIsAGyroscope) {
  const VehicleModel model = make_model(without_drag(flat_hummingbird()));
  const double hover = model.hover_speed_radps[0];
  EXPECT_NEAR(7.66875e-6 * hover, 3.510171e-3, 1e-9);
  const auto torque_of = [&](const VehicleState& at) {
    VehicleState rolling = at;
    rolling.rates_body = {1, 0, 0};
    const Vector3d change =
        angular_acceleration_body(model, rolling, {}) - angular_acceleration_body(model, at, {});
    return Vector3d(change.cwiseProduct(Vector3d(0.007, 0.007, 0.012)));
  };
  const double momentum = 7.66875e-6 * hover;
  for (int i = 0; i < 4; ++i) {
    VehicleState state = still(model, 0.0);
    state.rotor_speed_radps[i] = hover;
    const double sign = i % 2 == 1 ? 1.0 : -1.0;  // rotors 1 and 3 turn counter-clockwise
    EXPECT_NEAR((torque_of(state) - Vector3d(0, sign * momentum, 0)).norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR(torque_of(still(model, hover)).norm(), 0.0, 1e-12);
}

TEST(RotorTorque, SpinningUpTurnsTheBodyBack) {
  VehicleSpec spec = without_drag(flat_hummingbird());
  spec.motor_reaction_torque = true;
  spec.moment_coefficient_m = 1e-9;  // leaves angular momentum to the rotors and the body alone
  const VehicleModel model = make_model(spec);
  VehicleState state = still(model, 400.0);
  RotorVector command = all_rotors(model, 400.0);
  command[1] = command[3] = 600.0;
  for (int i = 0; i < 500; ++i) state = step(model, state, command, {}, kTicksPerMillisecond);
  EXPECT_NEAR(state.rates_body.z() * 0.012, -2 * 200 * 7.66875e-6, 1e-7);
}

}  // namespace
}  // namespace avoidbench
