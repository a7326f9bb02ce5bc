#pragma once

#include <Eigen/Core>
#include <array>

namespace avoidbench {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// The point of the triangle nearest to `point` (Ericson, Real-Time Collision Detection, §5.1.5).
Eigen::Vector3d closest_point(const Eigen::Vector3d& point, const Triangle& triangle);

/// Whether the box centred at the origin with these half extents touches the triangle (separating
/// axes, Akenine-Möller 2001). Touching counts.
bool overlaps(const Eigen::Vector3d& half_extents, const Triangle& triangle);

/// Least distance between the box centred at the origin and the triangle; 0 where they touch.
double distance(const Eigen::Vector3d& half_extents, const Triangle& triangle);

}  // namespace avoidbench
