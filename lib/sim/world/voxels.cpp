#include "world/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "geometry/box_triangle.hpp"

namespace avoidbench {
namespace {

// Half a gigabyte: a cell is a byte.
constexpr double kMostCells = 5e8;
constexpr std::size_t kTrianglesPerPoll = 256;

/// The cells along one axis that [low, high] touches, [first, last).
struct CellRange {
  std::size_t first = 0, last = 0;
};

CellRange cells_between(double low, double high, double size_m, std::size_t count) {
  const double first = std::floor(low / size_m), last = std::floor(high / size_m) + 1.0;
  const auto most = static_cast<double>(count);
  return {static_cast<std::size_t>(std::clamp(first, 0.0, most)),
          static_cast<std::size_t>(std::clamp(last, 0.0, most))};
}

/// Marks the cells that the triangle, relative to the grid's lowest corner, touches.
void mark(const Triangle& triangle, VoxelGrid& grid) {
  const Eigen::Vector3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const Eigen::Vector3d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
  const double size_m = grid.size_m;
  const CellRange columns = cells_between(low.x(), high.x(), size_m, grid.columns);
  const CellRange rows = cells_between(low.y(), high.y(), size_m, grid.rows);
  const CellRange layers = cells_between(low.z(), high.z(), size_m, grid.layers);
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * size_m);
  for (std::size_t layer = layers.first; layer < layers.last; ++layer) {
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        std::uint8_t& cell = grid.is_occupied[grid.at(column, row, layer)];
        if (cell != 0) continue;
        const Eigen::Vector3d centre = grid.centre_world(column, row, layer) - grid.lowest_world;
        const Triangle moved{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
        if (overlaps(half, moved)) cell = 1;
      }
    }
  }
}

}  // namespace

VoxelGrid surface_voxels(const World& world, double size_m, const std::function<void()>& poll) {
  const Eigen::Vector3d sizes = world.bounds.sizes();
  // The last cells may reach beyond the bounds, so that all of these are covered.
  const Eigen::Vector3d counts = (sizes / size_m).array().ceil().max(1.0);
  if (counts.prod() > kMostCells) {
    throw InputError("a resolution of " + significant_digits(size_m, 6) +
                     " m makes more than 500 million cells of this map; choose a coarser one");
  }
  VoxelGrid grid{.lowest_world = world.bounds.min(),
                 .size_m = size_m,
                 .columns = static_cast<std::size_t>(counts.x()),
                 .rows = static_cast<std::size_t>(counts.y()),
                 .layers = static_cast<std::size_t>(counts.z()),
                 .is_occupied = {}};
  grid.is_occupied.assign(grid.columns * grid.rows * grid.layers, 0);
  std::size_t marked = 0;
  for (const Instance& instance : world.instances) {
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    const Eigen::Affine3d place = instance.T_world_prototype.cast<double>();
    for (const auto& corners : mesh.triangles) {
      if (poll && marked++ % kTrianglesPerPoll == 0) poll();
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = place * mesh.vertices[corners[i]].cast<double>() - grid.lowest_world;
      }
      mark(triangle, grid);
    }
  }
  return grid;
}

}  // namespace avoidbench
