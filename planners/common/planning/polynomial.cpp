#include "planning/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace planning {

using Eigen::Vector3d;

Quintic quintic_between(const Motion& start, const Motion& end, double duration_s) {
  const double t = duration_s, t2 = t * t, t3 = t2 * t;
  // What is left to be done by the three highest terms.
  const Vector3d position =
      end.position - start.position - start.velocity * t - 0.5 * start.acceleration * t2;
  const Vector3d velocity = end.velocity - start.velocity - start.acceleration * t;
  const Vector3d acceleration = end.acceleration - start.acceleration;
  Quintic quintic;
  quintic.duration_s = t;
  quintic.coefficients.col(0) = start.position;
  quintic.coefficients.col(1) = start.velocity;
  quintic.coefficients.col(2) = 0.5 * start.acceleration;
  quintic.coefficients.col(3) =
      (10.0 * position - 4.0 * velocity * t + 0.5 * acceleration * t2) / t3;
  quintic.coefficients.col(4) =
      (-15.0 * position + 7.0 * velocity * t - acceleration * t2) / (t3 * t);
  quintic.coefficients.col(5) =
      (6.0 * position - 3.0 * velocity * t + 0.5 * acceleration * t2) / (t3 * t2);
  return quintic;
}

Motion motion_at(const Quintic& quintic, double time_s) {
  const double t = std::clamp(time_s, 0.0, quintic.duration_s);
  Motion motion;
  for (int k = 5; k >= 0; --k) motion.position = motion.position * t + quintic.coefficients.col(k);
  for (int k = 5; k >= 1; --k) {
    motion.velocity = motion.velocity * t + k * quintic.coefficients.col(k);
  }
  for (int k = 5; k >= 2; --k) {
    motion.acceleration = motion.acceleration * t + k * (k - 1) * quintic.coefficients.col(k);
  }
  return motion;
}

Vector3d jerk_at(const Quintic& quintic, double time_s) {
  const Eigen::Matrix<double, 3, 6>& c = quintic.coefficients;
  return 6.0 * c.col(3) + time_s * (24.0 * c.col(4) + time_s * 60.0 * c.col(5));
}

double trapezoid_time_s(double distance_m, double speed_mps, double acceleration_mps2) {
  const double speeding_m = speed_mps * speed_mps / acceleration_mps2;
  if (speeding_m > distance_m) return 2.0 * std::sqrt(distance_m / acceleration_mps2);
  return (distance_m - speeding_m) / speed_mps + 2.0 * speed_mps / acceleration_mps2;
}

}  // namespace planning
