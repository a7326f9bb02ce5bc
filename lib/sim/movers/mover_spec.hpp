#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"

namespace avoidbench {

enum class MoverKind { person, box, ball, pole, mixed };

template <>
struct EnumText<MoverKind> {
  static constexpr std::pair<MoverKind, std::string_view> entries[] = {
      {MoverKind::person, "person"},
      {MoverKind::box, "box"},
      {MoverKind::ball, "ball"},
      {MoverKind::pole, "pole"},
      {MoverKind::mixed, "mixed"}};
};

enum class MoverMotion { stand, walk, cross, trefoil, chase, mixed };

template <>
struct EnumText<MoverMotion> {
  static constexpr std::pair<MoverMotion, std::string_view> entries[] = {
      {MoverMotion::stand, "stand"}, {MoverMotion::walk, "walk"},
      {MoverMotion::cross, "cross"}, {MoverMotion::trefoil, "trefoil"},
      {MoverMotion::chase, "chase"}, {MoverMotion::mixed, "mixed"}};
};

/// Things that move through a trial's map, whatever made it; see docs/movers.md. The default is
/// none.
struct MoversSpec {
  std::int64_t count = 0;
  double density_1pm2 = 0.0;
  MoverKind kind = MoverKind::person;
  MoverMotion motion = MoverMotion::walk;
  std::array<double, 2> speed_mps{0.5, 2.0};
  std::array<double, 2> size_m{0.4, 0.8};
  std::array<double, 2> height_m{1.0, 3.0};
  std::array<double, 2> trefoil_reach_m{1.0, 3.0};
  double pause_s = 2.0;
  double start_clearance_m = 3.0;
};

inline bool has_movers(const MoversSpec& movers) {
  return movers.count > 0 || movers.density_1pm2 > 0.0;
}

/// What contradicts itself, as "field: what is wrong".
std::vector<std::string> mover_problems(const MoversSpec& movers);

template <class Visitor, ConstOr<MoversSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("count", s.count, Range{0, 2000}, "How many there are.");
  v.field("density_1pm2", s.density_1pm2, Range{0, 2},
          "Instead of `count`: number per square metre of the flight box, rounded.");
  v.field("kind", s.kind,
          "person: 0.5 x 0.3 x 1.75 m, rounded, on the ground; box and ball: in the air; pole: 0.2 "
          "m thick, 4 m high, on the ground; mixed: each in turn.");
  v.field("motion", s.motion,
          "stand; walk: to places drawn one after the other, along free ways, with pauses; cross: "
          "back and forth across the line from start to goal, there when a vehicle at the speed "
          "limit would be; trefoil: along a knot in the air or on the ground; chase: from beside "
          "the start to the goal and back; mixed: walk, cross, trefoil and chase in turn.");
  v.field("speed_mps", s.speed_mps, Range{0.05, 30},
          "Speeds are drawn from this; of a trefoil it is the greatest.");
  v.field("size_m", s.size_m, Range{0.1, 5},
          "Edges of boxes and diameters of balls are drawn from this.");
  v.field("height_m", s.height_m, Range{0, 100},
          "Height of the middles of boxes and balls above the ground, except those that cross or "
          "chase: they keep to the line from start to goal.");
  v.field("trefoil_reach_m", s.trefoil_reach_m, Range{0.2, 50},
          "Reach of knots from their middles.");
  v.field("pause_s", s.pause_s, Range{0, 600}, "Longest pause at the places of a walk.");
  v.field("start_clearance_m", s.start_clearance_m, Range{0, 100},
          "Least horizontal distance from the vehicle's start at which one begins.");
}

}  // namespace avoidbench
