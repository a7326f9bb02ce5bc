#include "surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ego {

using Eigen::Vector3d;
using planning::Cell;
using planning::CellState;

bool Surroundings::is_blocked(const Vector3d& position_world) const {
  return position_world.z() < lowest_m || position_world.z() > highest_m ||
         grid.is_inflated(position_world);
}

bool Surroundings::is_touching(const Vector3d& position_world) const {
  return grid.box_state(position_world, body_size_m) == CellState::occupied;
}

std::optional<double> first_blocked_s(const Surroundings& surroundings,
                                      const std::function<Vector3d(double)>& position_at,
                                      double from_s, double to_s, double step_s) {
  if (!(to_s >= from_s)) return std::nullopt;
  Vector3d last = position_at(from_s);
  bool is_leaving = surroundings.is_blocked(last);
  double way_m = 0.0;
  const int steps = static_cast<int>(std::ceil((to_s - from_s) / step_s));
  for (int i = 0; i <= steps; ++i) {
    const double time_s = std::min(from_s + i * step_s, to_s);
    const Vector3d place = position_at(time_s);
    way_m += (place - last).norm();
    last = place;
    if (!surroundings.is_blocked(place)) {
      is_leaving = false;
    } else if (!is_leaving || way_m > kLeaving_m || (i > 0 && surroundings.is_touching(place))) {
      return time_s;
    }
  }
  if (is_leaving && way_m > 0.1) return to_s;  // it never leaves
  return std::nullopt;
}

std::optional<Vector3d> nearest_free(const Surroundings& surroundings,
                                     const Vector3d& position_world, double within_m, Reach reach) {
  const double cell_m = surroundings.grid.spec().resolution_m;
  const int cells = static_cast<int>(std::ceil(within_m / cell_m));
  const Cell middle = surroundings.grid.cell_of(position_world);
  const auto is_reached = [&](const Vector3d& place) {
    const int steps = static_cast<int>(std::ceil((place - position_world).norm() / cell_m));
    for (int i = 1; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      if (surroundings.is_touching(position_world + part * (place - position_world))) return false;
    }
    return true;
  };
  std::optional<Vector3d> nearest;
  double least_m = within_m;
  for (int x = -cells; x <= cells; ++x) {
    for (int y = -cells; y <= cells; ++y) {
      for (int z = -cells; z <= cells; ++z) {
        const Vector3d place = surroundings.grid.center_of(middle + Cell(x, y, z));
        const double distance_m = (place - position_world).norm();
        if (distance_m >= least_m || surroundings.is_blocked(place)) continue;
        if (reach == Reach::straight && !is_reached(place)) continue;
        least_m = distance_m;
        nearest = place;
      }
    }
  }
  return nearest;
}

}  // namespace ego
