#include <array>

#include "base/math.hpp"
#include "base/random.hpp"
#include "maps/furniture.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

constexpr double kSink_m = 0.02;  // into the floor, so that no faces coincide

using Eigen::Vector3d;

/// Crates on top of each other, each a little off the one below.
Prototype crate_stack(double side_m, double height_m, RandomStream& draws) {
  Prototype stack;
  stack.name = "crates";
  // Crates of about their own width in height, at least one.
  const int count = std::max(1, static_cast<int>(std::lround(height_m / side_m)));
  const double crate_m = height_m / count;
  for (int i = 0; i < count; ++i) {
    const double half_m = 0.5 * side_m * draws.uniform(0.85, 1.0);
    // No crate stands out of the square that the placement kept free.
    const double room_m = 0.5 * side_m - half_m;
    const double x = draws.uniform(-room_m, room_m), y = draws.uniform(-room_m, room_m);
    // A millimetre into the one below: faces that coincide would flicker between the two.
    const double low = i == 0 ? -kSink_m : i * crate_m - 0.001;
    add_box(stack, {x - half_m, y - half_m, low}, {x + half_m, y + half_m, (i + 1) * crate_m},
            Material::painted_metal);
  }
  return stack;
}

/// An open rack of boards on four posts, with some crates on the boards.
Prototype shelf(double length_m, double height_m, RandomStream& draws) {
  // The body, 0.12 m high, fits between two empty boards.
  constexpr double kPost_m = 0.06, kBoard_m = 0.04, kStorey_m = 0.6;
  Prototype rack;
  rack.name = "shelf";
  const double x = 0.5 * length_m, y = 0.15 * length_m;
  for (const double px : {-x, x - kPost_m}) {
    for (const double py : {-y, y - kPost_m}) {
      add_box(rack, {px, py, -kSink_m}, {px + kPost_m, py + kPost_m, height_m},
              Material::painted_metal);
    }
  }
  for (double low = 0.1; low + kBoard_m < height_m; low += kStorey_m) {
    add_box(rack, {-x + 0.01, -y + 0.01, low}, {x - 0.01, y - 0.01, low + kBoard_m},
            Material::bark);
    const double crate_m = 0.5 * kStorey_m;
    if (draws.uniform() < 0.4 || low + kBoard_m + crate_m > height_m) continue;
    const double at = draws.uniform(-x + 0.1, x - 0.1 - crate_m);
    add_box(rack, {at, -0.7 * y, low + kBoard_m - 0.001},
            {at + crate_m, 0.7 * y, low + kBoard_m + crate_m}, Material::painted_metal);
  }
  return rack;
}

/// A square column from floor to ceiling.
Prototype pillar(double side_m, double height_m) {
  Prototype column;
  column.name = "pillar";
  const double half_m = 0.5 * side_m;
  add_box(column, {-half_m, -half_m, -kSink_m}, {half_m, half_m, height_m + kSink_m},
          Material::concrete);
  return column;
}

}  // namespace

double furniture_width_m(FurnitureKind kind, double size_m) {
  return kind == FurnitureKind::shelf ? 2.0 * size_m : size_m;
}

void add_furniture(const Furniture& piece, double ceiling_m, std::uint64_t seed, World& world) {
  // A stream for each piece: one more draw in a kind leaves the others as they are.
  RandomStream draws = stream(seed, "furniture");
  const double width_m = furniture_width_m(piece.kind, piece.size_m);
  const double height_m = std::min(0.95 * ceiling_m, draws.uniform(1.6, 3.2));
  Obstacle obstacle;
  obstacle.position_world = {piece.foot_world.x(), piece.foot_world.y(), 0.0};
  obstacle.width_m = width_m;
  const double yaw_rad = draws.uniform(0.0, 2.0 * math::kPi);
  switch (piece.kind) {
    case FurnitureKind::crates:
      obstacle.kind = "crates";
      return add_turned_obstacle(world, crate_stack(width_m, height_m, draws), obstacle, yaw_rad);
    case FurnitureKind::shelf:
      obstacle.kind = "shelf";
      return add_turned_obstacle(world, shelf(width_m, height_m, draws), obstacle, yaw_rad);
    case FurnitureKind::pillar:
      obstacle.kind = "pillar";
      return add_turned_obstacle(world, pillar(width_m, ceiling_m), obstacle, yaw_rad);
  }
}

void add_lamps(const Aabb& hall, World& world) {
  constexpr double kSpacing_m = 5.0;
  const Vector3d size = hall.sizes();
  const int columns = std::max(1, static_cast<int>(size.x() / kSpacing_m));
  const int rows = std::max(1, static_cast<int>(size.y() / kSpacing_m));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = hall.min().x() + (column + 0.5) * size.x() / columns;
      const double y = hall.min().y() + (row + 0.5) * size.y() / rows;
      // A centimetre into the ceiling, so that no faces coincide.
      add_slab(world, "lamp", "lamp", Material::lamp, {x - 0.15, y - 0.6, hall.max().z() - 0.06},
               {x + 0.15, y + 0.6, hall.max().z() + 0.01});
    }
  }
}

}  // namespace avoidbench
