#include "clearance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace agile {
namespace {

using avoidbench::ClearanceGrid;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// Cells that are reached from the free places, from one to the next of the six around it.
std::vector<bool> reached_cells(const ClearanceGrid& grid, const std::vector<double>& clearance_m,
                                const std::vector<Vector3d>& free_places_world) {
  // A surface between two centres is nearer than half a cell to one of them: no way leads through.
  const double least_m = 0.51 * grid.cell_m();
  std::vector<bool> is_reached(clearance_m.size(), false);
  std::vector<std::int64_t> open;
  const auto reach = [&](const Vector3i& cell) {
    const std::int64_t index = grid.index(cell);
    const auto at = static_cast<std::size_t>(index);
    if (is_reached[at] || clearance_m[at] < least_m) return;
    is_reached[at] = true;
    open.push_back(index);
  };
  for (const Vector3d& place : free_places_world) reach(grid.cell_of(place));
  while (!open.empty()) {
    const Vector3i cell = grid.cell(open.back());
    open.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Vector3i next = cell;
        next[axis] += step;
        if (next[axis] >= 0 && next[axis] < grid.size()[axis]) reach(next);
      }
    }
  }
  return is_reached;
}

}  // namespace

double ClearanceField::at(const Vector3d& place_world) const {
  Vector3i low;
  Vector3d part;
  for (int axis = 0; axis < 3; ++axis) {
    const double most = size[axis] - 1.0;
    const double x = std::clamp((place_world[axis] - origin_world[axis]) / cell_m, 0.0, most);
    low[axis] = std::min(static_cast<int>(x), size[axis] - 2);
    part[axis] = x - low[axis];
  }
  const auto row = static_cast<std::size_t>(size.x());
  const std::size_t layer = row * static_cast<std::size_t>(size.y());
  const std::size_t corner = static_cast<std::size_t>(low.z()) * layer +
                             static_cast<std::size_t>(low.y()) * row +
                             static_cast<std::size_t>(low.x());
  const auto along_x = [&](std::size_t at) {
    return steps[at] + part.x() * (steps[at + 1] - steps[at]);
  };
  const auto along_y = [&](std::size_t at) {
    const double near = along_x(at);
    return near + part.y() * (along_x(at + row) - near);
  };
  const double low_z = along_y(corner);
  return 0.01 * (low_z + part.z() * (along_y(corner + layer) - low_z)) - 0.5;
}

ClearanceField make_clearance_field(ClearanceGrid& grid,
                                    const std::vector<Vector3d>& free_places_world) {
  ClearanceField field;
  field.origin_world = grid.centre(Vector3i::Zero());
  field.cell_m = grid.cell_m();
  field.size = grid.size();
  std::vector<double> clearance_m(static_cast<std::size_t>(grid.cell_count()));
  for (std::size_t i = 0; i < clearance_m.size(); ++i) {
    clearance_m[i] = grid.clearance_m(grid.cell(static_cast<std::int64_t>(i)));
  }
  const std::vector<bool> is_reached = reached_cells(grid, clearance_m, free_places_world);
  field.steps.resize(clearance_m.size());
  for (std::size_t i = 0; i < clearance_m.size(); ++i) {
    const double least_m = 0.51 * grid.cell_m();
    const bool is_inside = !is_reached[i] && clearance_m[i] >= least_m;
    const double signed_m = is_inside ? -clearance_m[i] : clearance_m[i];
    field.steps[i] =
        static_cast<std::uint8_t>(std::lround(std::clamp((signed_m + 0.5) / 0.01, 0.0, 255.0)));
  }
  return field;
}

}  // namespace agile
