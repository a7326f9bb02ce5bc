#include "control/lee_controller.hpp"

#include <algorithm>

#include "base/math.hpp"
#include "control/position_controller.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Least vertical part of the demanded acceleration: never upside down.
constexpr double kMinVerticalMps2 = 1.0;

/// Axes with z along `thrust`, which is not horizontal, and x as near as may be to the heading.
Matrix3d wanted_axes(const Vector3d& thrust, double yaw_rad) {
  const Vector3d x_heading(math::cos(yaw_rad), math::sin(yaw_rad), 0.0);
  Matrix3d axes;
  axes.col(2) = thrust / thrust.norm();
  const Vector3d y = axes.col(2).cross(x_heading);
  axes.col(1) = y / y.norm();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

}  // namespace

ThrustAndTorque lee_control(const VehicleModel& model, const VehicleState& state,
                            const Reference& reference) {
  const LeeControllerSpec& gains = model.spec.lee_controller;
  const double mass_kg = gains.mass_kg > 0.0 ? gains.mass_kg : model.spec.mass_kg;
  const double g = gains.gravity_mps2 > 0.0 ? gains.gravity_mps2 : model.spec.gravity_mps2;

  const Vector3d position_error = state.position_world - reference.position_world;
  const Vector3d velocity_error = state.velocity_world - reference.velocity_world;
  // Gains are forces here, unlike those of the other controller: N per metre and per m/s.
  const Vector3d feedback_n = to_eigen(gains.position_n_per_m).cwiseProduct(position_error) +
                              to_eigen(gains.velocity_ns_per_m).cwiseProduct(velocity_error);
  Vector3d demand = reference.acceleration_world - feedback_n / mass_kg;
  demand.z() += g;
  demand = tilt_limited(demand, kMinVerticalMps2, model.spec.max_tilt_rad);

  const Matrix3d R = state.q_world_body.toRotationMatrix();
  const Matrix3d R_wanted = wanted_axes(demand, reference.yaw_rad);
  const Matrix3d turn = R_wanted.transpose() * R;
  const Vector3d attitude_error =
      // The vee map: the skew matrix of the paper, as a vector.
      0.5 * Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  // A yaw rate is about the wanted z axis; `turn` brings it into the body's.
  Vector3d rates_wanted = turn.transpose() * Vector3d(0.0, 0.0, reference.yaw_rate_radps);
  Vector3d gyroscopic_nm = Vector3d::Zero();
  if (gains.feed_forward) {
    const FlatState flat = flat_state(reference, Vector3d::Zero(), g);
    rates_wanted = R.transpose() * (flat.R_world_body * flat.rates_body_radps);
    gyroscopic_nm = state.rates_body.cross(model.inertia_kgm2.cwiseProduct(state.rates_body));
  }
  ThrustAndTorque wanted;
  // Rotors only push.
  wanted.thrust_n = std::max(0.0, mass_kg * demand.dot(R.col(2)));
  wanted.torque_body_nm =
      gyroscopic_nm - to_eigen(gains.attitude_nm_per_rad).cwiseProduct(attitude_error) -
      to_eigen(gains.rates_nms_per_rad).cwiseProduct(state.rates_body - rates_wanted);
  return wanted;
}

}  // namespace avoidbench
