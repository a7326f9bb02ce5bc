#include "control/position_controller.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kAlmostZero = 1e-3;

double limited(double value, double limit) { return std::min(std::max(value, -limit), limit); }

/// The horizontal part, no longer than `limit`.
Eigen::Vector2d limited_across(const Vector3d& value, double limit) {
  const Eigen::Vector2d across = value.head<2>();
  const double size = across.norm();
  return size > limit ? Eigen::Vector2d(across * (limit / size)) : across;
}

/// Axes with z along `thrust` and y as near as may be to `y_heading`; at a roll of 90° any x across
/// z serves.
Matrix3d axes_along(const Vector3d& thrust, const Vector3d& y_heading) {
  const double size = thrust.norm();
  const Vector3d z = size > kAlmostZero ? Vector3d(thrust / size) : Vector3d::UnitZ();
  Vector3d x = y_heading.cross(z);
  const double across = x.norm();
  if (across > kAlmostZero) {
    x /= across;
  } else {
    x = Vector3d(-y_heading.y(), y_heading.x(), 0.0).cross(y_heading).cross(z).normalized();
  }
  Matrix3d axes;
  axes.col(0) = x;
  axes.col(1) = z.cross(x);
  axes.col(2) = z;
  return axes;
}

/// Twice the vector part of the unit quaternion of R, on the side where its scalar part is
/// positive.
Vector3d twice_quaternion_vector(const Matrix3d& R) {
  const double w_squared_4 = 1.0 + R(0, 0) + R(1, 1) + R(2, 2);
  const Vector3d skew(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  constexpr double kFarFromHalfTurn = 0.1;
  // 2 q = skew / (2 w): short, and exact enough where w is not small.
  if (w_squared_4 > kFarFromHalfTurn) return skew / std::sqrt(w_squared_4);
  // Near half a turn, by the greatest of the four components.
  const Eigen::Quaterniond q(R);
  return (q.w() < 0.0 ? -2.0 : 2.0) * q.vec();
}

}  // namespace

Vector3d tilt_limited(const Vector3d& demand, double min_vertical, double max_tilt_rad) {
  Vector3d limited_demand = demand;
  limited_demand.z() = std::max(demand.z(), min_vertical);
  const double across = math::hypot(demand.x(), demand.y());
  // Only steep demands need the tangent.
  if (across > 0.05 * limited_demand.z()) {
    const double most = limited_demand.z() * math::tan(max_tilt_rad);
    if (across > most) limited_demand.head<2>() *= most / across;
  }
  return limited_demand;
}

FlatState flat_state(const Reference& reference, const Vector3d& drag_per_s, double gravity_mps2) {
  const Vector3d& v = reference.velocity_world;
  const Vector3d& a = reference.acceleration_world;
  const Vector3d& j = reference.jerk_world;
  const double dx = drag_per_s.x(), dy = drag_per_s.y(), dz = drag_per_s.z();
  const double sin_yaw = math::sin(reference.yaw_rad), cos_yaw = math::cos(reference.yaw_rad);
  const Vector3d x_heading(cos_yaw, sin_yaw, 0.0), y_heading(-sin_yaw, cos_yaw, 0.0);
  // What thrust and drag together have to give.
  const Vector3d pull = a + Vector3d(0.0, 0.0, gravity_mps2);

  FlatState flat;
  flat.rates_body_radps.setZero();
  // The paper's α, β, γ: what the axes x, y and z are across to or along.
  const Vector3d alpha = pull + dx * v, beta = pull + dy * v, gamma = pull + dz * v;
  const Vector3d across = y_heading.cross(alpha);
  if (!(across.norm() > kAlmostZero)) {
    flat.R_world_body = axes_along(alpha, y_heading);
    flat.thrust_mps2 = flat.R_world_body.col(2).dot(gamma);
    return flat;
  }
  const Vector3d x_body = across / across.norm();
  const Vector3d along_y = beta.cross(x_body);
  const Vector3d y_body = along_y / along_y.norm();
  const Vector3d z_body = x_body.cross(y_body);
  flat.R_world_body.col(0) = x_body;
  flat.R_world_body.col(1) = y_body;
  flat.R_world_body.col(2) = z_body;
  flat.thrust_mps2 = z_body.dot(gamma);

  // A₂ω_x + C₂ω_z = D₂, B₁ω_y + C₁ω_z = D₁, B₃ω_y + C₃ω_z = D₃
  const double c = flat.thrust_mps2;
  const double vx = x_body.dot(v), vy = y_body.dot(v), vz = z_body.dot(v);
  const double b1 = c - (dz - dx) * vz, c1 = -(dx - dy) * vy;
  const double d1 = x_body.dot(j) + dx * x_body.dot(a);
  const double a2 = c + (dy - dz) * vz, c2 = (dx - dy) * vx;
  const double d2 = -y_body.dot(j) - dy * y_body.dot(a);
  const double b3 = -y_heading.dot(z_body), c3 = y_heading.cross(z_body).norm();
  const double d3 = reference.yaw_rate_radps * x_heading.dot(x_body);
  const double determinant = b1 * c3 - b3 * c1;
  // Else the rates stay zero.
  if (std::abs(determinant) > kAlmostZero && std::abs(a2) > kAlmostZero) {
    const double wz = (b1 * d3 - b3 * d1) / determinant;
    flat.rates_body_radps << (d2 - c2 * wz) / a2, (c3 * d1 - c1 * d3) / determinant, wz;
  }
  return flat;
}

RateTarget position_control(const VehicleModel& model, const VehicleState& state,
                            const Reference& reference) {
  const PositionControllerSpec& gains = model.spec.position_controller;
  const double g = model.spec.gravity_mps2;
  const Vector3d drag = gains.drag_compensation ? model.drag_per_s : Vector3d::Zero();
  const FlatState flat = flat_state(reference, drag, g);

  const Vector3d position_error = reference.position_world - state.position_world;
  const Vector3d velocity_error = reference.velocity_world - state.velocity_world;
  Vector3d demand = reference.acceleration_world;
  // Errors are limited: a far goal is no reason for a violent start.
  demand.head<2>() += gains.kp_xy * limited_across(position_error, gains.position_error_max_xy_m) +
                      gains.kd_xy * limited_across(velocity_error, gains.velocity_error_max_xy_mps);
  demand.z() += gains.kp_z * limited(position_error.z(), gains.position_error_max_z_m) +
                gains.kd_z * limited(velocity_error.z(), gains.velocity_error_max_z_mps) + g;
  const Matrix3d& R_reference = flat.R_world_body;
  // Drag at the reference's velocity, in its own axes.
  demand += R_reference * (drag.cwiseProduct(R_reference.transpose() * reference.velocity_world));
  demand = tilt_limited(demand, gains.min_thrust_mps2, model.spec.max_tilt_rad);

  const Matrix3d R = state.q_world_body.toRotationMatrix();
  const Vector3d y_heading(-math::sin(reference.yaw_rad), math::cos(reference.yaw_rad), 0.0);
  const Matrix3d R_wanted = axes_along(demand, y_heading);
  const Vector3d error = twice_quaternion_vector(R.transpose() * R_wanted);
  const Vector3d gain(gains.k_roll_pitch, gains.k_roll_pitch, gains.k_yaw);
  // The reference's rates, from its axes to the body's.
  const Vector3d feed_forward = R.transpose() * (R_reference * flat.rates_body_radps);
  RateTarget target;
  for (int i = 0; i < 3; ++i) {
    target.rates_body_radps[i] = limited(feed_forward[i] + gain[i] * error[i],
                                         model.spec.max_rates_radps[static_cast<std::size_t>(i)]);
  }
  const double most = model.max_rotor_thrust_n * model.rotor_count * model.inverse_mass;
  // The demand's part along the true thrust axis: all that thrust can do before the body has
  // turned.
  target.thrust_mps2 = std::min(std::max(demand.dot(R.col(2)), gains.min_thrust_mps2), most);
  return target;
}

}  // namespace avoidbench
