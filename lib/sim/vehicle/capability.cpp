#include "vehicle/capability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "vehicle/allocation.hpp"

namespace avoidbench {
namespace {

constexpr double kLeastThrustToWeight = 1.05, kLeastAngularAcceleration_radps2 = 5.0;
/// A ratio this near one is the same number, rounded: settling again must not change a bit.
constexpr double kSame = 1e-9;

bool is_same(double is, double wanted) { return std::abs(is / wanted - 1.0) <= kSame; }

Eigen::MatrixX4d mixing_of(const VehicleSpec& vehicle) {
  const auto mixing = pseudo_inverse(allocation_matrix(vehicle));
  AB_CHECK(mixing.has_value(), vehicle.name);
  return *mixing;
}

double weight_n(const VehicleSpec& vehicle) { return vehicle.mass_kg * vehicle.gravity_mps2; }

double rotor_thrust_n(const VehicleSpec& vehicle) {
  const double speed = vehicle.max_rotor_speed_radps;
  return vehicle.thrust_coefficient_ns2 * speed * speed;
}

/// The speed at which linear and quadratic drag together are `force_n`.
double dragged_speed(double linear, double quadratic, double force_n) {
  if (quadratic > 0.0) {
    return (std::sqrt(linear * linear + 4.0 * quadratic * force_n) - linear) / (2.0 * quadratic);
  }
  return linear > 0.0 ? force_n / linear : std::numeric_limits<double>::infinity();
}

[[noreturn]] void fail(const VehicleSpec& vehicle, const std::string& message) {
  InputProblem problem;
  problem.message = "vehicle " + vehicle.name + ": " + message;
  throw InputError({std::move(problem)});
}

void set_thrust(VehicleSpec& vehicle) {
  const double wanted = vehicle.thrust_to_weight;
  if (wanted < kLeastThrustToWeight) {
    fail(vehicle, "thrust_to_weight: " + shortest(wanted) +
                      " is too weak to hover and to hold its height in flight; at least " +
                      shortest(kLeastThrustToWeight));
  }
  if (is_same(thrust_to_weight(vehicle), wanted)) return;
  constexpr double kMost_radps = 1e5;  // of the field
  const double most_n = wanted * mixing_of(vehicle).col(0).maxCoeff() * weight_n(vehicle);
  vehicle.max_rotor_speed_radps = std::sqrt(most_n / vehicle.thrust_coefficient_ns2);
  if (vehicle.max_rotor_speed_radps > kMost_radps) {
    fail(vehicle, "thrust_to_weight: " + shortest(wanted) + " needs rotors at " +
                      significant_digits(vehicle.max_rotor_speed_radps, 3) +
                      " rad/s, more than max_rotor_speed_radps may be");
  }
}

void set_inertia(VehicleSpec& vehicle) {
  const double wanted = vehicle.angular_acceleration_radps2;
  if (wanted < kLeastAngularAcceleration_radps2) {
    fail(vehicle, "angular_acceleration_radps2: " + shortest(wanted) +
                      " is too slow to be held upright; at least " +
                      shortest(kLeastAngularAcceleration_radps2));
  }
  const double is = roll_pitch_acceleration_radps2(vehicle);
  if (!(is > 0.0)) {
    fail(vehicle, "angular_acceleration_radps2: its rotors can't turn it in hover");
  }
  if (is_same(is, wanted)) return;
  const double ratio = is / wanted;
  constexpr double kLeast_kgm2 = 1e-7, kMost_kgm2 = 1000.0;  // of the field
  for (double& moment : vehicle.inertia_kgm2) {
    moment *= ratio;
    if (moment < kLeast_kgm2 || moment > kMost_kgm2) {
      fail(vehicle, "angular_acceleration_radps2: " + shortest(wanted) +
                        " needs a moment of inertia of " + significant_digits(moment, 3) +
                        " kg m², beyond what inertia_kgm2 may be");
    }
  }
  const auto scale = [&](std::array<double, 3>& gains, double most) {
    for (double& gain : gains) {
      gain *= ratio;
      if (gain <= most) continue;
      fail(vehicle, "angular_acceleration_radps2: " + shortest(wanted) +
                        " needs a controller's torque of " + significant_digits(gain, 3) +
                        ", beyond what its gains may be");
    }
  };
  scale(vehicle.rate_controller.p_nms_per_rad, 100.0);  // of the fields
  scale(vehicle.lee_controller.attitude_nm_per_rad, 1000.0);
  scale(vehicle.lee_controller.rates_nms_per_rad, 1000.0);
  vehicle.max_yaw_acceleration_radps2 =
      std::clamp(vehicle.max_yaw_acceleration_radps2 / ratio, 0.1, 1000.0);
}

/// Whether thrust and torques can be set at all; check_vehicle() says what is wrong where not.
bool has_mixing(const VehicleSpec& vehicle) {
  const std::size_t count = vehicle.rotors.size();
  const double thrust_n = rotor_thrust_n(vehicle);
  if (count == 0 || count > kMaxRotors || !(vehicle.mass_kg > 0.0) || !(thrust_n > 0.0))
    return false;
  const auto mixing = pseudo_inverse(allocation_matrix(vehicle));
  return mixing && mixing->col(0).minCoeff() > 0.0;
}

}  // namespace

double thrust_to_weight(const VehicleSpec& vehicle) {
  const Eigen::MatrixX4d mixing = mixing_of(vehicle);
  return rotor_thrust_n(vehicle) / (mixing.col(0).maxCoeff() * weight_n(vehicle));
}

std::array<double, 3> hover_angular_acceleration_radps2(const VehicleSpec& vehicle) {
  const Eigen::MatrixX4d mixing = mixing_of(vehicle);
  const double most_n = rotor_thrust_n(vehicle);
  std::array<double, 3> most{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double torque_nm = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < mixing.rows(); ++i) {
      const double hover_n = mixing(i, 0) * weight_n(vehicle);
      const double per_torque = std::abs(mixing(i, axis + 1));
      if (!(per_torque > 0.0)) continue;  // a rotor on the axis takes no part
      torque_nm = std::min(torque_nm, std::min(hover_n, most_n - hover_n) / per_torque);
    }
    const auto k = static_cast<std::size_t>(axis);
    most[k] = std::max(0.0, torque_nm) / vehicle.inertia_kgm2[k];
  }
  return most;
}

double roll_pitch_acceleration_radps2(const VehicleSpec& vehicle) {
  const std::array<double, 3> most = hover_angular_acceleration_radps2(vehicle);
  return std::min(most[0], most[1]);
}

double hover_rotor_speed_radps(const VehicleSpec& vehicle) {
  return vehicle.max_rotor_speed_radps / std::sqrt(thrust_to_weight(vehicle));
}

LevelFlight level_flight(const VehicleSpec& vehicle, double tilt_rad) {
  const Eigen::MatrixX4d mixing = mixing_of(vehicle);
  double share_root_sum = 0.0;
  for (Eigen::Index i = 0; i < mixing.rows(); ++i) share_root_sum += std::sqrt(mixing(i, 0));
  const double sine = math::sin(tilt_rad), cosine = math::cos(tilt_rad);
  const double weight = weight_n(vehicle);
  LevelFlight flight;
  flight.thrust_n = weight * cosine;
  // Rotor drag changes with the root of the thrust, and that little with the speed: a short way to
  // the fixed point, in a number of steps that no test of convergence decides.
  for (int i = 0; i < 100; ++i) {
    const double rotor_speeds =
        share_root_sum * std::sqrt(flight.thrust_n / vehicle.thrust_coefficient_ns2);
    const double along_x = dragged_speed(
        vehicle.linear_drag_kgps[0] + vehicle.rotor_drag_coefficient_kg * rotor_speeds,
        vehicle.quadratic_drag_kgpm[0], weight * sine);
    flight.speed_mps = along_x / cosine;
    if (!std::isfinite(flight.speed_mps)) return flight;
    const double along_z = flight.speed_mps * sine;
    const double drag_z_n =
        (vehicle.linear_drag_kgps[2] + vehicle.rotor_axial_drag_coefficient_kg * rotor_speeds +
         vehicle.quadratic_drag_kgpm[2] * along_z) *
        along_z;
    flight.thrust_n = weight * cosine + drag_z_n;
  }
  return flight;
}

double top_speed_mps(const VehicleSpec& vehicle) {
  const double most_n = thrust_to_weight(vehicle) * weight_n(vehicle);
  double low = 0.0, high = vehicle.max_tilt_rad;
  const LevelFlight steepest = level_flight(vehicle, high);
  if (steepest.thrust_n <= most_n) return steepest.speed_mps;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (level_flight(vehicle, middle).thrust_n <= most_n ? low : high) = middle;
  }
  return level_flight(vehicle, low).speed_mps;
}

double reference_acceleration_mps2(const VehicleSpec& vehicle) {
  constexpr double kShare = 0.7;
  return kShare * (thrust_to_weight(vehicle) - 1.0) * vehicle.gravity_mps2;
}

double reference_tilt_rad(const VehicleSpec& vehicle) {
  constexpr double kSteepest_rad = 1.4;  // of the field
  return std::min(kSteepest_rad, math::acos(1.0 / thrust_to_weight(vehicle)));
}

double reference_jerk_mps3(const VehicleSpec& vehicle) {
  constexpr double kRamp_s = 0.2, kRateShare = 0.8, kTurning_s = 0.05, kLeast_mps3 = 1.0;
  const double g = vehicle.gravity_mps2;
  const double rate_radps = std::min(vehicle.max_rates_radps[0], vehicle.max_rates_radps[1]);
  const double turning_radps2 = roll_pitch_acceleration_radps2(vehicle);
  return std::max(kLeast_mps3,
                  std::min({vehicle.max_acceleration_mps2 / kRamp_s, kRateShare * rate_radps * g,
                            kTurning_s * turning_radps2 * g}));
}

VehicleSpec settled(const VehicleSpec& vehicle) {
  VehicleSpec settled = vehicle;
  const bool has_thrust = vehicle.thrust_to_weight != 0.0;
  const bool has_turning = vehicle.angular_acceleration_radps2 != 0.0;
  if (!(has_thrust || has_turning) || !has_mixing(vehicle)) return settled;
  if (has_thrust) {
    set_thrust(settled);
    settled.max_acceleration_mps2 = reference_acceleration_mps2(settled);
    settled.max_tilt_rad = reference_tilt_rad(settled);
  }
  // After the thrust, which may leave less room for torques.
  if (has_turning) set_inertia(settled);
  settled.max_jerk_mps3 = reference_jerk_mps3(settled);
  return settled;
}

bool is_settled(const VehicleSpec& vehicle) {
  if (!has_mixing(vehicle)) return true;  // check_vehicle() refuses it for that
  const double thrust = vehicle.thrust_to_weight, turning = vehicle.angular_acceleration_radps2;
  return (thrust == 0.0 || is_same(thrust_to_weight(vehicle), thrust)) &&
         (turning == 0.0 || is_same(roll_pitch_acceleration_radps2(vehicle), turning));
}

}  // namespace avoidbench
