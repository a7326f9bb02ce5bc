#pragma once

#include <Eigen/Core>

namespace avoidbench {

/// Where the vehicle ought to be now, for the position controller. Yaw counts on over whole turns.
struct Reference {
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d jerk_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double yaw_rate_radps = 0.0;
};

/// What the body-rate loop is to reach: rates, and collective thrust over mass.
struct RateTarget {
  Eigen::Vector3d rates_body_radps = Eigen::Vector3d::Zero();
  double thrust_mps2 = 0.0;
};

}  // namespace avoidbench
