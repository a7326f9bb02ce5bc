/* The arrays of planner.h as Eigen types, without copies. Optional: include it where Eigen is at
 * hand.
 *
 * SPDX-License-Identifier: MIT
 * This header may be used in and linked with planners under any licence, closed ones too.
 */
#ifndef AVOIDBENCH_PLANNER_EIGEN_HPP
#define AVOIDBENCH_PLANNER_EIGEN_HPP

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "avoidbench/planner.hpp"

namespace avoidbench {

/// Canvas takes std::vector<Eigen::Vector3d>.
template <>
struct IsThreeDoubles<Eigen::Vector3d> : std::true_type {};

/// height x width, row-major.
using DepthMap =
    Eigen::Map<const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

inline Eigen::Map<const Eigen::Vector3d> as_vector(const double (&array)[3]) {
  return Eigen::Map<const Eigen::Vector3d>(array);
}
inline Eigen::Map<Eigen::Vector3d> as_vector(double (&array)[3]) {
  return Eigen::Map<Eigen::Vector3d>(array);
}
inline Eigen::Map<const Eigen::Vector3d> as_vector(const Vec3& array) {
  return Eigen::Map<const Eigen::Vector3d>(array.data());
}
inline Vec3 as_array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// From (w, x, y, z); Eigen keeps another order in memory, so this one copies four numbers.
inline Eigen::Quaterniond as_quaternion(const double (&wxyz)[4]) {
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

/// T_world_camera of an image.
inline Eigen::Isometry3d pose_of(const ab_depth_image& image) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = as_quaternion(image.q_world_camera).toRotationMatrix();
  pose.translation() = as_vector(image.position_world_m);
  return pose;
}

/// T_world_body of a state.
inline Eigen::Isometry3d pose_of(const ab_state& state) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = as_quaternion(state.q_world_body).toRotationMatrix();
  pose.translation() = as_vector(state.position_world_m);
  return pose;
}

/// The image's pixels, metres along camera z; +inf no return, NaN invalid.
inline DepthMap depth_of(const ab_depth_image& image) {
  return {image.depth_m, image.height_px, image.width_px};
}

}  // namespace avoidbench

#endif
