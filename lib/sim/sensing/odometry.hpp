#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "base/fields.hpp"
#include "base/random.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// How wrong the vehicle knows its own state, as by visual-inertial odometry. All zero: it knows
/// the truth.
struct OdometrySpec {
  double rate_hz = 200.0;
  double delay_ms = 0.0;
  double position_sigma_m = 0.0;
  double velocity_sigma_mps = 0.0;
  double attitude_sigma_deg = 0.0;
  double rates_sigma_radps = 0.0;
  double position_drift_ratio = 0.0;
  double yaw_drift_deg_per_sqrt_s = 0.0;
};

template <class Visitor, ConstOr<OdometrySpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("rate_hz", s.rate_hz, Range{1, 4000}, "How often new noise is drawn, per second.");
  v.field("delay_ms", s.delay_ms, Range{0, 1000},
          "Age of the state that the planner gets. The vehicle's own controller has no delay.");
  v.field("position_sigma_m", s.position_sigma_m, Range{0, 10}, "White noise on each axis.");
  v.field("velocity_sigma_mps", s.velocity_sigma_mps, Range{0, 10}, "White noise on each axis.");
  v.field("attitude_sigma_deg", s.attitude_sigma_deg, Range{0, 45},
          "White noise about each body axis.");
  v.field("rates_sigma_radps", s.rates_sigma_radps, Range{0, 10}, "White noise on each axis.");
  v.field("position_drift_ratio", s.position_drift_ratio, Range{0, 1},
          "Random walk of the position: its standard deviation on each axis after 1 m of way; it "
          "grows with the square root of the way.");
  v.field("yaw_drift_deg_per_sqrt_s", s.yaw_drift_deg_per_sqrt_s, Range{0, 45},
          "Random walk of the yaw: its standard deviation after 1 s.");
}

/// Whether it says the truth at once.
bool is_perfect(const OdometrySpec& odometry);

/// Where the estimate stands. Between two ticks of the odometry the estimate follows the truth, so
/// that it can be asked at any time without a draw.
struct OdometryState {
  Eigen::Vector3d anchor_true_world = Eigen::Vector3d::Zero();  ///< at the last tick
  Eigen::Vector3d anchor_world = Eigen::Vector3d::Zero();  ///< the estimate, without white noise
  double yaw_drift_rad = 0.0;
  Eigen::Vector3d position_noise = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_noise = Eigen::Vector3d::Zero();
  Eigen::Vector3d attitude_noise_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_noise = Eigen::Vector3d::Zero();
};

/// The odometry at the start of a trial, where it is right: draws the first white noise.
OdometryState make_odometry(const OdometrySpec& odometry, const VehicleState& truth,
                            RandomStream& random);

/// One tick of the odometry, `dt_s` after the last: drift over the way since then, new white noise.
/// Draws sixteen normals.
void advance(OdometryState& state, const OdometrySpec& odometry, const VehicleState& truth,
             double dt_s, RandomStream& random);

/// What the odometry says where the truth is `truth`, at or after its last tick. The rotors are the
/// truth's. Velocity and position turn with the yaw drift.
VehicleState estimated(const OdometryState& state, const VehicleState& truth);

/// Reverse of estimated(), without its white noise: the truth that drift alone makes `estimate` of.
VehicleState estimated_as(const OdometryState& state, const VehicleState& estimate);

}  // namespace avoidbench
