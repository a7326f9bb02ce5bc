#pragma once

#include <Eigen/Geometry>
#include <array>

namespace avoidbench {

/// `T_a_b` takes b's coordinates to a's. World ENU with z up, body FLU (x forward), camera RDF (z
/// forward).
using Pose = Eigen::Isometry3d;
using Aabb = Eigen::AlignedBox3d;

inline Eigen::Vector3d to_eigen(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline std::array<double, 3> to_array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline Pose make_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q) {
  Pose pose = Pose::Identity();
  pose.linear() = q.toRotationMatrix();
  pose.translation() = position;
  return pose;
}

/// The body-to-world rotation with this yaw about world z and no roll or pitch.
Eigen::Quaterniond yaw_rotation(double yaw_rad);

/// Yaw of a body-to-world rotation: the heading of body x in the world's horizontal plane, rad in
/// (-π, π].
double yaw_of(const Eigen::Quaterniond& q_world_body);

}  // namespace avoidbench
