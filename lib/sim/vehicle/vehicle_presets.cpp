// Vehicles of published papers and simulators. A number without a word beside it is from the source
// that its function names; what is estimated or chosen says so.
#include <array>
#include <cmath>

#include "vehicle/capability.hpp"
#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {
namespace {

/// Four rotors at (±x, ±y, z): front left and back right with spin `front_left`.
std::vector<RotorSpec> cross(double x_m, double y_m, double z_m, int front_left) {
  return {{{x_m, y_m, z_m}, front_left},
          {{-x_m, y_m, z_m}, -front_left},
          {{-x_m, -y_m, z_m}, front_left},
          {{x_m, -y_m, z_m}, -front_left}};
}

/// Gains by bandwidth, `d` being the rate loop's gain on the torque error in roll and pitch.
///
/// With rotors that lag by τ (the slower constant, and the period for which commands are held) the
/// rate loop J ω' = t, τ t' = P e - (1 + D) t has the poles s² + s (1 + D) / τ + P / (J τ) = 0:
/// both at (1 + D) / 2τ for P = J (1 + D)² / 4τ. The attitude loop gets 0.3 of that, as the
/// hummingbird's 12 1/s are of its 38. Lee's gains are the hummingbird's over mass and inertia.
void tune(VehicleSpec& vehicle, double d) {
  const VehicleSpec model;  // the hummingbird
  RateControllerSpec& rates = vehicle.rate_controller;
  rates.d_ratio = {d, d, 0.3};
  const double lag_s = vehicle.time_constant_down_s + 1.0 / rates.rate_hz;
  LeeControllerSpec& lee = vehicle.lee_controller;
  for (std::size_t i = 0; i < 3; ++i) {
    const double damped = 1.0 + rates.d_ratio[i];
    rates.p_nms_per_rad[i] = vehicle.inertia_kgm2[i] * damped * damped / (4.0 * lag_s);
    const double mass_ratio = vehicle.mass_kg / model.mass_kg;
    const double inertia_ratio = vehicle.inertia_kgm2[i] / model.inertia_kgm2[i];
    lee.position_n_per_m[i] *= mass_ratio;
    lee.velocity_ns_per_m[i] *= mass_ratio;
    lee.attitude_nm_per_rad[i] *= inertia_ratio;
    lee.rates_nms_per_rad[i] *= inertia_ratio;
  }
  vehicle.position_controller.k_roll_pitch = 0.3 * (1.0 + d) / (2.0 * lag_s);
}

/// Last of all: what the reference may use of the vehicle (capability.hpp).
void set_limits(VehicleSpec& vehicle) {
  vehicle.max_acceleration_mps2 = reference_acceleration_mps2(vehicle);
  vehicle.max_tilt_rad = reference_tilt_rad(vehicle);
  vehicle.max_jerk_mps3 = reference_jerk_mps3(vehicle);
}

}  // namespace

VehicleSpec agile_quad_spec() {
  VehicleSpec vehicle;
  vehicle.name = "agile_quad";
  // Mass, inertia, rotors' places, thrust map, kappa, motor_tau, omega_max and thrust_max of
  // Agilicious' quadrotor files, as its public copies and the simulators after it repeat them; the
  // repository itself is given out on request.
  vehicle.mass_kg = 0.752;
  vehicle.inertia_kgm2 = {0.0025, 0.0021, 0.0043};
  vehicle.rotors = cross(0.075, 0.1, 0.0, -1);
  vehicle.thrust_coefficient_ns2 = 1.562522e-6;
  vehicle.moment_coefficient_m = 0.022;
  vehicle.time_constant_up_s = vehicle.time_constant_down_s = 0.033;
  constexpr double kMostThrust_n = 8.5;  // of a motor
  vehicle.max_rotor_speed_radps = std::sqrt(kMostThrust_n / vehicle.thrust_coefficient_ns2);
  vehicle.max_rates_radps = {10.0, 10.0, 4.0};
  // aero_coeff_1 of such a file, of a quadrotor of 0.94 kg: the nearest that is public. All drag is
  // in it.
  vehicle.linear_drag_kgps = {0.26, 0.28, 0.42};
  vehicle.rotor_drag_coefficient_kg = 0.0;
  vehicle.rolling_moment_coefficient_kgm = 0.0;
  vehicle.rotor_inertia_kgm2 = 9.3575e-6;  // motor_inertia of such a simulator
  // Estimated: the rotors' places and 5-inch propellers around them; the height of a battery, a
  // computer and a camera.
  vehicle.body_size_m = {0.28, 0.33, 0.12};
  vehicle.max_speed_mps = 20.0;  // it flew at 70 km/h
  vehicle.max_yaw_rate_radps = 4.0;
  tune(vehicle, 2.0);
  set_limits(vehicle);
  return vehicle;
}

VehicleSpec racing_5in_spec() {
  // Frame (6 inch) and propellers (5 inch, three blades) are of the kind that Agilicious has:
  // rotors, drag and lag are taken from there.
  VehicleSpec vehicle = agile_quad_spec();
  vehicle.name = "racing_5in";
  const double mass_ratio = 0.87 / vehicle.mass_kg;
  vehicle.mass_kg = 0.87;
  // Estimated: inertia in proportion to the mass, in the same frame.
  for (double& moment : vehicle.inertia_kgm2) moment *= mass_ratio;
  // "Maximum static thrust of approximately 35 N", thrust/weight 4.1.
  constexpr double kMostThrust_n = 35.0 / 4.0;
  vehicle.max_rotor_speed_radps = std::sqrt(kMostThrust_n / vehicle.thrust_coefficient_ns2);
  vehicle.max_speed_mps = 25.0;  // below the 100 km/h that it is reported to reach
  // Chosen: racing's are higher than research's.
  vehicle.max_rates_radps = {14.0, 14.0, 6.0};
  vehicle.max_yaw_rate_radps = 5.0;
  vehicle.lee_controller = {};
  tune(vehicle, 2.0);
  set_limits(vehicle);
  return vehicle;
}

VehicleSpec x500_spec() {
  VehicleSpec vehicle;  // PX4's x500 has the hummingbird's rotor constants
  vehicle.name = "x500";
  // Parts of x500_base/model.sdf, lumped about the common centre of gravity (vehicle's tests do it
  // again): a body of 2 kg and four rotors of 16 g.
  vehicle.mass_kg = 2.0 + 4.0 * 0.016076923076923075;
  vehicle.inertia_kgm2 = {0.02389094, 0.02389094, 0.04389396};
  vehicle.rotors = cross(0.174, 0.174, 0.05813087, -1);
  vehicle.max_rotor_speed_radps = 1000.0;
  vehicle.rotor_inertia_kgm2 = 2.649858e-5;
  // Motors' places and 13-inch propellers around them; Holybro's height.
  vehicle.body_size_m = {0.68, 0.68, 0.22};
  vehicle.max_speed_mps = 12.0;                  // PX4's MPC_XY_VEL_MAX
  vehicle.max_rates_radps = {3.84, 3.84, 3.49};  // PX4's 220 and 200 deg/s
  vehicle.max_yaw_rate_radps = 1.5;              // chosen
  vehicle.max_yaw_acceleration_radps2 = 4.0;     // chosen: within 4 k_m h / J_z of hover
  tune(vehicle, 0.5);
  set_limits(vehicle);
  return vehicle;
}

VehicleSpec crazyflie_spec() {
  VehicleSpec vehicle;
  vehicle.name = "crazyflie";
  // cf2x.urdf, whose numbers are from Förster 2015 and Landry 2015: kf and km per rpm², thrust over
  // weight 2.25.
  constexpr double kPerRpm = 60.0 / 6.28318530717958647692;
  vehicle.mass_kg = 0.027;
  vehicle.inertia_kgm2 = {1.4e-5, 1.4e-5, 2.17e-5};
  vehicle.rotors = cross(0.028, 0.028, 0.0, -1);
  vehicle.thrust_coefficient_ns2 = 3.16e-10 * kPerRpm * kPerRpm;
  vehicle.moment_coefficient_m = 7.94e-12 / 3.16e-10;
  vehicle.max_rotor_speed_radps = std::sqrt(2.25 * vehicle.mass_kg * vehicle.gravity_mps2 /
                                            (4.0 * vehicle.thrust_coefficient_ns2));
  // Förster's drag over the rotors' speed, which is nearly the same along and across the axis.
  vehicle.rotor_drag_coefficient_kg = 9.1785e-7;
  vehicle.rotor_axial_drag_coefficient_kg = 10.311e-7;
  vehicle.rolling_moment_coefficient_kgm = 0.0;
  vehicle.time_constant_up_s = vehicle.time_constant_down_s =
      0.072;                                 // RotorPy's (Folk et al. 2023)
  vehicle.rotor_inertia_kgm2 = 5e-8;         // estimated: a rod of 0.3 g, as long as the propeller
  vehicle.body_size_m = {0.11, 0.11, 0.03};  // estimated: propellers of 46 mm at the motors
  vehicle.max_speed_mps = 8.0;               // racer.urdf: 30 km/h
  tune(vehicle, 4.0);
  set_limits(vehicle);
  return vehicle;
}

std::vector<VehicleSpec> vehicle_presets() {
  return {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec(),
          racing_5in_spec(),  agile_quad_spec(),         x500_spec(),
          crazyflie_spec()};
}

}  // namespace avoidbench
