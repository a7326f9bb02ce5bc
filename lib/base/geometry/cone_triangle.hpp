#pragma once

#include "geometry/box_triangle.hpp"

namespace avoidbench {

/// The directions between two cones around one axis, both with their apex at the origin.
struct ConeShell {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit
  double cos_inner = 1.0;                           ///< 1: no inner cone
  double cos_outer = 0.0;                           ///< in (0, cos_inner)
};

/// Least distance from the origin to a point of the triangle that lies in the shell; +inf if none
/// does. In closed form.
double distance(const ConeShell& shell, const Triangle& triangle);

}  // namespace avoidbench
