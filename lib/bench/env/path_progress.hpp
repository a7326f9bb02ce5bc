#pragma once

#include <Eigen/Core>
#include <span>

namespace avoidbench {

/// How far along the polyline the point of it is that is nearest to `place`, m; of several the
/// first. 0 for fewer than two points.
double arc_length_m(std::span<const Eigen::Vector3d> path, const Eigen::Vector3d& place);

}  // namespace avoidbench
