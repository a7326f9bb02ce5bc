#pragma once

#include <Eigen/Core>

#include "planning/rolling_grid.hpp"

namespace mbplanner {

/// Occupied where any touched cell is; else unknown where any is, or beyond the grid; else free.
inline planning::CellState box_state(const planning::RollingGrid& grid,
                                     const Eigen::Vector3d& center_world,
                                     const Eigen::Vector3d& size_m) {
  using planning::CellState;
  const planning::Cell from = grid.cell_of(center_world - 0.5 * size_m);
  const planning::Cell to = grid.cell_of(center_world + 0.5 * size_m);
  bool is_known = true;
  for (int x = from.x(); x <= to.x(); ++x) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int z = from.z(); z <= to.z(); ++z) {
        const CellState state = grid.state({x, y, z});
        if (state == CellState::occupied) return state;
        if (state == CellState::unknown) is_known = false;
      }
    }
  }
  return is_known ? CellState::free : CellState::unknown;
}

/// The map as a box of this size sees it, between two heights.
struct Space {
  const planning::RollingGrid* grid = nullptr;
  Eigen::Vector3d box_m = Eigen::Vector3d::Zero();
  double lowest_m = 0.0, highest_m = 0.0;  ///< of the box's centre

  planning::CellState at(const Eigen::Vector3d& position) const {
    if (position.z() < lowest_m || position.z() > highest_m) return planning::CellState::occupied;
    return box_state(*grid, position, box_m);
  }
  bool is_free(const Eigen::Vector3d& position) const {
    return at(position) == planning::CellState::free;
  }
};

}  // namespace mbplanner
