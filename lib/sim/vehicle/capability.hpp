#pragma once

#include <array>

#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

// What a vehicle can do, in closed form. The vehicle must pass check_vehicle(), but for its two
// derived fields.

/// The greatest collective thrust without torque, over the weight: where rotors are alike n k Ω² /
/// (m g), otherwise what the rotor that carries most allows.
double thrust_to_weight(const VehicleSpec& vehicle);

/// The greatest angular accelerations about body x, y, z (rad/s²) from rest, in both directions, at
/// a collective thrust of the weight and no other torque. With row i of the allocation's
/// pseudo-inverse (a, b_x, b_y, b_z) rotor i gives h = a m g in hover and leaves it by b τ, so that
///
///     α = min over i of min(h, k Ω² - h) / (|b| J).
///
/// Of a quadrotor at a thrust/weight above two that is what its hover thrust can shift, whatever
/// the rotors' greatest speed.
std::array<double, 3> hover_angular_acceleration_radps2(const VehicleSpec& vehicle);

/// The lesser of roll and pitch: what the field angular_acceleration_radps2 is about.
double roll_pitch_acceleration_radps2(const VehicleSpec& vehicle);

/// The fastest rotor's speed in hover, rad/s.
double hover_rotor_speed_radps(const VehicleSpec& vehicle);

/// Level flight along body x in still air, steady: pitched by θ,
///
///     along body x  m g sin θ = D_x(v cos θ),    along body z  F = m g cos θ + D_z(v sin θ),
///
/// D being body drag and rotor drag at the speeds that give F.
struct LevelFlight {
  double speed_mps = 0.0;  ///< infinite where nothing drags
  double thrust_n = 0.0;
};
LevelFlight level_flight(const VehicleSpec& vehicle, double tilt_rad);

/// The speed of level flight at the greatest tilt, or at the lesser one at which the rotors give
/// all they can. It knows nothing of max_speed_mps, and of drag only what the vehicle has.
double top_speed_mps(const VehicleSpec& vehicle);

/// The limits that a reference may use, with what is left for control, of a vehicle with
/// thrust/weight T, hover's roll and pitch acceleration α and greatest roll and pitch rate ω:
///
///     acceleration 0.7 (T - 1) g   straight up is the hardest way: level it would be √(T² - 1) g
///     tilt         acos(1/T)       at which full thrust just holds the height; at most 1.4 rad
///     jerk         the least of max_acceleration_mps2 / 0.2 s, 0.8 g ω and g α 0.05 s
///
/// In hover a jerk j asks for the rate j / g: 0.8 of the greatest, reached within 0.05 s.
double reference_acceleration_mps2(const VehicleSpec& vehicle);
double reference_tilt_rad(const VehicleSpec& vehicle);
double reference_jerk_mps3(const VehicleSpec& vehicle);

/// The vehicle that its two derived fields describe, where they are not zero:
///
/// thrust_to_weight T sets max_rotor_speed_radps Ω by n k Ω² = T m g, and max_acceleration_mps2,
/// max_tilt_rad and max_jerk_mps3 as above. Mass, inertia and geometry stay.
///
/// angular_acceleration_radps2 α divides inertia_kgm2 by α / α₀, all three together, α₀ being
/// roll_pitch_acceleration_radps2() with T; with it go the controllers' torques per rate and
/// attitude error, so that their loops keep their poles, and, the other way, the yaw acceleration
/// limit. max_jerk_mps3 follows as above. Mass, geometry and rotors stay.
///
/// Settling twice is settling once, bit for bit. Throws InputError where the fields are beyond what
/// a vehicle can be.
VehicleSpec settled(const VehicleSpec& vehicle);

/// Whether settled() would leave it as it is.
bool is_settled(const VehicleSpec& vehicle);

}  // namespace avoidbench
