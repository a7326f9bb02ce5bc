#include <algorithm>

#include "avoidbench/portable_math.hpp"
#include "ros_shim/set_point.h"
#include "tf/transform_datatypes.h"

namespace tf {

namespace portable = avoidbench::portable;

void Quaternion::setRPY(double roll, double pitch, double yaw) {
  *this = createQuaternionFromRPY(roll, pitch, yaw);
}

Quaternion createQuaternionFromRPY(double roll, double pitch, double yaw) {
  const double cr = portable::cos(0.5 * roll), sr = portable::sin(0.5 * roll);
  const double cp = portable::cos(0.5 * pitch), sp = portable::sin(0.5 * pitch);
  const double cy = portable::cos(0.5 * yaw), sy = portable::sin(0.5 * yaw);
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

void Matrix3x3::getRPY(double& roll, double& pitch, double& yaw, unsigned) const {
  roll = portable::atan2(rows_[2][1], rows_[2][2]);
  pitch = portable::asin(std::max(-1.0, std::min(1.0, -rows_[2][0])));
  yaw = portable::atan2(rows_[1][0], rows_[0][0]);
}

double getYaw(const Quaternion& q) {
  return ros_shim::yaw_of_quaternion(q.x(), q.y(), q.z(), q.w());
}

double getYaw(const geometry_msgs::Quaternion& q) {
  return ros_shim::yaw_of_quaternion(q.x, q.y, q.z, q.w);
}

}  // namespace tf
