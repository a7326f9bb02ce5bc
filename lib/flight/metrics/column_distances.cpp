#include "metrics/column_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace avoidbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Straight lines are followed by moves to the 8 columns around and by the 8 of a knight. The worst
// direction lies between (1, 0) and (2, 1): there the moves are longer than the line by
// 1 / cos(atan(1/2) / 2) = 1.0275.
constexpr double kLineShare = 0.9732;
// A line's ends are half a column's diagonal from the centres at most.
constexpr double kRoundedCells = 1.42;

}  // namespace

ColumnDistances::ColumnDistances(ClearanceGrid& grid, const GoalRegion& goal, double radius_m)
    : grid_(grid),
      goal_(goal),
      least_clearance_m_(radius_m - ClearanceGrid::kSightTolerance_m - 0.5 * grid.cell_m()),
      first_layer_(grid.cell_of(goal.center_world).z()),
      columns_(
          static_cast<std::size_t>(grid.size().x()) * static_cast<std::size_t>(grid.size().y()),
          {.distance_m = kInfinity, .is_settled = false, .is_known = false, .is_open = false}) {
  const double reach_m = goal.radius_m + 0.5 * std::sqrt(2.0) * grid.cell_m();
  for (int y = 0; y < grid.size().y(); ++y) {
    for (int x = 0; x < grid.size().x(); ++x) {
      const Eigen::Vector3d way = grid.centre({x, y, 0}) - goal.center_world;
      if (way.head<2>().norm() > reach_m || !is_open(x, y)) continue;
      const std::int64_t column = std::int64_t{y} * grid.size().x() + x;
      columns_[static_cast<std::size_t>(column)].distance_m = 0.0;
      open_.push({0.0, column});
    }
  }
}

double ColumnDistances::at_least_m(const Eigen::Vector3d& place_world) {
  const Eigen::Vector3i cell = grid_.cell_of(place_world);
  const Column& column =
      columns_[static_cast<std::size_t>(std::int64_t{cell.y()} * grid_.size().x() + cell.x())];
  while (!column.is_settled && !open_.empty()) settle_next();
  const double straight_m =
      std::max(0.0, (goal_.center_world - place_world).head<2>().norm() - goal_.radius_m);
  // A start or goal may stand where its column is closed.
  if (!column.is_settled) return straight_m;
  return std::max(straight_m, kLineShare * column.distance_m - kRoundedCells * grid_.cell_m());
}

/// Heights nearest to the goal's first: most columns are open there.
bool ColumnDistances::is_open(int x, int y) {
  Column& column = columns_[static_cast<std::size_t>(std::int64_t{y} * grid_.size().x() + x)];
  if (column.is_known) return column.is_open;
  column.is_known = true;
  const int height = grid_.size().z();
  for (int step = 0; step < height && !column.is_open; ++step) {
    for (const int z : {first_layer_ + step, first_layer_ - step}) {
      if (z < 0 || z >= height) continue;
      column.is_open = column.is_open || grid_.clearance_m({x, y, z}) >= least_clearance_m_;
    }
  }
  return column.is_open;
}

/// Dijkstra's next column.
void ColumnDistances::settle_next() {
  const std::int64_t width = grid_.size().x(), depth = grid_.size().y();
  const Open here = open_.top();
  open_.pop();
  Column& settled = columns_[static_cast<std::size_t>(here.column)];
  if (settled.is_settled) return;
  settled.is_settled = true;
  const auto x = static_cast<int>(here.column % width), y = static_cast<int>(here.column / width);
  const auto is_open_at = [&](int at_x, int at_y) {
    return at_x >= 0 && at_x < width && at_y >= 0 && at_y < depth && is_open(at_x, at_y);
  };
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int far = std::max(std::abs(dx), std::abs(dy)),
                near = std::min(std::abs(dx), std::abs(dy));
      const bool is_knight = far == 2 && near == 1;
      if (far != 1 && !is_knight) continue;
      if (!is_open_at(x + dx, y + dy)) continue;
      // A line to there goes through two columns beside each other.
      const int half_x = dx / 2, half_y = dy / 2;
      if (is_knight && !is_open_at(x + half_x, y + half_y) &&
          !is_open_at(x + dx - half_x, y + dy - half_y)) {
        continue;
      }
      const std::int64_t next = (y + dy) * width + x + dx;
      const double distance_m =
          here.distance_m + grid_.cell_m() * std::sqrt(double(dx * dx + dy * dy));
      Column& other = columns_[static_cast<std::size_t>(next)];
      if (distance_m >= other.distance_m) continue;
      other.distance_m = distance_m;
      open_.push({distance_m, next});
    }
  }
}

}  // namespace avoidbench
