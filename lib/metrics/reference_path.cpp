#include "metrics/reference_path.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Path = std::vector<Vector3d>;

/// Search state, by cell. The start is a cell of its own, moved to the true start point.
struct Search {
  ClearanceGrid& grid;
  double radius_m;
  Vector3d start, goal;
  std::int64_t start_index, goal_index;
  std::vector<double> cost_m;        ///< +inf: not reached
  std::vector<std::int32_t> parent;  ///< of reached cells
  std::vector<bool> closed;

  Vector3d place(std::int64_t index) const {
    if (index == start_index) return start;
    if (index == goal_index) return goal;
    return grid.centre(grid.cell(index));
  }
  double heuristic_m(std::int64_t index) const { return (goal - place(index)).norm(); }
};

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

/// Cells of the path from start to goal, or empty.
Path any_angle_search(Search& search) {
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  std::priority_queue<Open> open;
  search.cost_m[at(search.start_index)] = 0.0;
  search.parent[at(search.start_index)] = static_cast<std::int32_t>(search.start_index);
  open.push({search.heuristic_m(search.start_index), 0.0, search.start_index});
  while (!open.empty()) {
    const std::int64_t index = open.top().index;
    open.pop();
    if (search.closed[at(index)]) continue;
    if (index != search.start_index && !settle_parent(search, index)) {
      search.cost_m[at(index)] = std::numeric_limits<double>::infinity();
      continue;
    }
    search.closed[at(index)] = true;
    if (index == search.goal_index) break;
    const std::int64_t parent = search.parent[at(index)];
    const Vector3d from = search.place(parent);
    for_each_neighbour(search, index, [&](std::int64_t next) {
      if (search.closed[at(next)]) return;
      const Vector3d there = search.place(next);
      const double cost_m = search.cost_m[at(parent)] + (there - from).norm();
      if (cost_m >= search.cost_m[at(next)] || !search.grid.is_free(there, search.radius_m)) return;
      search.cost_m[at(next)] = cost_m;
      search.parent[at(next)] = static_cast<std::int32_t>(parent);
      open.push({cost_m + search.heuristic_m(next), cost_m, next});
    });
  }
  if (!search.closed[at(search.goal_index)]) return {};
  Path path{search.goal};
  for (std::int64_t i = search.goal_index; i != search.start_index; i = search.parent[at(i)]) {
    path.push_back(search.place(search.parent[at(i)]));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// The point of the goal region nearest to `from`: horizontally within the radius, at any height.
Vector3d goal_region_point(const Vector3d& from, const Vector3d& goal, double goal_radius_m) {
  const Vector3d out(from.x() - goal.x(), from.y() - goal.y(), 0.0);
  const double distance_m = out.norm();
  const double kept = distance_m > goal_radius_m ? goal_radius_m / distance_m : 1.0;
  return {goal.x() + kept * out.x(), goal.y() + kept * out.y(), from.z()};
}

/// Moves `vertex` toward the line between its neighbours as far as both segments stay free.
Vector3d pulled(ClearanceGrid& grid, double radius_m, const Vector3d& before,
                const Vector3d& vertex, const Vector3d& after) {
  const Vector3d line = after - before;
  const double length = line.squaredNorm();
  const double along =
      length > 0.0 ? std::clamp((vertex - before).dot(line) / length, 0.0, 1.0) : 0.0;
  const Vector3d target = before + along * line;
  const auto is_free = [&](const Vector3d& place) {
    return grid.is_segment_free(before, place, radius_m) &&
           grid.is_segment_free(place, after, radius_m);
  };
  double kept = 0.0, refused = 1.0;
  for (int i = 0; i < 7; ++i) {
    const double tried = 0.5 * (kept + refused);
    (is_free(vertex + tried * (target - vertex)) ? kept : refused) = tried;
  }
  return vertex + kept * (target - vertex);
}

/// Drops each vertex whose neighbours see each other.
void drop_idle_vertices(ClearanceGrid& grid, double radius_m, Path& path) {
  for (std::size_t i = 1; i + 1 < path.size();) {
    if (grid.is_segment_free(path[i - 1], path[i + 1], radius_m)) {
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

/// Adds a vertex on both sides of each bend, so that the path can lie against a round surface.
Path with_bends_split(const Path& path) {
  constexpr double kReach_m = 0.6;
  Path split{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    for (const std::size_t other : {i - 1, i + 1}) {
      const Vector3d toward = path[other] - path[i];
      const double length = toward.norm();
      const Vector3d beside =
          path[i] + toward * (std::min(kReach_m, 0.4 * length) / std::max(length, 1e-9));
      if (other > i) split.push_back(path[i]);
      split.push_back(beside);
    }
  }
  split.push_back(path.back());
  return split;
}

/// Pulls the path taut: shorter with every round, until a round wins less than 0.01 %.
void pull_taut(ClearanceGrid& grid, double radius_m, const Vector3d& goal, double goal_radius_m,
               Path& path) {
  double length_m = path_length_m(path);
  for (int round = 0; round < 60; ++round) {
    drop_idle_vertices(grid, radius_m, path);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      path[i] = pulled(grid, radius_m, path[i - 1], path[i], path[i + 1]);
    }
    const Vector3d& last_but_one = path[path.size() - 2];
    Vector3d end = goal_region_point(last_but_one, goal, goal_radius_m);
    if (!grid.is_segment_free(last_but_one, end, radius_m)) {
      end = goal_region_point(Vector3d(last_but_one.x(), last_but_one.y(), goal.z()), goal,
                              goal_radius_m);
    }
    if (grid.is_segment_free(last_but_one, end, radius_m)) path.back() = end;
    const double now_m = path_length_m(path);
    if (round == 2 || round == 6 || round == 12) path = with_bends_split(path);
    if (round > 14 && length_m - now_m < 1e-4 * now_m) break;
    length_m = now_m;
  }
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
  const Vector3d& goal = mission.goal_world;
  const Vector3d end = goal_region_point(start, goal, goal_radius_m);
  if (grid.is_segment_free(start, end, radius_m)) return Path{start, end};
  Path path;
  if (grid.is_segment_free(start, goal, radius_m)) {
    path = {start, goal};
  } else {
    const auto count = static_cast<std::size_t>(grid.cell_count());
    Search search{.grid = grid,
                  .radius_m = radius_m,
                  .start = start,
                  .goal = goal,
                  .start_index = grid.index(grid.cell_of(start)),
                  .goal_index = grid.index(grid.cell_of(goal)),
                  .cost_m = std::vector<double>(count, std::numeric_limits<double>::infinity()),
                  .parent = std::vector<std::int32_t>(count, -1),
                  .closed = std::vector<bool>(count, false)};
    path = any_angle_search(search);
    if (path.empty()) return std::nullopt;
  }
  pull_taut(grid, radius_m, goal, goal_radius_m, path);
  return path;
}

}  // namespace avoidbench
