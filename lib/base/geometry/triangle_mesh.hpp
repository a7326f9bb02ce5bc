#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace avoidbench {

/// Triangles over shared vertices, metres. Corner order is counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace avoidbench
