#pragma once

#include <Eigen/Core>

#include "planning/rolling_grid.hpp"

namespace mbplanner {

/// The map as a box of this size sees it, between two heights.
struct Space {
  const planning::RollingGrid* grid = nullptr;
  Eigen::Vector3d box_m = Eigen::Vector3d::Zero();
  double lowest_m = 0.0, highest_m = 0.0;  ///< of the box's centre

  planning::CellState at(const Eigen::Vector3d& position) const {
    if (position.z() < lowest_m || position.z() > highest_m) return planning::CellState::occupied;
    return grid->box_state(position, box_m);
  }
  bool is_free(const Eigen::Vector3d& position) const {
    return at(position) == planning::CellState::free;
  }
};

}  // namespace mbplanner
