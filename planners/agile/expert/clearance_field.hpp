#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "metrics/clearance_grid.hpp"

namespace agile {

/// Distance to the nearest surface all over a map, negative inside obstacles, in steps of 1 cm from
/// −0.5 m to 2.05 m: what the expert knows and what training looks modes up in. Plain data.
struct ClearanceField {
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();  ///< centre of cell (0, 0, 0)
  double cell_m = 0.2;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  std::vector<std::uint8_t> steps;  ///< x fastest, then y, then z

  double clearance_m(std::size_t index) const { return 0.01 * steps[index] - 0.5; }
  /// Trilinear between the cells' centres; beyond the field its rim counts.
  double at(const Eigen::Vector3d& place_world) const;
};

/// Of the scene within `region`. What can't be reached from `free_places` without coming within
/// half a cell's width of a surface is taken for the inside of something.
ClearanceField make_clearance_field(avoidbench::ClearanceGrid& grid,
                                    const std::vector<Eigen::Vector3d>& free_places_world);

}  // namespace agile
