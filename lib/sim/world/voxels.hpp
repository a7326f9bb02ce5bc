#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "world/world.hpp"

namespace avoidbench {

/// Cubic cells over a box. Cell (i, j, k) has its centre at lowest + (i + ½, j + ½, k + ½) · size.
struct VoxelGrid {
  Eigen::Vector3d lowest_world = Eigen::Vector3d::Zero();
  double size_m = 0.1;
  std::size_t columns = 0, rows = 0, layers = 0;  ///< along x, y and z
  std::vector<std::uint8_t> is_occupied;          ///< layers × rows × columns, x fastest

  std::size_t at(std::size_t column, std::size_t row, std::size_t layer) const {
    return (layer * rows + row) * columns + column;
  }
  Eigen::Vector3d centre_world(std::size_t column, std::size_t row, std::size_t layer) const {
    const Eigen::Vector3d cell(static_cast<double>(column), static_cast<double>(row),
                               static_cast<double>(layer));
    return lowest_world + (cell + Eigen::Vector3d::Constant(0.5)) * size_m;
  }
};

/// The cells of the map's bounds that a surface touches; what is inside solids stays empty.
/// Exact: boxes against triangles. Throws InputError where there would be more than 500 million
/// cells. `poll`, where given, is called now and then; what it throws ends the work.
VoxelGrid surface_voxels(const World& world, double size_m, const std::function<void()>& poll = {});

}  // namespace avoidbench
