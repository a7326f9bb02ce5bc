#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/fields.hpp"

/// Maps that are hard by construction, each in a closed hall with its start and goal bands at the
/// ends of y. Every one has a parameter that makes it harder; the doc of that field says so.
namespace avoidbench {

/// A labyrinth of walls from floor to ceiling (depth-first search), with one way in and one out.
struct MazeSpec {
  static constexpr std::string_view kind = "maze";
  static constexpr std::string_view doc = "A labyrinth in a hall.";
  std::array<double, 2> area_m{20.0, 30.0};
  double corridor_m = 2.5;
  double loop_ratio = 0.1;
  double height_m = 3.0;
  double flight_height_m = 1.5;
};

/// Walls across the whole hall, each with some openings: gaps from floor to ceiling, or gates.
struct GapWallsSpec {
  static constexpr std::string_view kind = "gap_walls";
  static constexpr std::string_view doc = "Walls across a hall with gaps or gates.";
  std::array<double, 2> area_m{20.0, 30.0};
  std::int64_t wall_count = 3;
  std::int64_t gaps_per_wall = 2;
  double gap_width_m = 1.4;
  double gap_height_m = 0.0;
  std::array<double, 2> sill_m{0.5, 2.0};
  double height_m = 4.0;
  double flight_height_m = 2.0;
};

/// U-shaped traps that are open toward the start: who flies in has to come back out.
struct DeadEndsSpec {
  static constexpr std::string_view kind = "dead_ends";
  static constexpr std::string_view doc = "U-shaped traps that open toward the start.";
  std::array<double, 2> area_m{20.0, 30.0};
  double trap_width_m = 4.0;
  double trap_depth_m = 3.0;
  double passage_m = 2.5;
  double yaw_deg = 25.0;
  double height_m = 4.0;
  double flight_height_m = 2.0;
};

/// Thin upright poles, and bare stems with slanting branches.
struct PolesSpec {
  static constexpr std::string_view kind = "poles";
  static constexpr std::string_view doc = "Thin poles and bare branches.";
  std::array<double, 2> area_m{20.0, 30.0};
  double poisson_radius_m = 1.8;
  std::array<double, 2> diameter_m{0.01, 0.03};
  double branch_ratio = 0.4;
  double height_m = 4.0;
  double flight_height_m = 2.0;
};

/// Barriers across the whole hall that leave a slot at the floor or at the ceiling, by
/// turns: pass under, then over. Chance says which is first.
struct OverhangsSpec {
  static constexpr std::string_view kind = "overhangs";
  static constexpr std::string_view doc = "Barriers to pass under or over.";
  std::array<double, 2> area_m{20.0, 30.0};
  std::int64_t barrier_count = 4;
  double slot_height_m = 1.2;
  double thickness_m = 0.5;
  double height_m = 4.0;
  double flight_height_m = 2.0;
};

namespace detail {

template <class Visitor, class Spec>
void visit_area(Visitor& v, Spec& s) {
  v.field("area_m", s.area_m, Range{10, 200}, "Size in x and y; flights cross it along y.");
}

template <class Visitor, class Spec>
void visit_heights(Visitor& v, Spec& s) {
  v.field("height_m", s.height_m, Range{2, 20}, "Height of the ceiling.");
  v.field("flight_height_m", s.flight_height_m, Range{0.3, 10}, "Height of starts and goals.");
}

}  // namespace detail

template <class Visitor, ConstOr<MazeSpec> Spec>
void visit(Visitor& v, Spec& s) {
  detail::visit_area(v, s);
  v.field("corridor_m", s.corridor_m, Range{0.8, 10},
          "Free width of the corridors; narrower is harder.");
  v.field("loop_ratio", s.loop_ratio, Range{0, 1},
          "Share of the inner walls that are opened in addition: 0 leaves only one way.");
  detail::visit_heights(v, s);
}

template <class Visitor, ConstOr<GapWallsSpec> Spec>
void visit(Visitor& v, Spec& s) {
  detail::visit_area(v, s);
  v.field("wall_count", s.wall_count, Range{1, 20}, "Walls across the hall.");
  v.field("gaps_per_wall", s.gaps_per_wall, Range{1, 20}, "Openings in each wall.");
  v.field("gap_width_m", s.gap_width_m, Range{0.5, 20},
          "Free width of an opening; narrower is harder.");
  v.field("gap_height_m", s.gap_height_m, Range{0, 20},
          "Free height of an opening, a gate; 0: from floor to ceiling.");
  v.field("sill_m", s.sill_m, Range{0, 20}, "Least and greatest height of a gate's lower edge.");
  detail::visit_heights(v, s);
}

template <class Visitor, ConstOr<DeadEndsSpec> Spec>
void visit(Visitor& v, Spec& s) {
  detail::visit_area(v, s);
  v.field("trap_width_m", s.trap_width_m, Range{1, 20}, "Free width of a trap.");
  v.field("trap_depth_m", s.trap_depth_m, Range{0.5, 20},
          "Length of a trap's sides; deeper is harder.");
  v.field("passage_m", s.passage_m, Range{0.8, 20}, "Least free width between two traps.");
  v.field("yaw_deg", s.yaw_deg, Range{0, 180}, "Greatest turn of a trap from facing the start.");
  detail::visit_heights(v, s);
}

template <class Visitor, ConstOr<PolesSpec> Spec>
void visit(Visitor& v, Spec& s) {
  detail::visit_area(v, s);
  v.field("poisson_radius_m", s.poisson_radius_m, Range{0.8, 20},
          "Least distance between two poles' feet (Bridson 2007); smaller is harder.");
  v.field("diameter_m", s.diameter_m, Range{0.002, 0.2},
          "Least and greatest diameter; thinner is harder to see.");
  v.field("branch_ratio", s.branch_ratio, Range{0, 1},
          "Fraction that are bare stems with 2 to 4 slanting branches, 0.5 to 1.8 m long.");
  detail::visit_heights(v, s);
}

template <class Visitor, ConstOr<OverhangsSpec> Spec>
void visit(Visitor& v, Spec& s) {
  detail::visit_area(v, s);
  v.field("barrier_count", s.barrier_count, Range{1, 20}, "Barriers across the hall.");
  v.field("slot_height_m", s.slot_height_m, Range{0.4, 10},
          "Free height under or over a barrier; lower is harder.");
  v.field("thickness_m", s.thickness_m, Range{0.05, 5}, "Depth of a barrier along y.");
  detail::visit_heights(v, s);
}

}  // namespace avoidbench
