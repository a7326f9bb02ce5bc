#pragma once

#include "movers/mover_spec.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// How large a mover is and where its middle is above its origin; boxes and balls have their origin
/// in the middle, the others at their foot.
struct MoverShape {
  MoverKind kind = MoverKind::person;
  double scale = 1.0;                    ///< of the kind's prototype
  double width_m = 0.0, height_m = 0.0;  ///< greatest horizontal width, and height
  bool is_grounded = true;
};

/// `size_m` counts for boxes and balls.
MoverShape mover_shape(MoverKind kind, double size_m);

/// Boxes and balls are one metre wide.
Prototype mover_prototype(MoverKind kind);

}  // namespace avoidbench
