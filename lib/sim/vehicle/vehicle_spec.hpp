#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"

namespace avoidbench {

inline constexpr int kMaxRotors = 8;

/// One rotor; its axis is body z.
struct RotorSpec {
  std::array<double, 3> position_body_m{0.0, 0.0, 0.0};
  std::int64_t spin = 1;
};

/// Gains of the position controller; see position_controller.hpp.
struct PositionControllerSpec {
  double rate_hz = 1000.0;
  double kp_xy = 10.0, kd_xy = 4.0;
  double kp_z = 15.0, kd_z = 6.0;
  double k_roll_pitch = 12.0, k_yaw = 5.0;
  double position_error_max_xy_m = 0.6, position_error_max_z_m = 0.3;
  double velocity_error_max_xy_mps = 1.0, velocity_error_max_z_mps = 0.75;
  double min_thrust_mps2 = 1.0;
  bool drag_compensation = true;
};

/// Gains of the body-rate loop; see rate_controller.hpp.
struct RateControllerSpec {
  double rate_hz = 500.0;
  std::array<double, 3> p_nms_per_rad{0.2, 0.2, 0.4};
  std::array<double, 3> d_ratio{0.5, 0.5, 0.3};
};

/// What turns references into rotor commands.
enum class Controller { rpg, lee };

template <>
struct EnumText<Controller> {
  static constexpr std::pair<Controller, std::string_view> entries[] = {{Controller::rpg, "rpg"},
                                                                        {Controller::lee, "lee"}};
};

/// Gains of the geometric controller; see lee_controller.hpp.
struct LeeControllerSpec {
  double rate_hz = 1000.0;
  std::array<double, 3> position_n_per_m{4.0, 4.0, 4.0};
  std::array<double, 3> velocity_ns_per_m{2.2, 2.2, 2.2};
  std::array<double, 3> attitude_nm_per_rad{0.7, 0.7, 0.035};
  std::array<double, 3> rates_nms_per_rad{0.1, 0.1, 0.025};
  double mass_kg = 0.0;
  double gravity_mps2 = 0.0;
  bool feed_forward = true;
};

/// A multirotor with up to eight rotors whose axes are body z, and what flies it. The defaults are
/// hummingbird_spec().
struct VehicleSpec {
  std::string name = "hummingbird";
  double mass_kg = 0.73103;
  std::array<double, 3> inertia_kgm2{0.00771727, 0.00771727, 0.0130804};
  std::vector<RotorSpec> rotors{{{0.17, 0.0, 0.00950754}, -1},
                                {{0.0, 0.17, 0.00950754}, 1},
                                {{-0.17, 0.0, 0.00950754}, -1},
                                {{0.0, -0.17, 0.00950754}, 1}};
  double thrust_coefficient_ns2 = 8.54858e-6;
  double moment_coefficient_m = 0.016;
  double rotor_drag_coefficient_kg = 8.06428e-5;
  double rotor_axial_drag_coefficient_kg = 0.0;
  double rolling_moment_coefficient_kgm = 1e-6;
  bool rolling_moment_follows_spin = true;
  double rotor_inertia_kgm2 = 7.66875e-6;
  bool motor_reaction_torque = true;
  double time_constant_up_s = 0.0125, time_constant_down_s = 0.025;
  double max_rotor_speed_radps = 838.0;
  std::array<double, 3> linear_drag_kgps{0.0, 0.0, 0.0};
  std::array<double, 3> quadratic_drag_kgpm{0.0, 0.0, 0.0};
  double gravity_mps2 = 9.81;
  std::array<double, 3> body_size_m{0.5, 0.5, 0.12};

  /// Where not 0, other fields follow from these: see settled() in capability.hpp.
  double thrust_to_weight = 0.0, angular_acceleration_radps2 = 0.0;

  double max_speed_mps = 8.0;
  double max_acceleration_mps2 = 6.0;
  double max_jerk_mps3 = 30.0;
  double max_tilt_rad = 1.05;
  std::array<double, 3> max_rates_radps{10.0, 10.0, 4.0};
  double max_yaw_rate_radps = 2.5;
  double max_yaw_acceleration_radps2 = 10.0;

  Controller controller = Controller::rpg;
  PositionControllerSpec position_controller;
  RateControllerSpec rate_controller;
  LeeControllerSpec lee_controller;
};

/// The quadrotor of RotorS (Furrer et al. 2016, hummingbird.xacro) with its parts lumped into one
/// body about the common centre of gravity, g = 9.81 and rolling moments that follow the rotors'
/// spin.
VehicleSpec hummingbird_spec();

/// The same quadrotor as RotorS simulates it: g = 9.8, rolling moments that ignore the spin and so
/// add up, no reaction torque of the motors, and a geometric controller that takes it for 0.716 kg
/// and leaves the reference's rates out.
VehicleSpec hummingbird_rotors_spec();

/// The hexarotor of RotorS (firefly.xacro), lumped as the hummingbird is.
VehicleSpec firefly_spec();

/// A 5-inch racing quadrotor: Swift's (Kaufmann et al., Nature 2023).
VehicleSpec racing_5in_spec();

/// An agile research quadrotor: Agilicious' (Foehn et al., Science Robotics 2022).
VehicleSpec agile_quad_spec();

/// Holybro's X500 as PX4 simulates it (PX4-gazebo-models, x500), lumped as the hummingbird is.
VehicleSpec x500_spec();

/// Bitcraze's Crazyflie 2.x as gym-pybullet-drones has it (Panerati et al., IROS 2021).
VehicleSpec crazyflie_spec();

/// All of the above; vehicle_presets.cpp has where each number is from.
std::vector<VehicleSpec> vehicle_presets();

/// Throws InputError, with all the reasons at once, where this vehicle can't fly: no or more than
/// eight rotors, spins other than ±1, thrust and torques that can't be set independently, too weak
/// to hover or for its acceleration limit, derived fields that the others contradict (settled() in
/// capability.hpp makes them agree).
void check_vehicle(const VehicleSpec& vehicle);

template <class Visitor, ConstOr<RotorSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("position_body_m", s.position_body_m, Range{-3, 3},
          "Hub from the centre of gravity, body frame (FLU).");
  v.field("spin", s.spin, Range{-1, 1}, "+1 counter-clockwise seen from above, -1 clockwise.");
}

template <class Visitor, ConstOr<PositionControllerSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("rate_hz", s.rate_hz, Range{10, 36000},
          "How often it runs; each physics step where that is longer.");
  v.field("kp_xy", s.kp_xy, Range{0, 100}, "Position gain, horizontal, 1/s².");
  v.field("kd_xy", s.kd_xy, Range{0, 100}, "Velocity gain, horizontal, 1/s.");
  v.field("kp_z", s.kp_z, Range{0, 100}, "Position gain, vertical, 1/s².");
  v.field("kd_z", s.kd_z, Range{0, 100}, "Velocity gain, vertical, 1/s.");
  v.field("k_roll_pitch", s.k_roll_pitch, Range{0, 100}, "Attitude gain of roll and pitch, 1/s.");
  v.field("k_yaw", s.k_yaw, Range{0, 100}, "Attitude gain of yaw, 1/s.");
  v.field("position_error_max_xy_m", s.position_error_max_xy_m, Range{0.01, 100},
          "Larger horizontal position errors count as this.");
  v.field("position_error_max_z_m", s.position_error_max_z_m, Range{0.01, 100},
          "Larger vertical position errors count as this.");
  v.field("velocity_error_max_xy_mps", s.velocity_error_max_xy_mps, Range{0.01, 100},
          "Larger horizontal velocity errors count as this.");
  v.field("velocity_error_max_z_mps", s.velocity_error_max_z_mps, Range{0.01, 100},
          "Larger vertical velocity errors count as this.");
  v.field("min_thrust_mps2", s.min_thrust_mps2, Range{0, 9},
          "Least collective thrust over mass, and least vertical part of the demanded one.");
  v.field("drag_compensation", s.drag_compensation,
          "Whether the rotors' drag enters the feed-forward (Faessler et al. 2018).");
}

template <class Visitor, ConstOr<RateControllerSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field(
      "rate_hz", s.rate_hz, Range{10, 36000},
      "How often it runs, rotor commands held between; each physics step where that is longer.");
  v.field("p_nms_per_rad", s.p_nms_per_rad, Range{0, 100}, "Torque per body-rate error, x y z.");
  v.field("d_ratio", s.d_ratio, Range{0, 10}, "Gain on the torque error, x y z.");
}

template <class Visitor, ConstOr<LeeControllerSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field(
      "rate_hz", s.rate_hz, Range{10, 36000},
      "How often it runs, rotor commands held between; each physics step where that is longer.");
  v.field("position_n_per_m", s.position_n_per_m, Range{0, 10000},
          "Force per position error, world x y z.");
  v.field("velocity_ns_per_m", s.velocity_ns_per_m, Range{0, 10000},
          "Force per velocity error, world x y z.");
  v.field("attitude_nm_per_rad", s.attitude_nm_per_rad, Range{0, 1000},
          "Torque per attitude error, body x y z.");
  v.field("rates_nms_per_rad", s.rates_nms_per_rad, Range{0, 1000},
          "Torque per body-rate error, body x y z.");
  v.field("mass_kg", s.mass_kg, Range{0, 1000}, "The mass that it assumes; 0: the true one.");
  v.field("gravity_mps2", s.gravity_mps2, Range{0, 30},
          "The gravity that it assumes; 0: the true one.");
  v.field("feed_forward", s.feed_forward,
          "Whether the reference's body rates and the body's gyroscopic torque enter (Lee et al. "
          "2010); RotorS has the yaw rate alone.");
}

template <class Visitor, ConstOr<VehicleSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("name", s.name, "Its name in tables.");
  v.field("mass_kg", s.mass_kg, Range{0.01, 1000}, "Total mass.");
  v.field("inertia_kgm2", s.inertia_kgm2, Range{1e-7, 1000},
          "Principal moments about the centre of gravity, body x y z.");
  v.field("rotors", s.rotors, "One to eight rotors.");
  v.field("thrust_coefficient_ns2", s.thrust_coefficient_ns2, Range{1e-12, 1},
          "Thrust over rotor speed squared.");
  v.field("moment_coefficient_m", s.moment_coefficient_m, Range{0, 1}, "Drag torque over thrust.");
  v.field("rotor_drag_coefficient_kg", s.rotor_drag_coefficient_kg, Range{0, 1},
          "Rotor drag across the axis over rotor speed times air speed, kg/rad.");
  v.field("rotor_axial_drag_coefficient_kg", s.rotor_axial_drag_coefficient_kg, Range{0, 1},
          "Rotor drag along the axis over rotor speed times air speed, kg/rad.");
  v.field("rolling_moment_coefficient_kgm", s.rolling_moment_coefficient_kgm, Range{0, 1},
          "Rolling moment of a rotor over rotor speed times air speed across the axis, kg m/rad.");
  v.field("rolling_moment_follows_spin", s.rolling_moment_follows_spin,
          "Whether the rolling moment's sign is the spin's; RotorS ignores the spin.");
  v.field("rotor_inertia_kgm2", s.rotor_inertia_kgm2, Range{0, 10}, "Of one rotor about its axis.");
  v.field("motor_reaction_torque", s.motor_reaction_torque,
          "Whether speeding a rotor up turns the body the other way.");
  v.field("time_constant_up_s", s.time_constant_up_s, Range{1e-4, 10},
          "First-order lag of a rotor speeding up.");
  v.field("time_constant_down_s", s.time_constant_down_s, Range{1e-4, 10},
          "First-order lag of a rotor slowing down.");
  v.field("max_rotor_speed_radps", s.max_rotor_speed_radps, Range{1, 1e5},
          "Commands are limited to zero to this.");
  v.field("linear_drag_kgps", s.linear_drag_kgps, Range{0, 100},
          "Body drag over air speed, body x y z, N s/m.");
  v.field("quadratic_drag_kgpm", s.quadratic_drag_kgpm, Range{0, 100},
          "Body drag over air speed component squared, body x y z, N s²/m².");
  v.field("gravity_mps2", s.gravity_mps2, Range{0.1, 30}, "Along world -z.");
  v.field("body_size_m", s.body_size_m, Range{0.01, 10},
          "Collision box, body x y z, centred at the centre of gravity.");
  v.field(
      "thrust_to_weight", s.thrust_to_weight, Range{0, 15},
      "Greatest collective thrust over weight: sets max_rotor_speed_radps, "
      "max_acceleration_mps2, max_tilt_rad and max_jerk_mps3; 0: what the rotors' speed gives.");
  v.field("angular_acceleration_radps2", s.angular_acceleration_radps2, Range{0, 10000},
          "Greatest roll and pitch acceleration at hover thrust: scales inertia_kgm2 and the "
          "torques of the controllers; sets max_jerk_mps3; 0: what the inertia gives.");
  v.field("max_speed_mps", s.max_speed_mps, Range{0.1, 100}, "Greatest speed of the reference.");
  v.field("max_acceleration_mps2", s.max_acceleration_mps2, Range{0.1, 100},
          "Greatest acceleration of the reference.");
  v.field("max_jerk_mps3", s.max_jerk_mps3, Range{1, 10000}, "Greatest jerk of the reference.");
  v.field("max_tilt_rad", s.max_tilt_rad, Range{0.05, 1.4},
          "Greatest angle between demanded thrust and world z.");
  v.field("max_rates_radps", s.max_rates_radps, Range{0.1, 100},
          "Greatest demanded body rates, x y z.");
  v.field("max_yaw_rate_radps", s.max_yaw_rate_radps, Range{0.05, 100},
          "Greatest yaw rate of the reference.");
  v.field("max_yaw_acceleration_radps2", s.max_yaw_acceleration_radps2, Range{0.1, 1000},
          "Greatest yaw acceleration of the reference.");
  v.field("controller", s.controller,
          "What follows references: rpg: position_controller and rate_controller; lee: "
          "lee_controller, rates commands still by rate_controller.");
  v.field("position_controller", s.position_controller, "Position and attitude loop of rpg.");
  v.field("rate_controller", s.rate_controller, "Body-rate loop.");
  v.field("lee_controller", s.lee_controller, "Geometric controller, position to torques.");
}

}  // namespace avoidbench
