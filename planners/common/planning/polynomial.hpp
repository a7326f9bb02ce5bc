#pragma once

#include <Eigen/Core>

namespace planning {

/// Position, velocity and acceleration at one moment.
struct Motion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
};

/// A polynomial of degree 5 on each axis.
struct Quintic {
  Eigen::Matrix<double, 3, 6> coefficients =
      Eigen::Matrix<double, 3, 6>::Zero();  ///< of 1, t, … t⁵
  double duration_s = 0.0;
};

/// The one that joins two motions in `duration_s` > 0: the least jerk between them.
Quintic quintic_between(const Motion& start, const Motion& end, double duration_s);

/// Its motion at `time_s`, clamped to its duration.
Motion motion_at(const Quintic& quintic, double time_s);

/// Its jerk then, not clamped.
Eigen::Vector3d jerk_at(const Quintic& quintic, double time_s);

/// Time for a way of `distance_m` from rest to rest at these limits: a trapezoid, or a triangle
/// where the way is short.
double trapezoid_time_s(double distance_m, double speed_mps, double acceleration_mps2);

}  // namespace planning
