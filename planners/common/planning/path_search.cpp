#include "planning/path_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace planning {
namespace {

using Eigen::Vector3d;

/// Costs of a step along one, two and three axes: 1, √2, √3 in 1/1000.
constexpr std::array<std::int32_t, 4> kStepCost{0, 1000, 1414, 1732};

struct Neighbour {
  Cell step;
  std::int32_t cost;
};

std::array<Neighbour, 26> make_neighbours() {
  std::array<Neighbour, 26> all;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int axes = std::abs(x) + std::abs(y) + std::abs(z);
        if (axes > 0) all[count++] = {{x, y, z}, kStepCost[static_cast<std::size_t>(axes)]};
      }
    }
  }
  return all;
}

std::int32_t octile(const Cell& a, const Cell& b) {
  std::array<std::int32_t, 3> d{std::abs(a.x() - b.x()), std::abs(a.y() - b.y()),
                                std::abs(a.z() - b.z())};
  std::sort(d.begin(), d.end());
  return kStepCost[3] * d[0] + kStepCost[2] * (d[1] - d[0]) + kStepCost[1] * (d[2] - d[1]);
}

}  // namespace

bool PathSearch::is_free(const RollingGrid& grid, const Cell& cell) const {
  const double height_m = grid.center_of(cell).z();
  return height_m >= spec_.lowest_m && height_m <= spec_.highest_m && !grid.is_inflated(cell);
}

/// The first free cell on the line from `from` away from `toward`, then toward it.
std::optional<Cell> PathSearch::freed(const RollingGrid& grid, const Cell& from,
                                      const Cell& toward) const {
  if (is_free(grid, from)) return from;
  const Vector3d line = (toward - from).cast<double>();
  const double length = line.norm();
  if (length < 1e-9) return std::nullopt;
  for (const double sign : {-1.0, 1.0}) {
    for (int i = 1; i <= spec_.half_size_cells / 2; ++i) {
      const Vector3d moved = from.cast<double>() + sign * i * line / length;
      const Cell cell(static_cast<int>(std::lround(moved.x())),
                      static_cast<int>(std::lround(moved.y())),
                      static_cast<int>(std::lround(moved.z())));
      if (is_free(grid, cell)) return cell;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Vector3d>> PathSearch::find(const RollingGrid& grid,
                                                      const Vector3d& start_world,
                                                      const Vector3d& goal_world) {
  static const std::array<Neighbour, 26> kNeighbours = make_neighbours();
  const auto start = freed(grid, grid.cell_of(start_world), grid.cell_of(goal_world));
  const auto goal = freed(grid, grid.cell_of(goal_world), grid.cell_of(start_world));
  if (!start || !goal) return std::nullopt;
  const Cell lowest = grid.cell_of(Vector3d(0.0, 0.0, spec_.lowest_m));
  const Cell highest = grid.cell_of(Vector3d(0.0, 0.0, spec_.highest_m));
  const int side = 2 * spec_.half_size_cells + 1;
  const Cell sides(side, side, highest.z() - lowest.z() + 1);
  Cell corner = (*start + *goal) / 2 - Cell::Constant(spec_.half_size_cells);
  corner.z() = lowest.z();
  const auto is_inside = [&](const Cell& cell) {
    return ((cell - corner).array() >= 0).all() && ((cell - corner).array() < sides.array()).all();
  };
  if (!is_inside(*start) || !is_inside(*goal)) return std::nullopt;
  const auto index_of = [&](const Cell& cell) {
    const Cell c = cell - corner;
    return static_cast<std::uint32_t>((c.x() * side + c.y()) * sides.z() + c.z());
  };
  const auto cell_at = [&](std::uint32_t index) {
    const int i = static_cast<int>(index);
    return Cell(corner + Cell(i / (side * sides.z()), i / sides.z() % side, i % sides.z()));
  };
  const auto is_later = [](const Open& a, const Open& b) {
    return a.total != b.total ? a.total > b.total : a.order < b.order;
  };
  const auto size = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
                    static_cast<std::size_t>(sides.z());
  if (nodes_.size() < size) nodes_.assign(size, {});
  ++search_;
  open_.clear();
  std::uint32_t order = 0;
  nodes_[index_of(*start)] = {search_, 0, 0, false};
  open_.push_back({octile(*start, *goal), order++, index_of(*start)});
  const int most = std::min(spec_.most_expansions, budget_);
  for (int expansions = 0; !open_.empty() && expansions < most; ++expansions) {
    --budget_;
    std::pop_heap(open_.begin(), open_.end(), is_later);
    const std::uint32_t at = open_.back().node;
    open_.pop_back();
    if (nodes_[at].is_closed) continue;
    nodes_[at].is_closed = true;
    const Cell cell = cell_at(at);
    if (cell == *goal) {
      std::vector<Vector3d> path;
      Cell back = cell;
      for (; back != *start; back -= kNeighbours[nodes_[index_of(back)].from].step) {
        path.push_back(grid.center_of(back));
      }
      path.push_back(grid.center_of(*start));
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (std::size_t k = 0; k < kNeighbours.size(); ++k) {
      const Cell next = cell + kNeighbours[k].step;
      if (!is_inside(next)) continue;
      Node& node = nodes_[index_of(next)];
      const std::int32_t cost = nodes_[at].cost + kNeighbours[k].cost;
      if (node.search == search_ && (node.is_closed || node.cost <= cost)) continue;
      if (!is_free(grid, next)) continue;
      node = {search_, cost, static_cast<std::uint8_t>(k), false};
      open_.push_back({cost + octile(next, *goal), order++, index_of(next)});
      std::push_heap(open_.begin(), open_.end(), is_later);
    }
  }
  return std::nullopt;
}

double path_length_m(const std::vector<Vector3d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace planning
