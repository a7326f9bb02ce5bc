#include "metrics/reference_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "metrics/column_distances.hpp"
#include "metrics/taut_path.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Path = std::vector<Vector3d>;

/// Where the ball stands in a cell.
enum class Stand : std::uint8_t { unknown, nowhere, at_centre, beside_surface };

/// What is known of a cell: together, since the search goes through memory more than it computes.
struct Cell {
  double cost_m = std::numeric_limits<double>::infinity();  ///< +inf: not reached
  std::int32_t parent = -1;  ///< of reached cells; 32 bits hold the grid's 8 million
  Stand stand = Stand::unknown;
  bool is_sighted = false;  ///< whether the way from the parent is known to be free
  bool is_closed = false;
};

/// The start is a cell of its own, moved to the true start point, and the goal likewise.
struct Search {
  ClearanceGrid& grid;
  double radius_m;
  Vector3d start;
  GoalRegion goal;
  std::int64_t start_index, goal_index;
  std::vector<Cell> cells;
  std::map<std::int64_t, Vector3d> beside_surface;  ///< places of such cells
  int closed_count = 0;
  std::optional<ColumnDistances> distances = {};

  Cell& at(std::int64_t index) { return cells[static_cast<std::size_t>(index)]; }
  bool is_free(const Vector3d& point) {
    return grid.region().contains(point) && grid.is_free(point, radius_m);
  }
};

/// At the cell's centre, or, where a surface is about the ball's radius from there, touching it. So
/// paths can lie against surfaces, and their lengths are true enough to choose by which side of an
/// obstacle to pass.
Stand found_stand(Search& search, std::int64_t index) {
  const auto if_free = [&](const Vector3d& place) {
    return search.is_free(place) ? Stand::at_centre : Stand::nowhere;
  };
  if (index == search.start_index) return if_free(search.start);
  if (index == search.goal_index) return if_free(search.goal.center_world);
  const Vector3i cell = search.grid.cell(index);
  const Vector3d centre = search.grid.centre(cell);
  const double lacking_m = search.radius_m - search.grid.clearance_m(cell);
  // A push of more than half a cell would end in the next cell, which has a place of its own.
  if (lacking_m > 0.0 && lacking_m <= 0.5 * search.grid.cell_m()) {
    // More than the rounding of float vertices, so that the ball is free where it touches.
    constexpr double kSpare_m = 1e-5;
    const Vector3d away = centre - search.grid.nearest_surface(centre);
    const Vector3d touching =
        centre + away.normalized() * (search.radius_m + kSpare_m - away.norm());
    if (search.is_free(touching)) {
      search.beside_surface.emplace(index, touching);
      return Stand::beside_surface;
    }
  }
  return if_free(centre);
}

bool has_place(Search& search, std::int64_t index) {
  Stand& stand = search.at(index).stand;
  if (stand == Stand::unknown) stand = found_stand(search, index);
  return stand != Stand::nowhere;
}

/// Of a cell that has one, or of start and goal.
Vector3d place_of(const Search& search, std::int64_t index) {
  if (index == search.start_index) return search.start;
  if (index == search.goal_index) return search.goal.center_world;
  if (search.cells[static_cast<std::size_t>(index)].stand == Stand::beside_surface) {
    return search.beside_surface.at(index);
  }
  return search.grid.centre(search.grid.cell(index));
}

/// A bound of the way that is left, a little raised: of many ways that differ by less than a
/// hundredth the search follows one, and takes a fifth of the time in a forest. Straight at first:
/// only a search that goes on for long is worth the look around what stands in the way.
double hoped_m(Search& search, const Vector3d& place) {
  constexpr double kRaised = 1.01;
  constexpr int kLong = 1000;  // cells
  if (search.closed_count < kLong) {
    const double straight_m = (search.goal.center_world - place).head<2>().norm();
    return kRaised * std::max(0.0, straight_m - search.goal.radius_m);
  }
  if (!search.distances) search.distances.emplace(search.grid, search.goal, search.radius_m);
  return kRaised * search.distances->at_least_m(place);
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
  Cell& cell = search.at(index);
  const Vector3d here = place_of(search, index);
  if (search.grid.is_segment_free(place_of(search, cell.parent), here, search.radius_m)) {
    return true;
  }
  struct Way {
    double cost_m;
    std::int64_t from;
  };
  std::array<Way, 26> ways;
  auto end = ways.begin();
  for_each_neighbour(search, index, [&](std::int64_t next) {
    const Cell& other = search.at(next);
    if (other.is_closed) {
      *end++ = {other.cost_m + (here - place_of(search, next)).norm(), next};
    }
  });
  // The shortest first: then the first free one is the best. Of equal ones the lowest cell.
  std::sort(ways.begin(), end, [](const Way& a, const Way& b) {
    return std::tie(a.cost_m, a.from) < std::tie(b.cost_m, b.from);
  });
  const auto best = std::find_if(ways.begin(), end, [&](const Way& way) {
    return search.grid.is_segment_free(place_of(search, way.from), here, search.radius_m);
  });
  cell.cost_m = best == end ? std::numeric_limits<double>::infinity() : best->cost_m;
  if (best != end) cell.parent = static_cast<std::int32_t>(best->from);
  return best != end;
}

Path path_to(const Search& search, std::int64_t index) {
  Path path{place_of(search, index)};
  for (std::int64_t i = index; i != search.start_index;) {
    i = search.cells[static_cast<std::size_t>(i)].parent;
    path.push_back(place_of(search, i));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// Cells of the path from start to the first one settled in the goal region, or empty.
Path any_angle_search(Search& search) {
  std::priority_queue<Open> open;
  Cell& first = search.at(search.start_index);
  first.cost_m = 0.0;
  first.parent = static_cast<std::int32_t>(search.start_index);
  first.is_sighted = true;
  open.push({hoped_m(search, search.start), 0.0, search.start_index});
  while (!open.empty()) {
    const std::int64_t index = open.top().index;
    open.pop();
    Cell& cell = search.at(index);
    // Settled by an earlier entry: entries stay in the queue when a better one is pushed.
    if (cell.is_closed) continue;
    // Lazy: the line of sight is looked at only when the cell's turn has come.
    if (!cell.is_sighted) {
      const double straight_m = cell.cost_m;
      if (!settle_parent(search, index)) continue;
      cell.is_sighted = true;
      // The way around is longer than the straight one that was hoped for: others may come first
      // now.
      if (cell.cost_m > straight_m) {
        open.push({cell.cost_m + hoped_m(search, place_of(search, index)), cell.cost_m, index});
        continue;
      }
    }
    cell.is_closed = true;
    ++search.closed_count;
    // Every cell of the region ends the search, not the goal's centre alone: the nearest entry
    // counts.
    if (search.goal.contains(place_of(search, index))) return path_to(search, index);
    // Theta*: neighbours hang on this cell's parent by a straight line, not on this cell.
    const double parent_cost_m = search.at(cell.parent).cost_m;
    const Vector3d from = place_of(search, cell.parent);
    for_each_neighbour(search, index, [&](std::int64_t next) {
      Cell& other = search.at(next);
      if (other.is_closed || !has_place(search, next)) return;
      const Vector3d there = place_of(search, next);
      const double cost_m = parent_cost_m + (there - from).norm();
      if (cost_m >= other.cost_m) return;
      other.cost_m = cost_m;
      other.parent = cell.parent;
      other.is_sighted = false;
      open.push({cost_m + hoped_m(search, there), cost_m, next});
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

std::optional<Path> leg_path(ClearanceGrid& grid, const Vector3d& start, const Vector3d& goal_world,
                             double goal_radius_m, double radius_m) {
  const GoalRegion goal{goal_world, goal_radius_m};
  const Vector3d end = nearest_of(goal, start);
  // Most missions on open maps need no search.
  if (grid.is_segment_free(start, end, radius_m)) return Path{start, end};
  const auto count = static_cast<std::size_t>(grid.cell_count());
  Search search{.grid = grid,
                .radius_m = radius_m,
                .start = start,
                .goal = goal,
                .start_index = grid.index(grid.cell_of(start)),
                .goal_index = grid.index(grid.cell_of(goal_world)),
                .cells = std::vector<Cell>(count),
                .beside_surface = {}};
  Path path = any_angle_search(search);
  if (path.empty()) return std::nullopt;
  pull_taut(grid, radius_m, goal, path);
  return path;
}

std::vector<Path> reference_legs(ClearanceGrid& grid, const Mission& mission, double goal_radius_m,
                                 double radius_m, std::optional<double> between_radius_m) {
  const std::vector<Vector3d> goals = goals_of(mission);
  std::vector<Path> legs;
  for (const Vector3d& goal : goals) {
    const bool is_last = legs.size() + 1 == goals.size();
    const double reach_m = is_last ? goal_radius_m : between_radius_m.value_or(goal_radius_m);
    auto leg = leg_path(grid, legs.empty() ? mission.start_world : legs.back().back(), goal,
                        reach_m, radius_m);
    if (!leg) break;
    legs.push_back(std::move(*leg));
  }
  return legs;
}

Path joined(const std::vector<Path>& legs) {
  Path path;
  for (const Path& leg : legs) {
    path.insert(path.end(), leg.begin() + (path.empty() ? 0 : 1), leg.end());
  }
  return path;
}

std::optional<Path> reference_path(ClearanceGrid& grid, const Mission& mission,
                                   double goal_radius_m, double radius_m,
                                   std::optional<double> between_radius_m) {
  const std::vector<Path> legs =
      reference_legs(grid, mission, goal_radius_m, radius_m, between_radius_m);
  if (legs.size() < goals_of(mission).size()) return std::nullopt;
  return joined(legs);
}

}  // namespace avoidbench
