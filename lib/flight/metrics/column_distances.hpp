#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <queue>
#include <vector>

#include "metrics/clearance_grid.hpp"
#include "metrics/taut_path.hpp"

namespace avoidbench {

/// How far it is at least from a place to a goal region around what stands in the way: over the
/// grid's columns, each open where a ball may fit at some height. A bound for the search for the
/// reference path, which then leaves aside what leads nowhere. Columns are looked at when they are
/// asked for, the nearest to the goal first. One thread at a time.
class ColumnDistances {
 public:
  /// `grid` must outlive it.
  ColumnDistances(ClearanceGrid& grid, const GoalRegion& goal, double radius_m);

  /// About the least length of the ball's way from `place_world` to the region, m: a way over the
  /// columns, less what is lost by going from column to column; straight where none leads there.
  double at_least_m(const Eigen::Vector3d& place_world);

 private:
  struct Open {
    double distance_m;
    std::int64_t column;
    bool operator<(const Open& other) const {  // the queue pops the greatest
      return distance_m != other.distance_m ? distance_m > other.distance_m : column > other.column;
    }
  };
  struct Column {
    double distance_m;
    bool is_settled, is_known, is_open;
  };

  bool is_open(int x, int y);
  void settle_next();

  ClearanceGrid& grid_;
  GoalRegion goal_;
  double least_clearance_m_;  ///< at a cell's centre, for a ball that may move half a cell
  int first_layer_;           ///< where columns are looked at first: at the goal's height
  std::vector<Column> columns_;
  std::priority_queue<Open> open_;
};

}  // namespace avoidbench
