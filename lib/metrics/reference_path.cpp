#include "metrics/reference_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "metrics/taut_path.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Path = std::vector<Vector3d>;

/// Search state, by cell. The start is a cell of its own, moved to the true start point.
struct Search {
  ClearanceGrid& grid;
  double radius_m;
  Vector3d start;
  GoalRegion goal;
  std::int64_t start_index, goal_index;
  std::vector<double> cost_m;  ///< +inf: not reached
  // 32 bits hold the grid's 8 million cells.
  std::vector<std::int32_t> parent;  ///< of reached cells
  std::vector<bool> is_sighted;      ///< whether the way from the parent is known to be free
  std::vector<bool> closed;
  std::map<std::int64_t, Vector3d> beside_surface;  ///< places of such cells, once asked

  bool is_free(const Vector3d& point) {
    return grid.region().contains(point) && grid.is_free(point, radius_m);
  }
  Vector3d place(std::int64_t index);
};

/// Where the ball stands in a cell: at its centre, or, where a surface is about the ball's radius
/// from there, touching it. So paths can lie against surfaces, and their lengths are true enough to
/// choose by which side of an obstacle to pass.
Vector3d Search::place(std::int64_t index) {
  if (index == start_index) return start;
  if (index == goal_index) return goal.center_world;
  const Vector3i cell = grid.cell(index);
  const Vector3d centre = grid.centre(cell);
  const double lacking_m = radius_m - grid.clearance_m(cell);
  // A push of more than half a cell would end in the next cell, which has a place of its own.
  if (lacking_m <= 0.0 || lacking_m > 0.5 * grid.cell_m()) return centre;
  const auto [found, is_new] = beside_surface.try_emplace(index, centre);
  if (is_new) {
    // More than the rounding of float vertices, so that the ball is free where it touches.
    constexpr double kSpare_m = 1e-5;
    const Vector3d away = centre - grid.nearest_surface(centre);
    const Vector3d touching = centre + away.normalized() * (radius_m + kSpare_m - away.norm());
    if (is_free(touching)) found->second = touching;
  }
  return found->second;
}

/// No way from `place` to the goal region is shorter: it is reached at any height.
double heuristic_m(const Search& search, const Vector3d& place) {
  return std::max(0.0, (search.goal.center_world - place).head<2>().norm() - search.goal.radius_m);
}

/// An entry of the open list. Ties go to the longer way behind, then to the lower index, so that
/// the order is fixed.
struct Open {
  double total_m, cost_m;
  std::int64_t index;
  bool operator<(const Open& other) const {  // the queue pops the greatest
    if (total_m != other.total_m) return total_m > other.total_m;
    if (cost_m != other.cost_m) return cost_m < other.cost_m;
    return index > other.index;
  }
};

/// All 26 around the cell, as far as they are in the grid.
template <class Visit>
void for_each_neighbour(const Search& search, std::int64_t index, Visit visit_neighbour) {
  const Vector3i cell = search.grid.cell(index);
  const Vector3i& size = search.grid.size();
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Vector3i next = cell + Vector3i(dx, dy, dz);
        const bool is_itself = dx == 0 && dy == 0 && dz == 0;
        const bool is_outside = (next.array() < 0).any() || (next.array() >= size.array()).any();
        if (!is_itself && !is_outside) visit_neighbour(search.grid.index(next));
      }
    }
  }
}

/// Lazy Theta*: a cell inherited its parent's parent without looking; look now, and where there is
/// no line of sight take the best closed neighbour instead. False where none serves.
bool settle_parent(Search& search, std::int64_t index) {
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  const Vector3d here = search.place(index);
  const std::int64_t parent = search.parent[at(index)];
  if (search.grid.is_segment_free(search.place(parent), here, search.radius_m)) return true;
  double best_m = std::numeric_limits<double>::infinity();
  for_each_neighbour(search, index, [&](std::int64_t next) {
    if (!search.closed[at(next)]) return;
    const Vector3d there = search.place(next);
    const double cost_m = search.cost_m[at(next)] + (here - there).norm();
    if (cost_m >= best_m || !search.grid.is_segment_free(there, here, search.radius_m)) return;
    best_m = cost_m;
    search.parent[at(index)] = static_cast<std::int32_t>(next);
  });
  search.cost_m[at(index)] = best_m;
  return best_m < std::numeric_limits<double>::infinity();
}

Path path_to(Search& search, std::int64_t index) {
  Path path{search.place(index)};
  for (std::int64_t i = index; i != search.start_index;) {
    i = search.parent[static_cast<std::size_t>(i)];
    path.push_back(search.place(i));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// Cells of the path from start to the first one settled in the goal region, or empty.
Path any_angle_search(Search& search) {
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  std::priority_queue<Open> open;
  search.cost_m[at(search.start_index)] = 0.0;
  search.parent[at(search.start_index)] = static_cast<std::int32_t>(search.start_index);
  search.is_sighted[at(search.start_index)] = true;
  open.push({heuristic_m(search, search.start), 0.0, search.start_index});
  while (!open.empty()) {
    const std::int64_t index = open.top().index;
    open.pop();
    // Settled by an earlier entry: entries stay in the queue when a better one is pushed.
    if (search.closed[at(index)]) continue;
    // Lazy: the line of sight is looked at only when the cell's turn has come.
    if (!search.is_sighted[at(index)]) {
      const double hoped_m = search.cost_m[at(index)];
      if (!settle_parent(search, index)) continue;
      search.is_sighted[at(index)] = true;
      const double cost_m = search.cost_m[at(index)];
      // The way around is longer than the straight one that was hoped for.
      if (cost_m > hoped_m) {  // others may come first now
        open.push({cost_m + heuristic_m(search, search.place(index)), cost_m, index});
        continue;
      }
    }
    search.closed[at(index)] = true;
    // Every cell of the region ends the search, not the goal's centre alone: the nearest entry
    // counts.
    if (search.goal.contains(search.place(index))) return path_to(search, index);
    // Theta*: neighbours hang on this cell's parent by a straight line, not on this cell.
    const std::int64_t parent = search.parent[at(index)];
    const Vector3d from = search.place(parent);
    for_each_neighbour(search, index, [&](std::int64_t next) {
      if (search.closed[at(next)]) return;
      const Vector3d there = search.place(next);
      const double cost_m = search.cost_m[at(parent)] + (there - from).norm();
      if (cost_m >= search.cost_m[at(next)] || !search.is_free(there)) return;
      search.cost_m[at(next)] = cost_m;
      search.parent[at(next)] = static_cast<std::int32_t>(parent);
      search.is_sighted[at(next)] = false;
      open.push({cost_m + heuristic_m(search, there), cost_m, next});
    });
  }
  return {};
}

}  // namespace

double path_length_m(const std::vector<Vector3d>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

std::optional<Path> reference_path(ClearanceGrid& grid, const Mission& mission,
                                   double goal_radius_m, double radius_m) {
  const Vector3d& start = mission.start_world;
  const GoalRegion goal{mission.goal_world, goal_radius_m};
  const Vector3d end = nearest_of(goal, start);
  // Most missions on open maps need no search.
  if (grid.is_segment_free(start, end, radius_m)) return Path{start, end};
  const auto count = static_cast<std::size_t>(grid.cell_count());
  Search search{.grid = grid,
                .radius_m = radius_m,
                .start = start,
                .goal = goal,
                .start_index = grid.index(grid.cell_of(start)),
                .goal_index = grid.index(grid.cell_of(mission.goal_world)),
                .cost_m = std::vector<double>(count, std::numeric_limits<double>::infinity()),
                .parent = std::vector<std::int32_t>(count, -1),
                .is_sighted = std::vector<bool>(count, false),
                .closed = std::vector<bool>(count, false),
                .beside_surface = {}};
  Path path = any_angle_search(search);
  if (path.empty()) return std::nullopt;
  pull_taut(grid, radius_m, goal, path);
  return path;
}

}  // namespace avoidbench
