#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace avoidbench {

/// Three corners of a polygon, by their numbers.
using CornerTriple = std::array<std::uint32_t, 3>;

/// Cuts a polygon of at least three corners to triangles that turn as it does. It may be concave
/// and, about, planar. A quad is cut at its concave corner, else at its first; a larger polygon
/// loses ears, from the first corner on. False where that can't be done since its edges cross, as
/// seen along its normal. `triangles` is what it is cut to, in place of what was in it.
bool cut_polygon(const std::vector<Eigen::Vector3f>& corners, std::vector<CornerTriple>& triangles);

}  // namespace avoidbench
