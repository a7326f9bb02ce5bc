#include "vehicle/dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Rotors = std::array<double, kMaxRotors>;

/// The rotors' part of the equations at given speeds. Their forces are linear in the body's
/// velocity through the air and its rates, so that the sums over rotors need not be repeated at
/// each evaluation.
struct RotorLoads {
  double thrust = 0.0, torque_x = 0.0, torque_y = 0.0, torque_z = 0.0;
  double momentum = 0.0;  ///< Σ spin J_r Ω about body z
  // Sums of Ω times powers of the hub's coordinates, for drag
  double s = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
  double sxx = 0.0, sxy = 0.0, sxz = 0.0, syy = 0.0, syz = 0.0, szz = 0.0;
  // The same with the rolling moment's sign
  double r = 0.0, rx = 0.0, ry = 0.0, rz = 0.0;
};

RotorLoads rotor_loads(const VehicleModel& model, const Rotors& speed) {
  RotorLoads sum;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.rotor_count); ++i) {
    const double omega = speed[i];
    const double x = model.rotor_x_m[i], y = model.rotor_y_m[i], z = model.rotor_z_m[i];
    const double thrust = model.spec.thrust_coefficient_ns2 * omega * omega;
    sum.thrust += thrust;
    sum.torque_x += y * thrust;
    sum.torque_y -= x * thrust;
    sum.torque_z -= model.spin[i] * thrust;
    sum.momentum += model.spin[i] * omega;
    const double ox = omega * x, oy = omega * y, oz = omega * z;
    sum.s += omega;
    sum.sx += ox;
    sum.sy += oy;
    sum.sz += oz;
    sum.sxx += ox * x;
    sum.sxy += ox * y;
    sum.sxz += ox * z;
    sum.syy += oy * y;
    sum.syz += oy * z;
    sum.szz += oz * z;
    const double sign = model.rolling_sign[i];
    sum.r += sign * omega;
    sum.rx += sign * ox;
    sum.ry += sign * oy;
    sum.rz += sign * oz;
  }
  sum.torque_z *= model.spec.moment_coefficient_m;
  sum.momentum *= model.spec.rotor_inertia_kgm2;
  return sum;
}

/// What RK4 integrates, except the rotors.
struct Motion {
  Vector3d position, velocity;
  double w, x, y, z;  ///< quaternion body to world, of about unit length
  Vector3d rates;
};

Motion moved(const Motion& from, const Motion& rate, double dt) {
  return {from.position + dt * rate.position,
          from.velocity + dt * rate.velocity,
          from.w + dt * rate.w,
          from.x + dt * rate.x,
          from.y + dt * rate.y,
          from.z + dt * rate.z,
          from.rates + dt * rate.rates};
}

/// The time derivative. `reaction_z` is the torque of the rotors' spinning up.
Motion derivative(const VehicleModel& model, const Motion& m, const RotorLoads& rotors,
                  double reaction_z, const Environment& environment) {
  const VehicleSpec& spec = model.spec;
  // Rotation matrix, body to world
  const double xx = m.x * m.x, yy = m.y * m.y, zz = m.z * m.z;
  const double xy = m.x * m.y, xz = m.x * m.z, yz = m.y * m.z;
  const double wx = m.w * m.x, wy = m.w * m.y, wz = m.w * m.z;
  const double r00 = 1.0 - 2.0 * (yy + zz), r01 = 2.0 * (xy - wz), r02 = 2.0 * (xz + wy);
  const double r10 = 2.0 * (xy + wz), r11 = 1.0 - 2.0 * (xx + zz), r12 = 2.0 * (yz - wx);
  const double r20 = 2.0 * (xz - wy), r21 = 2.0 * (yz + wx), r22 = 1.0 - 2.0 * (xx + yy);

  // Velocity through the air, body frame
  const double ax = m.velocity.x() - environment.wind_world_mps.x();
  const double ay = m.velocity.y() - environment.wind_world_mps.y();
  const double az = m.velocity.z() - environment.wind_world_mps.z();
  // By the transposed matrix: from the world to the body.
  const double u = r00 * ax + r10 * ay + r20 * az;
  const double v = r01 * ax + r11 * ay + r21 * az;
  const double w = r02 * ax + r12 * ay + r22 * az;
  const double p = m.rates.x(), q = m.rates.y(), r = m.rates.z();

  // Σ Ω (hub velocity) and Σ Ω r × (hub velocity), across and along the axes
  const double across = spec.rotor_drag_coefficient_kg,
               along = spec.rotor_axial_drag_coefficient_kg;
  const RotorLoads& n = rotors;
  const double hub_x = u * n.s + q * n.sz - r * n.sy;
  const double hub_y = v * n.s + r * n.sx - p * n.sz;
  const double hub_z = w * n.s + p * n.sy - q * n.sx;
  // r × F of each rotor's drag force, summed.
  double torque_x = n.torque_x + across * (v * n.sz + r * n.sxz - p * n.szz) -
                    along * (w * n.sy + p * n.syy - q * n.sxy);
  double torque_y = n.torque_y - across * (u * n.sz + q * n.szz - r * n.syz) +
                    along * (w * n.sx + p * n.sxy - q * n.sxx);
  double torque_z = n.torque_z + reaction_z - across * (v * n.sx + r * n.sxx - p * n.sxz) +
                    across * (u * n.sy + q * n.syz - r * n.syy);
  const double rolling = spec.rolling_moment_coefficient_kgm;
  // The rolling moment is along the hub's velocity across the axis.
  torque_x -= rolling * (u * n.r + q * n.rz - r * n.ry);
  torque_y -= rolling * (v * n.r + r * n.rx - p * n.rz);

  const auto& linear = spec.linear_drag_kgps;
  const auto& quadratic = spec.quadratic_drag_kgpm;
  const double force_x = -across * hub_x - (linear[0] + quadratic[0] * std::abs(u)) * u;
  const double force_y = -across * hub_y - (linear[1] + quadratic[1] * std::abs(v)) * v;
  const double force_z = n.thrust - along * hub_z - (linear[2] + quadratic[2] * std::abs(w)) * w;

  // Gyroscopic torques of the body and of the rotors
  const double jx = model.inertia_kgm2.x(), jy = model.inertia_kgm2.y(),
               jz = model.inertia_kgm2.z();
  torque_x -= q * (jz * r + n.momentum) - r * jy * q;
  torque_y -= r * jx * p - p * (jz * r + n.momentum);
  torque_z -= p * jy * q - q * jx * p;
  torque_x += environment.torque_body_nm.x();
  torque_y += environment.torque_body_nm.y();
  torque_z += environment.torque_body_nm.z();

  const double im = model.inverse_mass;
  const Vector3d& external = environment.force_world_n;
  // Position, velocity, quaternion (½ q ⊗ ω), rates.
  return {m.velocity,
          {im * (r00 * force_x + r01 * force_y + r02 * force_z + external.x()),
           im * (r10 * force_x + r11 * force_y + r12 * force_z + external.y()),
           im * (r20 * force_x + r21 * force_y + r22 * force_z + external.z()) - spec.gravity_mps2},
          -0.5 * (m.x * p + m.y * q + m.z * r),
          0.5 * (m.w * p + m.y * r - m.z * q),
          0.5 * (m.w * q + m.z * p - m.x * r),
          0.5 * (m.w * r + m.x * q - m.y * p),
          {torque_x * model.inverse_inertia.x(), torque_y * model.inverse_inertia.y(),
           torque_z * model.inverse_inertia.z()}};
}

Motion motion(const VehicleState& state) {
  const Eigen::Quaterniond& q = state.q_world_body;
  return {state.position_world, state.velocity_world, q.w(), q.x(), q.y(), q.z(), state.rates_body};
}

/// Torque on the body about z of rotors speeding up towards their commands.
double reaction_torque(const VehicleModel& model, const Rotors& speed, const Rotors& target,
                       const Rotors& inverse_lag_per_s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.rotor_count); ++i) {
    sum -= model.spin[i] * (target[i] - speed[i]) * inverse_lag_per_s[i];
  }
  return sum * model.spec.rotor_inertia_kgm2;
}

RotorLoads loads_now(const VehicleModel& model, const VehicleState& state) {
  AB_CHECK(state.rotor_speed_radps.size() == model.rotor_count, state.rotor_speed_radps.size());
  Rotors speed{};
  for (int i = 0; i < model.rotor_count; ++i) {
    speed[static_cast<std::size_t>(i)] = state.rotor_speed_radps[i];
  }
  return rotor_loads(model, speed);
}

}  // namespace

VehicleState step_by(const VehicleModel& model, const VehicleState& state,
                     const RotorVector& command_radps, const Environment& environment,
                     double dt_s) {
  AB_CHECK(state.rotor_speed_radps.size() == model.rotor_count &&
               command_radps.size() == model.rotor_count,
           state.rotor_speed_radps.size(), command_radps.size(), model.rotor_count);
  const VehicleSpec& spec = model.spec;
  const double half = 0.5 * dt_s;
  // Nearly all steps have the physics period, whose exponentials are kept; others are split by an
  // event.
  const bool common_step = dt_s == model.lag_step_s;
  const double keep_up = common_step ? model.lag_up : math::exp(-half / spec.time_constant_up_s);
  const double keep_down =
      common_step ? model.lag_down : math::exp(-half / spec.time_constant_down_s);

  // The rotors' speeds at the start, the middle and the end: exact, since the commands are
  // constant.
  Rotors start{}, middle{}, end{}, target{}, inverse_lag{};
  for (int j = 0; j < model.rotor_count; ++j) {
    const auto i = static_cast<std::size_t>(j);
    start[i] = state.rotor_speed_radps[j];
    target[i] = std::min(std::max(command_radps[j], 0.0), spec.max_rotor_speed_radps);
    const bool up = target[i] > start[i];
    const double keep = up ? keep_up : keep_down;
    middle[i] = target[i] + (start[i] - target[i]) * keep;
    end[i] = target[i] + (start[i] - target[i]) * (keep * keep);
    inverse_lag[i] = 1.0 / (up ? spec.time_constant_up_s : spec.time_constant_down_s);
  }
  const RotorLoads at_start = rotor_loads(model, start);
  const RotorLoads at_middle = rotor_loads(model, middle);
  const RotorLoads at_end = rotor_loads(model, end);
  // The rotors' momentum changes only about z: their axes are the body's.
  double reaction_start = 0.0, reaction_middle = 0.0, reaction_end = 0.0;
  if (spec.motor_reaction_torque) {
    reaction_start = reaction_torque(model, start, target, inverse_lag);
    reaction_middle = reaction_torque(model, middle, target, inverse_lag);
    reaction_end = reaction_torque(model, end, target, inverse_lag);
  }

  const Motion y = motion(state);
  const Motion k1 = derivative(model, y, at_start, reaction_start, environment);
  const Motion k2 = derivative(model, moved(y, k1, half), at_middle, reaction_middle, environment);
  const Motion k3 = derivative(model, moved(y, k2, half), at_middle, reaction_middle, environment);
  const Motion k4 = derivative(model, moved(y, k3, dt_s), at_end, reaction_end, environment);
  const double sixth = dt_s / 6.0;
  const auto mean = [sixth](double a, double b, double c, double d) {
    // Brackets fix the order of the sums, and with it the last bit.
    return sixth * ((a + d) + 2.0 * (b + c));
  };

  VehicleState next;
  next.tick = state.tick;
  next.position_world =
      y.position + sixth * ((k1.position + k4.position) + 2.0 * (k2.position + k3.position));
  next.velocity_world =
      y.velocity + sixth * ((k1.velocity + k4.velocity) + 2.0 * (k2.velocity + k3.velocity));
  next.rates_body = y.rates + sixth * ((k1.rates + k4.rates) + 2.0 * (k2.rates + k3.rates));
  const double w = y.w + mean(k1.w, k2.w, k3.w, k4.w);
  const double qx = y.x + mean(k1.x, k2.x, k3.x, k4.x);
  const double qy = y.y + mean(k1.y, k2.y, k3.y, k4.y);
  const double qz = y.z + mean(k1.z, k2.z, k3.z, k4.z);
  // RK4 leaves the unit sphere by its error of fifth order; each step comes back.
  const double scale = 1.0 / std::sqrt((w * w + qx * qx) + (qy * qy + qz * qz));
  next.q_world_body = Eigen::Quaterniond(scale * w, scale * qx, scale * qy, scale * qz);
  next.rotor_speed_radps.resize(model.rotor_count);
  for (int i = 0; i < model.rotor_count; ++i) {
    next.rotor_speed_radps[i] = end[static_cast<std::size_t>(i)];
  }
  return next;
}

VehicleState step(const VehicleModel& model, const VehicleState& state,
                  const RotorVector& command_radps, const Environment& environment, Tick dt_ticks) {
  VehicleState next = step_by(model, state, command_radps, environment, seconds(dt_ticks));
  next.tick = state.tick + dt_ticks;
  return next;
}

Eigen::Vector3d acceleration_world(const VehicleModel& model, const VehicleState& state,
                                   const Environment& environment) {
  return derivative(model, motion(state), loads_now(model, state), 0.0, environment).velocity;
}

Eigen::Vector3d angular_acceleration_body(const VehicleModel& model, const VehicleState& state,
                                          const Environment& environment) {
  return derivative(model, motion(state), loads_now(model, state), 0.0, environment).rates;
}

double rotor_power_w(const VehicleModel& model, const VehicleState& state) {
  double sum = 0.0;
  for (int i = 0; i < model.rotor_count; ++i) {
    const double speed = state.rotor_speed_radps[i];
    sum += speed * speed * speed;
  }
  // Drag torque k_m k_f Ω², times Ω.
  return model.spec.moment_coefficient_m * model.spec.thrust_coefficient_ns2 * sum;
}

}  // namespace avoidbench
