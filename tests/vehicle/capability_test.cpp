#include "vehicle/capability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "control/mixer.hpp"
#include "support/input_error_message.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

VehicleSpec in_a_vacuum(VehicleSpec spec) {
  spec = without_drag(std::move(spec));
  spec.rotor_axial_drag_coefficient_kg = 0.0;
  spec.linear_drag_kgps = spec.quadratic_drag_kgpm = {0.0, 0.0, 0.0};
  return spec;
}

std::string complaint(const VehicleSpec& spec) {
  return test::message_of([&] { check_vehicle(settled(spec)); });
}

TEST(Capability, ThrustOverWeightIsThatOfTheSources) {
  // By hand from the sources' numbers: four rotors' k Ω² over m g.
  EXPECT_NEAR(thrust_to_weight(hummingbird_rotors_spec()), 3.3518, 1e-4);  // design notes of RotorS
  EXPECT_NEAR(thrust_to_weight(firefly_spec()), 2.3789 * 9.8 / 9.81, 1e-4);
  EXPECT_NEAR(thrust_to_weight(racing_5in_spec()), 35.0 / (0.87 * 9.81), 1e-9);
  EXPECT_NEAR(thrust_to_weight(racing_5in_spec()), 4.1, 0.01);  // the paper's
  EXPECT_NEAR(thrust_to_weight(agile_quad_spec()), 4.0 * 8.5 / (0.752 * 9.81), 1e-9);
  EXPECT_NEAR(thrust_to_weight(x500_spec()), 4.0 * 8.54858 / (2.0643077 * 9.81), 1e-7);
  EXPECT_NEAR(thrust_to_weight(crazyflie_spec()), 2.25, 1e-12);
}

TEST(Capability, FullThrottleClimbsByIt) {
  for (const VehicleSpec& spec : vehicle_presets()) {
    const VehicleModel model = make_model(in_a_vacuum(spec));
    VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0.0);
    const RotorVector full = all_rotors(model, spec.max_rotor_speed_radps);
    const auto fly_ms = [&](int count) {
      for (int i = 0; i < count; ++i) state = step(model, state, full, {}, kTicksPerMillisecond);
      return state.velocity_world.z();
    };
    // Rotors that have reached their speed: 1.5 s are twenty times the slowest lag.
    const double before = fly_ms(1500);
    const double gained = fly_ms(100) - before;
    EXPECT_NEAR(gained / 0.1, (thrust_to_weight(spec) - 1.0) * spec.gravity_mps2, 1e-5)
        << spec.name;
  }
}

TEST(Capability, AngularAccelerationIsTheClosedFormOfACross) {
  // Front and back of the hummingbird: hover thrust moved from one to the other, 2 l h.
  const VehicleSpec bird = hummingbird_spec();
  const double h = 0.73103 * 9.81 / 4.0;
  EXPECT_NEAR(roll_pitch_acceleration_radps2(bird), 2.0 * 0.17 * h / 0.00771727, 1e-9);
  // Yaw: two rotors stopped, 4 k_m h.
  EXPECT_NEAR(hover_angular_acceleration_radps2(bird)[2], 4.0 * 0.016 * h / 0.0130804, 1e-9);
  // The X500 has less room above than below: four rotors by k Ω² - h at the arm y.
  const VehicleSpec x500 = x500_spec();
  const double room = 8.54858 - x500.mass_kg * 9.81 / 4.0;
  EXPECT_NEAR(roll_pitch_acceleration_radps2(x500), 4.0 * 0.174 * room / 0.02389094, 1e-6);
}

TEST(Capability, TheMixerGivesThatMuchAtHoverThrustAndNoMore) {
  for (const VehicleSpec& spec : vehicle_presets()) {
    const VehicleModel model = make_model(spec);
    const std::array<double, 3> most = hover_angular_acceleration_radps2(spec);
    const double weight_n = spec.mass_kg * spec.gravity_mps2;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const Vector3d torque = most[k] * spec.inertia_kgm2[k] * Vector3d::Unit(axis);
      const Eigen::Vector4d given = wrench(model, mix_thrusts(model, weight_n, 0.9999 * torque));
      EXPECT_NEAR(given[0], weight_n, 1e-9 * weight_n) << spec.name << axis;
      EXPECT_NEAR(given[axis + 1], 0.9999 * torque[axis], 1e-9 * torque[axis]) << spec.name << axis;
      const Eigen::Vector4d beyond = wrench(model, mix_thrusts(model, weight_n, 1.01 * torque));
      const bool is_whole = std::abs(beyond[0] - weight_n) < 1e-6 * weight_n &&
                            std::abs(beyond[axis + 1] - 1.01 * torque[axis]) < 1e-6 * torque[axis];
      EXPECT_FALSE(is_whole) << spec.name << axis;
    }
  }
}

TEST(Capability, RollsAsFastAsItSays) {
  for (const VehicleSpec& preset : vehicle_presets()) {
    VehicleSpec spec = in_a_vacuum(preset);
    spec.rotor_inertia_kgm2 = 0.0;  // gyroscopic torques are none of it
    const VehicleModel model = make_model(spec);
    const double wanted = hover_angular_acceleration_radps2(spec)[0];
    const RotorVector command = mix(model, spec.mass_kg * spec.gravity_mps2,
                                    Vector3d(wanted * spec.inertia_kgm2[0], 0.0, 0.0));
    VehicleState state = hovering_at(spec, {0, 0, 0}, 0.0);
    const auto fly_ms = [&](int count) {
      for (int i = 0; i < count; ++i) state = step(model, state, command, {}, kTicksPerMillisecond);
      return state.rates_body.x();
    };
    const double before = fly_ms(1500);
    EXPECT_NEAR((fly_ms(50) - before) / 0.05, wanted, 1e-5 * wanted) << spec.name;
  }
}

TEST(Capability, TopSpeedIsTheClosedFormUnderEvenDrag) {
  // Drag d v whatever the direction: full thrust T m g holds weight and drag, at a right angle.
  for (const double ratio : {1.5, 3.0, 4.5}) {
    VehicleSpec spec = in_a_vacuum(hummingbird_spec());
    spec.linear_drag_kgps = {0.3, 0.3, 0.3};
    spec.thrust_to_weight = ratio;
    spec = settled(spec);
    const double weight_n = spec.mass_kg * spec.gravity_mps2;
    EXPECT_NEAR(top_speed_mps(spec), weight_n * std::sqrt(ratio * ratio - 1.0) / 0.3, 1e-6);
    // Where the tilt is what limits: drag against m g tan θ.
    spec.max_tilt_rad = 0.5;
    EXPECT_NEAR(top_speed_mps(spec), weight_n * std::tan(0.5) / 0.3, 1e-9);
  }
  EXPECT_TRUE(std::isinf(top_speed_mps(in_a_vacuum(hummingbird_spec()))));
  VehicleSpec spec = in_a_vacuum(hummingbird_spec());
  spec.quadratic_drag_kgpm = {0.02, 0.02, 0.0};  // along body x alone: v cos θ = √(m g sin θ / q)
  const double theta = spec.max_tilt_rad, weight_n = spec.mass_kg * spec.gravity_mps2;
  EXPECT_NEAR(top_speed_mps(spec), std::sqrt(weight_n * std::sin(theta) / 0.02) / std::cos(theta),
              1e-9);
}

TEST(Capability, LevelFlightIsSteady) {
  for (const VehicleSpec& preset : vehicle_presets()) {
    VehicleSpec spec = preset;
    for (RotorSpec& rotor : spec.rotors) rotor.position_body_m[2] = 0.0;  // no pitching by drag
    const VehicleModel model = make_model(spec);
    for (const double tilt : {0.2, 0.6, spec.max_tilt_rad}) {
      const LevelFlight flight = level_flight(spec, tilt);
      VehicleState state = hovering_at(spec, {0, 0, 0}, 0.0);
      state.q_world_body = Eigen::AngleAxisd(tilt, Vector3d::UnitY());
      state.velocity_world = {flight.speed_mps, 0.0, 0.0};
      state.rotor_speed_radps *= std::sqrt(flight.thrust_n / (spec.mass_kg * spec.gravity_mps2));
      EXPECT_LT(acceleration_world(model, state, {}).norm(), 1e-6) << spec.name << " " << tilt;
    }
  }
}

TEST(Settled, ThrustToWeightMovesRotorsAndLimitsOnly) {
  VehicleSpec spec = hummingbird_spec();
  spec.thrust_to_weight = 4.0;
  const VehicleSpec now = settled(spec);
  EXPECT_NEAR(thrust_to_weight(now), 4.0, 1e-12);
  // n k Ω² = T m g.
  EXPECT_NEAR(now.max_rotor_speed_radps, std::sqrt(4.0 * 0.73103 * 9.81 / (4.0 * 8.54858e-6)),
              1e-9);
  EXPECT_NEAR(now.max_acceleration_mps2, 0.7 * 3.0 * 9.81, 1e-9);
  EXPECT_NEAR(now.max_tilt_rad, std::acos(0.25), 1e-12);
  const double turning = 2.0 * 0.17 * 0.73103 * 9.81 / 4.0 / 0.00771727;
  EXPECT_NEAR(now.max_jerk_mps3, 0.05 * 9.81 * turning, 1e-6);
  VehicleSpec rest = now;  // everything else is as it was
  rest.max_rotor_speed_radps = spec.max_rotor_speed_radps;
  rest.max_acceleration_mps2 = spec.max_acceleration_mps2;
  rest.max_tilt_rad = spec.max_tilt_rad;
  rest.max_jerk_mps3 = spec.max_jerk_mps3;
  EXPECT_EQ(spec_to_json(rest), spec_to_json(spec));
}

TEST(Settled, AngularAccelerationScalesInertiaAndTorques) {
  VehicleSpec spec = hummingbird_spec();
  spec.angular_acceleration_radps2 = 2.0 * roll_pitch_acceleration_radps2(spec);
  const VehicleSpec now = settled(spec);
  EXPECT_NEAR(roll_pitch_acceleration_radps2(now), spec.angular_acceleration_radps2, 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(now.inertia_kgm2[i], 0.5 * spec.inertia_kgm2[i], 1e-12);
    EXPECT_NEAR(now.rate_controller.p_nms_per_rad[i], 0.5 * spec.rate_controller.p_nms_per_rad[i],
                1e-12);
    EXPECT_NEAR(now.lee_controller.rates_nms_per_rad[i],
                0.5 * spec.lee_controller.rates_nms_per_rad[i], 1e-12);
  }
  EXPECT_NEAR(now.max_yaw_acceleration_radps2, 20.0, 1e-9);
  EXPECT_EQ(now.max_acceleration_mps2, spec.max_acceleration_mps2);
  EXPECT_EQ(now.max_rotor_speed_radps, spec.max_rotor_speed_radps);
  EXPECT_NEAR(now.max_jerk_mps3, 30.0, 1e-9);  // by its acceleration, 6 / 0.2
}

TEST(Settled, BothTogetherHoldAndSettlingTwiceIsOnce) {
  for (const VehicleSpec& preset : vehicle_presets()) {
    EXPECT_EQ(spec_to_json(settled(preset)), spec_to_json(preset));
    for (const double ratio : {1.3, 2.0, 5.0}) {
      VehicleSpec spec = preset;
      spec.thrust_to_weight = ratio;
      spec.angular_acceleration_radps2 = 60.0;
      EXPECT_FALSE(is_settled(spec));
      const VehicleSpec now = settled(spec);
      EXPECT_TRUE(is_settled(now));
      EXPECT_EQ(complaint(spec), "") << spec.name << ratio;
      EXPECT_NEAR(thrust_to_weight(now), ratio, 1e-12 * ratio) << spec.name;
      EXPECT_NEAR(roll_pitch_acceleration_radps2(now), 60.0, 1e-9) << spec.name;
      EXPECT_EQ(spec_to_json(settled(now)), spec_to_json(now)) << spec.name;
    }
  }
}

TEST(Settled, WhatCannotBeIsRefused) {
  VehicleSpec spec;
  spec.thrust_to_weight = 0.9;
  EXPECT_NE(complaint(spec).find("thrust_to_weight: 0.9 is too weak to hover"), std::string::npos);
  spec.thrust_to_weight = 4.0;
  spec.thrust_coefficient_ns2 = 1e-12;
  EXPECT_NE(complaint(spec).find("needs rotors at"), std::string::npos);
  spec = {};
  spec.angular_acceleration_radps2 = 1.0;
  EXPECT_NE(complaint(spec).find("too slow to be held upright"), std::string::npos);
  spec = crazyflie_spec();
  spec.angular_acceleration_radps2 = 1e5;
  EXPECT_NE(complaint(spec).find("moment of inertia"), std::string::npos);
  spec = firefly_spec();
  spec.rate_controller.p_nms_per_rad = {90.0, 90.0, 90.0};
  spec.angular_acceleration_radps2 = 5.0;
  EXPECT_NE(complaint(spec).find("controller's torque"), std::string::npos);
  // A vehicle that nobody has settled does not fly as something else.
  spec = {};
  spec.thrust_to_weight = 4.0;
  EXPECT_THROW(make_model(spec), InputError);
  // Other faults are told as ever.
  spec.rotors.clear();
  EXPECT_NE(complaint(spec).find("not one to eight"), std::string::npos);
}

}  // namespace
}  // namespace avoidbench
