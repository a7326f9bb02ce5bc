#include <gtest/gtest.h>

#include <cmath>

#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Eigen::Quaterniond pitched(double angle_rad) {
  return {std::cos(0.5 * angle_rad), 0.0, std::sin(0.5 * angle_rad), 0.0};
}

TEST(FreeMotion, FreeFallIsExact) {
  const VehicleModel model = make_model(flat_hummingbird());
  const VehicleState end = coast(model, still(model, 0.0), {}, 1000);
  EXPECT_NEAR(end.position_world.z(), -4.9, 1e-12);
  EXPECT_NEAR(end.velocity_world.z(), -9.8, 1e-12);
  EXPECT_EQ(acceleration_world(model, end, {}), Vector3d(0, 0, -9.8));
}

TEST(FreeMotion, RotorDragDecaysExponentially) {
  VehicleSpec spec = flat_hummingbird();
  spec.rolling_moment_coefficient_kgm = 0.0;
  const VehicleModel model = make_model(spec);
  const double hover = model.hover_speed_radps[0];
  EXPECT_NEAR(spec.mass_kg / (4 * spec.rotor_drag_coefficient_kg * hover), 4.951149, 1e-6);
  EXPECT_NEAR(model.drag_per_s.x(), 0.2020, 1e-4);
  VehicleState state = still(model, hover);
  state.velocity_world = {5, 0, 0};
  EXPECT_NEAR(coast(model, state, {}, 5000).velocity_world.x(), 1.821337689, 1e-8);

  Environment windy;
  windy.wind_world_mps = {3, -4, 0};
  const VehicleState blown = coast(model, still(model, hover), windy, 5000);
  EXPECT_NEAR(blown.velocity_world.x(), 1.907197387, 1e-8);
  EXPECT_NEAR(blown.velocity_world.y(), -2.542929849, 1e-8);
}

TEST(FreeMotion, TiltedFlightReachesItsTerminalVelocity) {
  const VehicleModel model = make_model(with_fixed_attitude(flat_hummingbird()));
  const double hover = model.hover_speed_radps[0];
  const struct {
    double angle_deg, x_mps, z_mps;
  } cases[] = {{10, 8.361381, -1.474337}, {20, 16.087058, -5.855210}};
  for (const auto& c : cases) {
    const double angle = c.angle_deg * M_PI / 180;
    VehicleState state = still(model, hover * std::sqrt(std::cos(angle)));
    state.q_world_body = pitched(angle);
    const double tau = 0.73103 / (4 * 8.06428e-5 * state.rotor_speed_radps[0]);
    const VehicleState after_tau =
        coast(model, state, {}, static_cast<int>(std::round(tau * 1000)));
    const double elapsed = std::round(tau * 1000) / 1000;
    EXPECT_NEAR(after_tau.velocity_world.x(), c.x_mps * (1 - std::exp(-elapsed / tau)), 2e-6);
    const VehicleState end = coast(model, state, {}, 100000);
    EXPECT_NEAR(end.velocity_world.x(), c.x_mps, 1e-6);
    EXPECT_NEAR(end.velocity_world.z(), c.z_mps, 1e-6);
  }
}

TEST(FreeMotion, LevelCruiseStays) {
  const VehicleModel model = make_model(with_fixed_attitude(flat_hummingbird()));
  const double hover = model.hover_speed_radps[0];
  for (const auto& [angle_deg, speed] :
       {std::pair{5.0, 4.253160}, {10.0, 8.621346}, {20.0, 18.218180}}) {
    const double angle = angle_deg * M_PI / 180;
    VehicleState state = still(model, hover * std::sqrt(std::cos(angle)));
    state.q_world_body = pitched(angle);
    state.velocity_world = {speed, 0, 0};
    // T = m g cos th along body z and the drag along body x balance gravity.
    const VehicleState end = coast(model, state, {}, 5000);
    EXPECT_LT((end.velocity_world - state.velocity_world).norm(), 2e-6);
  }
}

TEST(FreeMotion, AxialVelocityIsUndampedUnlessAsked) {
  VehicleSpec spec = flat_hummingbird();
  const VehicleModel model = make_model(spec);
  VehicleState state = still(model, model.hover_speed_radps[0]);
  state.velocity_world = {0, 0, 2};
  EXPECT_NEAR(coast(model, state, {}, 1000).velocity_world.z(), 2.0, 1e-12);
  spec.rotor_axial_drag_coefficient_kg = spec.rotor_drag_coefficient_kg;
  EXPECT_NEAR(coast(make_model(spec), state, {}, 1000).velocity_world.z(),
              2 * std::exp(-1 / 4.951149), 1e-6);
}

TEST(FreeMotion, QuadraticBodyDragHasItsTerminalVelocity) {
  VehicleSpec spec = flat_hummingbird();
  spec.quadratic_drag_kgpm = {0, 0, 0.05};
  const VehicleModel model = make_model(spec);
  const VehicleState end = coast(model, still(model, 0.0), {}, 20000);
  EXPECT_NEAR(end.velocity_world.z(), -std::sqrt(0.73103 * 9.8 / 0.05), 1e-9);
}

TEST(FreeMotion, SymmetricTopPrecesses) {
  VehicleSpec spec = flat_hummingbird();
  spec.gravity_mps2 = 0.0;
  const VehicleModel model = make_model(spec);
  VehicleState state = still(model, 0.0);
  state.rates_body = {1, 0, 10};
  const Vector3d J(0.007, 0.007, 0.012);
  const double lambda = (0.012 - 0.007) / 0.007 * 10;
  double worst = 0.0, worst_momentum = 0.0;
  const Vector3d momentum(0.007, 0, 0.12);
  for (int i = 1; i <= 10000; ++i) {
    state = step(model, state, all_rotors(model, 0.0), {}, kTicksPerMillisecond);
    const double t = i * 1e-3;
    const Vector3d exact(std::cos(lambda * t), std::sin(lambda * t), 10);
    worst = std::max(worst, (state.rates_body - exact).norm());
    const Vector3d momentum_world = state.q_world_body * Vector3d(J.cwiseProduct(state.rates_body));
    worst_momentum = std::max(worst_momentum, (momentum_world - momentum).norm());
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(worst_momentum, 1e-8);
  EXPECT_NEAR(J.cwiseProduct(state.rates_body).norm(), momentum.norm(), 6e-12);
}

TEST(FreeMotion, ForceChangesMomentum) {
  VehicleSpec spec = flat_hummingbird();
  spec.gravity_mps2 = 0.0;
  const VehicleModel model = make_model(spec);
  Environment push;
  push.force_world_n = {3, 4, 0};
  const VehicleState end = coast(model, still(model, 0.0), push, 2000);
  EXPECT_NEAR(end.velocity_world.norm(), 13.679329, 1e-6);
  EXPECT_NEAR(end.velocity_world.norm(), 10 / 0.73103, 1e-9);
}

}  // namespace
}  // namespace avoidbench
