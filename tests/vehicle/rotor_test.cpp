#include <gtest/gtest.h>

#include <cmath>

#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

double hover_speed(VehicleSpec spec, double mass_kg, double gravity_mps2) {
  spec.mass_kg = mass_kg;
  spec.gravity_mps2 = gravity_mps2;
  return make_model(spec).hover_speed_radps.mean();
}

TEST(Rotor, HoverSpeedIsTheClosedForm) {
  EXPECT_NEAR(hover_speed(hummingbird_spec(), 0.73103, 9.8), 457.723966, 1e-6 * 457);
  EXPECT_NEAR(hover_speed(hummingbird_spec(), 0.73103, 9.81), 457.957439, 1e-6 * 457);
  EXPECT_NEAR(hover_speed(hummingbird_spec(), 0.73, 9.81), 457.634701, 1e-6 * 457);
  EXPECT_NEAR(hover_speed(firefly_spec(), 1.54503, 9.8), 543.323989, 1e-6 * 543);
}

TEST(Rotor, HoverDoesNotDrift) {
  for (const VehicleSpec& spec : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    const VehicleState start = hovering_at(spec, {1, 2, 3}, 0.7);
    const VehicleState end = coast(model, start, {}, 10000);
    // Six thrusts round their sum more than four.
    const double tolerance = model.rotor_count == 4 ? 1e-12 : 1e-11;
    EXPECT_LT((end.position_world - start.position_world).norm(), tolerance) << spec.name;
    EXPECT_LT(end.velocity_world.norm(), tolerance) << spec.name;
    EXPECT_LT(end.rates_body.norm(), 1e-12) << spec.name;
    EXPECT_EQ(end.tick, 10 * kTicksPerSecond);
  }
}

TEST(Rotor, ThrustToWeight) {
  VehicleSpec firefly = firefly_spec();
  firefly.gravity_mps2 = 9.8;
  const VehicleModel quad = make_model(hummingbird_rotors_spec()), hexa = make_model(firefly);
  EXPECT_NEAR(4 * quad.max_rotor_thrust_n / (0.73103 * 9.8), 3.35182, 1e-5);
  EXPECT_NEAR(6 * hexa.max_rotor_thrust_n / (1.54503 * 9.8), 2.37887, 1e-5);
}

/// A rotor's speed `dt_s` after a constant command, in one step of that length.
double speed_after(const VehicleModel& model, double speed_radps, double command_radps,
                   double dt_s) {
  return step_by(model, still(model, speed_radps), all_rotors(model, command_radps), {}, dt_s)
      .rotor_speed_radps[0];
}

TEST(Rotor, LagIsExactForAnyStep) {
  const VehicleModel model = make_model(hummingbird_spec());
  const double e = std::exp(-1.0);
  EXPECT_NEAR(speed_after(model, 0.0, 838.0, 0.0125), 529.717028, 1e-6);
  EXPECT_NEAR(std::pow(speed_after(model, 0.0, 838.0, 0.0125) / 838.0, 2), 0.399576, 1e-6);
  EXPECT_NEAR(speed_after(model, 838.0, 0.0, 0.025), 838.0 * e, 1e-9 * 838);
  // The time from 10 to 90 % is τ ln 9.
  EXPECT_NEAR(speed_after(model, 83.8, 838.0, 0.027465307), 754.2, 1e-5);
  EXPECT_NEAR(speed_after(model, 754.2, 0.0, 0.054930614), 83.8, 1e-5);
  EXPECT_EQ(speed_after(model, 838.0, 1e9, 0.1), 838.0);
  EXPECT_NEAR(speed_after(model, 100.0, -50.0, 10.0), 0.0, 1e-12);
}

TEST(Rotor, StepFollowsTheExactLag) {
  const VehicleModel model = make_model(hummingbird_spec());
  for (const int count : {1, 7, 50, 300}) {
    for (const auto& [from, to] : {std::pair{0.0, 838.0}, {838.0, 100.0}}) {
      VehicleState state = still(model, from);
      const double duration_s = 0.03;
      for (int i = 0; i < count; ++i) {
        state = step_by(model, state, all_rotors(model, to), {}, duration_s / count);
      }
      const double tau = to > from ? 0.0125 : 0.025;
      const double exact = to + (from - to) * std::exp(-duration_s / tau);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(state.rotor_speed_radps[i], exact, 1e-9 * 838);
    }
  }
}

TEST(Rotor, PowerIsDragTorqueTimesSpeed) {
  const VehicleModel model = make_model(hummingbird_rotors_spec());
  const VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0);
  EXPECT_NEAR(rotor_power_w(model, state), 0.016 * 0.73103 * 9.8 * 457.723966, 1e-4);
}

}  // namespace
}  // namespace avoidbench
