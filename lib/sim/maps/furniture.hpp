#pragma once

#include "world/scenery.hpp"

namespace avoidbench {

enum class FurnitureKind { crates, shelf, pillar };

struct Furniture {
  FurnitureKind kind = FurnitureKind::crates;
  Eigen::Vector2d foot_world = Eigen::Vector2d::Zero();
  double size_m = 0.5;  ///< side of crates and pillars, half the length of a shelf
};

/// Greatest side of its foot.
double furniture_width_m(FurnitureKind kind, double size_m);

/// A stack of crates, an open shelf (both 1.6 to 3.2 m high) or a pillar up to the ceiling, turned
/// by chance.
void add_furniture(const Furniture& piece, double ceiling_m, std::uint64_t seed, World& world);

/// Lamps under the ceiling, one in about 5 m × 5 m.
void add_lamps(const Aabb& hall, World& world);

}  // namespace avoidbench
