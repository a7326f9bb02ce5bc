#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vehicle/dynamics.hpp"

/// The equations once more, rotor by rotor and vector by vector as they are written in the
/// literature, with the rotors' lag inside RK4: what the library's dynamics are held against.
namespace avoidbench::plain {

using Vector17 = Eigen::Matrix<double, 17, 1>;  // p v q(w x y z) ω Ω₀…Ω₃

inline Vector17 pack(const VehicleState& s) {
  Vector17 y;
  y << s.position_world, s.velocity_world, s.q_world_body.w(), s.q_world_body.vec(), s.rates_body,
      s.rotor_speed_radps;
  return y;
}

inline Vector17 derivative(const VehicleSpec& spec, const Vector17& y, const RotorVector& command,
                           const Environment& environment) {
  using Eigen::Vector3d;
  const Vector3d v = y.segment<3>(3), omega = y.segment<3>(10);
  const Eigen::Quaterniond q(y[6], y[7], y[8], y[9]);
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const Vector3d air = R.transpose() * (v - environment.wind_world_mps);
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  Vector17 rate = Vector17::Zero();
  for (int i = 0; i < 4; ++i) {
    const RotorSpec& rotor = spec.rotors[static_cast<std::size_t>(i)];
    const Vector3d r(rotor.position_body_m[0], rotor.position_body_m[1], rotor.position_body_m[2]);
    const auto spin = static_cast<double>(rotor.spin);
    const double speed = y[13 + i];
    const Vector3d hub = air + omega.cross(r);
    const Vector3d across = hub - hub.z() * Vector3d::UnitZ();
    const Vector3d thrust = spec.thrust_coefficient_ns2 * speed * speed * Vector3d::UnitZ();
    const Vector3d drag =
        -speed * (spec.rotor_drag_coefficient_kg * across +
                  spec.rotor_axial_drag_coefficient_kg * hub.z() * Vector3d::UnitZ());
    const double rolling_sign = spec.rolling_moment_follows_spin ? spin : 1.0;
    const double lag = command[i] > speed ? spec.time_constant_up_s : spec.time_constant_down_s;
    rate[13 + i] = (command[i] - speed) / lag;
    force += thrust + drag;
    torque += r.cross(thrust + drag) - spin * spec.moment_coefficient_m * thrust -
              rolling_sign * speed * spec.rolling_moment_coefficient_kgm * across;
    torque -= omega.cross(Vector3d(0, 0, spec.rotor_inertia_kgm2 * spin * speed));
    if (spec.motor_reaction_torque) torque.z() -= spec.rotor_inertia_kgm2 * spin * rate[13 + i];
  }
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    force[i] -=
        (spec.linear_drag_kgps[k] + spec.quadratic_drag_kgpm[k] * std::abs(air[i])) * air[i];
  }
  const Vector3d J(spec.inertia_kgm2[0], spec.inertia_kgm2[1], spec.inertia_kgm2[2]);
  torque -= omega.cross(J.cwiseProduct(omega));
  rate.segment<3>(0) = v;
  rate.segment<3>(3) = (R * force + environment.force_world_n) / spec.mass_kg -
                       spec.gravity_mps2 * Vector3d::UnitZ();
  const Eigen::Quaterniond turning = q * Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z());
  rate[6] = 0.5 * turning.w();
  rate.segment<3>(7) = 0.5 * turning.vec();
  rate.segment<3>(10) = torque.cwiseQuotient(J);
  return rate;
}

inline Vector17 step(const VehicleSpec& spec, const Vector17& y, const RotorVector& command,
                     const Environment& environment, double dt) {
  const auto f = [&](const Vector17& at) { return derivative(spec, at, command, environment); };
  const Vector17 k1 = f(y);
  const Vector17 k2 = f(y + 0.5 * dt * k1);
  const Vector17 k3 = f(y + 0.5 * dt * k2);
  const Vector17 k4 = f(y + dt * k3);
  Vector17 next = y + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  next.segment<4>(6).normalize();
  return next;
}

}  // namespace avoidbench::plain
