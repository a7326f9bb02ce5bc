#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "trial/recording_spec.hpp"

namespace avoidbench {

/// A position that was measured.
struct MeasuredPosition {
  double time_s = 0.0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
};

/// Where a vehicle was at a moment.
struct PathState {
  double time_s = 0.0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();
};

/// The most likely path through measured positions, where jerk is white noise along each axis by
/// itself: the quintic smoothing spline (Wahba 1978), by a Kalman filter and the smoother of Rauch,
/// Tung and Striebel (1965). Positions have independent errors of `position_noise_m`; the jerk's
/// spectral density is jerk_mps3² · 0.1 s.
class SmoothPath {
 public:
  /// Times rise strictly; at least one position.
  SmoothPath(const std::vector<MeasuredPosition>& measured, const SmoothingSpec& smoothing);

  /// Between first and last time; before and after them the path's ends, extended.
  PathState at(double time_s) const;

  /// Root mean square of the distance from measured positions to the path, per axis.
  double residual_m() const { return residual_m_; }

 private:
  std::vector<PathState> knots_;  ///< one at each measured position
  double residual_m_ = 0.0;
};

}  // namespace avoidbench
