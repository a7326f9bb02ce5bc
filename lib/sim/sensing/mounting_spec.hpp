#pragma once

#include <array>

#include "base/fields.hpp"
#include "base/math.hpp"

namespace avoidbench {

/// Where a sensor sits on the body and where it looks.
struct MountingSpec {
  std::array<double, 3> position_body_m{0.2, 0.0, 0.05};
  double yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
};

template <class Visitor, ConstOr<MountingSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("position_body_m", s.position_body_m, Range{-5, 5},
          "Centre of the lidar or (left) camera in the body frame (FLU).");
  v.field("yaw_deg", s.yaw_deg, Range{-180, 180}, "Direction, positive looks to the left.");
  v.field("pitch_deg", s.pitch_deg, Range{-90, 90}, "Tilt, positive looks down.");
  v.field("roll_deg", s.roll_deg, Range{-180, 180},
          "Turn about the direction, positive lowers the right side.");
}

}  // namespace avoidbench
