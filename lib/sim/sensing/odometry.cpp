#include "sensing/odometry.hpp"

#include <cmath>

#include "base/math.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// One after the other, as in imu.cpp: the order of a call's arguments is not fixed.
Vector3d normals(double sigma, RandomStream& random) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return sigma * Vector3d(x, y, z);
}

void draw_white_noise(OdometryState& state, const OdometrySpec& odometry, RandomStream& random) {
  state.position_noise = normals(odometry.position_sigma_m, random);
  state.velocity_noise = normals(odometry.velocity_sigma_mps, random);
  state.attitude_noise_rad = normals(odometry.attitude_sigma_deg * math::kDegree, random);
  state.rates_noise = normals(odometry.rates_sigma_radps, random);
}

/// The rotation by this vector, angle = its length.
Eigen::Quaterniond rotation_by(const Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  const Vector3d imaginary = rotation_rad * (math::sin(0.5 * angle) / angle);
  return {math::cos(0.5 * angle), imaginary.x(), imaginary.y(), imaginary.z()};
}

}  // namespace

bool is_perfect(const OdometrySpec& o) {
  return o.delay_ms == 0.0 && o.position_sigma_m == 0.0 && o.velocity_sigma_mps == 0.0 &&
         o.attitude_sigma_deg == 0.0 && o.rates_sigma_radps == 0.0 &&
         o.position_drift_ratio == 0.0 && o.yaw_drift_deg_per_sqrt_s == 0.0;
}

OdometryState make_odometry(const OdometrySpec& odometry, const VehicleState& truth,
                            RandomStream& random) {
  OdometryState state;
  state.anchor_true_world = truth.position_world;
  state.anchor_world = truth.position_world;
  draw_white_noise(state, odometry, random);
  return state;
}

void advance(OdometryState& state, const OdometrySpec& odometry, const VehicleState& truth,
             double dt_s, RandomStream& random) {
  // The drift hangs on the way, not on time: who hovers does not drift.
  const Vector3d way = truth.position_world - state.anchor_true_world;
  // A random walk along the way: its deviation grows with the root of the way.
  const double drift_m = odometry.position_drift_ratio * std::sqrt(way.norm());
  // The way is added as it was believed, turned by the drift of the yaw: errors of heading become
  // errors of position, as in real odometry.
  state.anchor_world += yaw_rotation(state.yaw_drift_rad) * way + normals(drift_m, random);
  state.anchor_true_world = truth.position_world;
  state.yaw_drift_rad +=
      odometry.yaw_drift_deg_per_sqrt_s * math::kDegree * std::sqrt(dt_s) * random.normal();
  draw_white_noise(state, odometry, random);
}

VehicleState estimated(const OdometryState& state, const VehicleState& truth) {
  const Eigen::Quaterniond drift = yaw_rotation(state.yaw_drift_rad);
  VehicleState estimate = truth;
  estimate.position_world = state.anchor_world +
                            drift * (truth.position_world - state.anchor_true_world) +
                            state.position_noise;
  estimate.velocity_world = drift * truth.velocity_world + state.velocity_noise;
  estimate.q_world_body =
      (drift * truth.q_world_body * rotation_by(state.attitude_noise_rad)).normalized();
  estimate.rates_body = truth.rates_body + state.rates_noise;
  return estimate;
}

VehicleState estimated_as(const OdometryState& state, const VehicleState& estimate) {
  const Eigen::Quaterniond back = yaw_rotation(-state.yaw_drift_rad);
  VehicleState truth = estimate;
  truth.position_world =
      state.anchor_true_world + back * (estimate.position_world - state.anchor_world);
  truth.velocity_world = back * estimate.velocity_world;
  truth.q_world_body = (back * estimate.q_world_body).normalized();
  return truth;
}

}  // namespace avoidbench
