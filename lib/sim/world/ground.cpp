#include "world/ground.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "world/noise.hpp"

namespace avoidbench {
namespace {

constexpr double kCell_m = 1.0;
// Two or three hills across a forest of 40 m; no multiple of the cell, whose lattice would show.
constexpr double kWavelength_m = 17.0;
constexpr int kOctaves = 4;

}  // namespace

HeightField make_ground(double width_m, double depth_m, double margin_m, double relief_m,
                        std::uint64_t seed) {
  HeightField ground;
  ground.low_x_m = -margin_m;
  ground.low_y_m = -margin_m;
  ground.cell_m = kCell_m;
  ground.columns = static_cast<std::uint32_t>(std::ceil((width_m + 2.0 * margin_m) / kCell_m)) + 1U;
  ground.rows = static_cast<std::uint32_t>(std::ceil((depth_m + 2.0 * margin_m) / kCell_m)) + 1U;

  std::vector<double> raw;
  raw.reserve(std::size_t{ground.columns} * ground.rows);
  for (std::uint32_t row = 0; row < ground.rows; ++row) {
    for (std::uint32_t column = 0; column < ground.columns; ++column) {
      const Eigen::Vector3d point(ground.low_x_m + column * kCell_m, ground.low_y_m + row * kCell_m,
                                  // Off the planes of the noise's lattice, on which it is 0 at each
                                  // lattice point.
                                  0.37 * kWavelength_m);
      raw.push_back(fractal_noise(point / kWavelength_m, kOctaves, seed));
    }
  }
  const auto [lowest, highest] = std::minmax_element(raw.begin(), raw.end());
  const double low = *lowest;
  // Scaled to the relief exactly, so that the flight ceiling above it is known.
  const double span = *highest - low;
  AB_CHECK(span > 0.0);
  ground.heights_m.reserve(raw.size());
  for (const double height : raw) {
    ground.heights_m.push_back(static_cast<float>(relief_m * ((height - low) / span)));
  }
  return ground;
}

Prototype ground_prototype(const HeightField& ground) {
  Prototype prototype;
  prototype.name = "ground";
  for (std::uint32_t row = 0; row < ground.rows; ++row) {
    for (std::uint32_t column = 0; column < ground.columns; ++column) {
      prototype.mesh.vertices.emplace_back(
          static_cast<float>(ground.low_x_m + column * ground.cell_m),
          static_cast<float>(ground.low_y_m + row * ground.cell_m),
          ground.heights_m[std::size_t{row} * ground.columns + column]);
    }
  }
  // Each cell is two triangles that meet in the diagonal from its low to its high corner;
  // ground_height_m() has the same.
  for (std::uint32_t row = 0; row + 1 < ground.rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < ground.columns; ++column) {
      const std::uint32_t low = row * ground.columns + column;
      const std::uint32_t high = low + ground.columns + 1;
      prototype.mesh.triangles.push_back({low, low + 1, high});
      prototype.mesh.triangles.push_back({low, high, high - 1});
    }
  }
  prototype.triangle_materials.assign(prototype.mesh.triangles.size(), Material::soil);
  return prototype;
}

double ground_height_m(const HeightField& ground, double x_m, double y_m) {
  if (ground.heights_m.empty()) return 0.0;
  // In cells; beyond the field the ground goes on as at its edge.
  const double x = std::clamp((x_m - ground.low_x_m) / ground.cell_m, 0.0,
                              static_cast<double>(ground.columns - 1));
  const double y =
      std::clamp((y_m - ground.low_y_m) / ground.cell_m, 0.0, static_cast<double>(ground.rows - 1));
  // A point on the last line of corners belongs to the cell before it.
  const std::uint32_t column = std::min(static_cast<std::uint32_t>(x), ground.columns - 2);
  const std::uint32_t row = std::min(static_cast<std::uint32_t>(y), ground.rows - 2);
  const auto height = [&](std::uint32_t c, std::uint32_t r) {
    return static_cast<double>(ground.heights_m[std::size_t{r} * ground.columns + c]);
  };
  const double u = x - column;
  const double v = y - row;
  const double low = height(column, row);
  const double high = height(column + 1, row + 1);
  // The triangle below the diagonal, or the one above: the plane through its three corners.
  if (u >= v) {
    const double corner = height(column + 1, row);
    return low + u * (corner - low) + v * (high - corner);
  }
  const double corner = height(column, row + 1);
  return low + v * (corner - low) + u * (high - corner);
}

double ground_height_m(const World& world, double x_m, double y_m) {
  return ground_height_m(world.ground, x_m, y_m);
}

}  // namespace avoidbench
