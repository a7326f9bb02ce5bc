#include "geometry/pose.hpp"

#include "base/math.hpp"

namespace avoidbench {

Eigen::Quaterniond yaw_rotation(double yaw_rad) {
  return {math::cos(0.5 * yaw_rad), 0.0, 0.0, math::sin(0.5 * yaw_rad)};
}

double yaw_of(const Eigen::Quaterniond& q) {
  // Where the body's x axis points in the plane: R(1, 0) and R(0, 0).
  return math::atan2(2.0 * (q.x() * q.y() + q.w() * q.z()),
                     1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

}  // namespace avoidbench
