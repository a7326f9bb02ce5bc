#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "planning/rolling_grid.hpp"

namespace planning {

struct PathSearchSpec {
  int half_size_cells = 50;  ///< of the searched box along x and y, around start and goal's middle
  double lowest_m = 0.3, highest_m = 5.0;  ///< heights that may be used
  int most_expansions = 200000;
};

/// A* over the cells of a grid that are not inflated (Hart, Nilsson and Raphael 1968), 26
/// neighbours, octile distance. Unknown cells are free. Keeps its memory between searches; equal
/// inputs give equal paths.
class PathSearch {
 public:
  explicit PathSearch(const PathSearchSpec& spec) : spec_(spec) {}

  /// From now on only these heights may be used.
  void use_heights(double lowest_m, double highest_m) {
    spec_.lowest_m = lowest_m;
    spec_.highest_m = highest_m;
  }

  /// Until told again, all searches together expand no more cells than these; where they would,
  /// they find nothing.
  void use_budget(int expansions) { budget_ = expansions; }

  /// Cell centres from the start's to the goal's, both included. Ends inside obstacles are moved
  /// along the line between them to the nearest free cell. Nothing where there is no way within the
  /// box.
  std::optional<std::vector<Eigen::Vector3d>> find(const RollingGrid& grid,
                                                   const Eigen::Vector3d& start_world,
                                                   const Eigen::Vector3d& goal_world);

 private:
  struct Node {
    std::uint32_t search = 0;  ///< in which it was seen
    std::int32_t cost = 0;     ///< from the start
    std::uint8_t from = 0;     ///< neighbour it was reached from
    bool is_closed = false;
  };
  struct Open {
    std::int32_t total;
    std::uint32_t order;  ///< of equal totals the last found comes first
    std::uint32_t node;
  };

  bool is_free(const RollingGrid& grid, const Cell& cell) const;
  std::optional<Cell> freed(const RollingGrid& grid, const Cell& from, const Cell& toward) const;

  PathSearchSpec spec_;
  int budget_ = std::numeric_limits<int>::max();
  std::vector<Node> nodes_;
  std::vector<Open> open_;
  std::uint32_t search_ = 0;
};

/// The path's length, metres.
double path_length_m(const std::vector<Eigen::Vector3d>& path);

}  // namespace planning
