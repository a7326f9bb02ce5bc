#pragma once

#include <cstdint>

#include "world/world.hpp"

namespace avoidbench {

/// Undulating ground over [0, width] × [0, depth] and `margin_m` around it, cells of 1 m; its
/// lowest point is at z = 0, its highest at `relief_m`.
HeightField make_ground(double width_m, double depth_m, double margin_m, double relief_m,
                        std::uint64_t seed);

/// The mesh of soil whose surface ground_height_m() gives, in world coordinates.
Prototype ground_prototype(const HeightField& ground);

}  // namespace avoidbench
