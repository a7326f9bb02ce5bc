#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "base/fields.hpp"
#include "maps/file_maps.hpp"
#include "maps/hard_case_specs.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// An outdoor forest: trees with trunk and branches and bushes by Poisson-disc sampling on
/// undulating ground.
struct ForestSpec {
  static constexpr std::string_view kind = "forest";
  static constexpr std::string_view doc = "Trees and bushes on undulating ground.";
  std::array<double, 2> area_m{40.0, 40.0};
  double poisson_radius_m = 3.5;
  double bush_ratio = 0.4;
  double height_m = 6.0;
  double ground_relief_m = 0.4;
  double flight_height_m = 2.0;
};

/// An indoor hall with a floor, walls, lamps and upright cylinders by Poisson-disc sampling;
/// crates, shelves and pillars may take the places of some.
struct HallSpec {
  static constexpr std::string_view kind = "hall";
  static constexpr std::string_view doc =
      "A hall with upright cylinders, optionally also crates, shelves and pillars.";
  std::array<double, 2> area_m{20.0, 30.0};
  double poisson_radius_m = 3.5;
  std::array<double, 2> cylinder_diameter_m{0.5, 1.0};
  std::array<double, 2> cylinder_height_m{20.0, 20.0};
  double crates_ratio = 0.0;
  double shelf_ratio = 0.0;
  double pillar_ratio = 0.0;
  double moving_ratio = 0.0;
  std::array<double, 2> moving_speed_mps{0.5, 1.5};
  double height_m = 5.0;
  double texture_opacity = 1.0;
  double flight_height_m = 2.0;
};

/// The outdoor suite of the original AvoidBench (Yu, de Croon, De Wagter, arXiv 2301.07430) with
/// its obstacles' positions, trees and bushes as in ForestSpec: a map's seed is its number in the
/// suite, from 1 on. The flight space is a part of the field; its low corner is the world's origin.
/// Plants stand up to 20 m around it.
struct AvoidbenchForestSpec {
  static constexpr std::string_view kind = "avoidbench_forest";
  static constexpr std::string_view doc =
      "The outdoor maps of the original AvoidBench; the seed is the map's number.";
  std::int64_t suite_seed = 24;
  std::array<double, 2> field_area_m{140.0, 160.0};
  double radius_origin_m = 2.1;
  double radius_span_m = 3.2;
  std::array<double, 3> range_m{40.0, 40.0, 6.0};
  std::array<double, 2> range_origin_m{50.0, 60.0};
  double band_width_m = 40.0;
  std::array<double, 2> start_band_m{0.0, 6.0};
  std::array<double, 2> goal_band_m{28.0, 34.0};
  double start_height_m = 2.0;
  std::array<double, 2> goal_height_m{2.0, 3.0};
  double bush_ratio = 0.4;
  double ground_relief_m = 0.4;
};

/// The indoor suite of the original AvoidBench with the positions and sizes of its cylinders, in a
/// hall as of HallSpec that ends 2 m before and behind them.
struct AvoidbenchIndoorSpec {
  static constexpr std::string_view kind = "avoidbench_indoor";
  static constexpr std::string_view doc =
      "The indoor maps of the original AvoidBench; the seed is the map's number.";
  std::int64_t suite_seed = 35;
  std::array<double, 2> field_area_m{20.0, 30.0};
  double radius_origin_m = 2.5;
  double radius_span_m = 3.0;
  std::array<double, 3> range_m{20.0, 30.0, 4.0};
  std::array<double, 2> range_origin_m{0.0, -0.8};
  double band_width_m = 16.0;
  std::array<double, 2> start_band_m{0.0, 1.6};
  std::array<double, 2> goal_band_m{26.4, 28.0};
  double start_height_m = 2.0;
  std::array<double, 2> goal_height_m{2.0, 3.0};
  std::array<double, 2> cylinder_diameter_m{0.5, 1.0};
  std::array<double, 2> cylinder_height_m{5.2, 7.6};
  double ceiling_m = 8.0;
  double texture_opacity = 1.0;
};

using MapSpec =
    std::variant<ForestSpec, HallSpec, AvoidbenchForestSpec, AvoidbenchIndoorSpec, MazeSpec,
                 GapWallsSpec, DeadEndsSpec, PolesSpec, OverhangsSpec, MeshSpec, PointCloudSpec>;

/// The start and goal bands are at the ends of y, as in the original suites: a flight crosses the
/// map along +y.
template <class Visitor, ConstOr<ForestSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("area_m", s.area_m, Range{15, 200}, "Size in x and y; flights cross it along y.");
  v.field("poisson_radius_m", s.poisson_radius_m, Range{1.0, 20},
          "Least distance between two plants' feet (Bridson 2007); smaller is harder.");
  v.field("bush_ratio", s.bush_ratio, Range{0, 1}, "Fraction of the plants that are bushes.");
  v.field("height_m", s.height_m, Range{3, 20}, "Height of the flight space above the ground.");
  v.field("ground_relief_m", s.ground_relief_m, Range{0, 3},
          "Height between the lowest and the highest ground.");
  v.field("flight_height_m", s.flight_height_m, Range{0.5, 10},
          "Height of starts and goals above the ground.");
}

template <class Visitor, ConstOr<HallSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("area_m", s.area_m, Range{10, 200}, "Size in x and y; flights cross it along y.");
  v.field("poisson_radius_m", s.poisson_radius_m, Range{1.0, 20},
          "Least distance between two cylinders' axes (Bridson 2007); smaller is harder.");
  v.field("cylinder_diameter_m", s.cylinder_diameter_m, Range{0.05, 3},
          "Least and greatest diameter of a cylinder.");
  v.field("cylinder_height_m", s.cylinder_height_m, Range{0.3, 20},
          "Least and greatest height of a cylinder; one higher than the ceiling ends there.");
  v.field("crates_ratio", s.crates_ratio, Range{0, 1},
          "Fraction of the places with a stack of crates instead of a cylinder.");
  v.field("shelf_ratio", s.shelf_ratio, Range{0, 1},
          "Fraction with an open shelf, twice as long as a cylinder is wide.");
  v.field("pillar_ratio", s.pillar_ratio, Range{0, 1}, "Fraction with a square pillar.");
  v.field("moving_ratio", s.moving_ratio, Range{0, 1},
          "Fraction of the cylinders that go back and forth, as far as their neighbours let them.");
  v.field("moving_speed_mps", s.moving_speed_mps, Range{0.05, 10},
          "Least and greatest speed in the middle of a moving cylinder's way.");
  v.field("height_m", s.height_m, Range{2, 20}, "Height of the ceiling.");
  v.field("texture_opacity", s.texture_opacity, Range{0, 1},
          "Strength of the cylinders' painted pattern: low is bland. Does not move any obstacle.");
  v.field("flight_height_m", s.flight_height_m, Range{0.3, 10}, "Height of starts and goals.");
}

/// The fields that both of the original's suites have.
template <class Visitor, class Spec>
void visit_suite(Visitor& v, Spec& s, std::string_view range_origin_doc) {
  v.field("suite_seed", s.suite_seed, Range{0, 2147483647},
          "Seed of the suite's task file; map k is drawn by C's rand seeded with this times k.");
  v.field("field_area_m", s.field_area_m, Range{10, 500},
          "Size in x and y of the field that obstacles are drawn over.");
  v.field("radius_origin_m", s.radius_origin_m, Range{1.0, 20},
          "A map's Poisson radius is this + radius_span_m * u, with the map's own u in [0, 1).");
  v.field("radius_span_m", s.radius_span_m, Range{0, 20}, "Span of the Poisson radii.");
  v.field("range_m", s.range_m, Range{3, 200},
          "The flight space: size in x, in y (flights cross it along y) and height.");
  v.field("range_origin_m", s.range_origin_m, Range{-200, 500}, range_origin_doc);
  v.field("band_width_m", s.band_width_m, Range{1, 200},
          "Width along x of the start and the goal band, in the middle of the flight space.");
  v.field("start_band_m", s.start_band_m, Range{0, 200}, "Least and greatest y of starts.");
  v.field("goal_band_m", s.goal_band_m, Range{0, 200}, "Least and greatest y of goals.");
  v.field("start_height_m", s.start_height_m, Range{0.3, 20}, "Height of starts above the ground.");
  v.field("goal_height_m", s.goal_height_m, Range{0.3, 20},
          "Least and greatest height of goals above the ground.");
}

template <class Visitor, ConstOr<AvoidbenchForestSpec> Spec>
void visit(Visitor& v, Spec& s) {
  visit_suite(v, s,
              "Low corner of the flight space in the field, which begins at (0, 0). The original "
              "centres it across x; where it is along y is not published: here the middle too.");
  v.field("bush_ratio", s.bush_ratio, Range{0, 1}, "Fraction of the plants that are bushes.");
  v.field("ground_relief_m", s.ground_relief_m, Range{0, 3},
          "Height between the lowest and the highest ground.");
}

template <class Visitor, ConstOr<AvoidbenchIndoorSpec> Spec>
void visit(Visitor& v, Spec& s) {
  visit_suite(v, s,
              "Low corner of the flight space in the field, which begins at (0, 0); the original's "
              "field begins 0.8 m behind the flight space's edge.");
  v.field("cylinder_diameter_m", s.cylinder_diameter_m, Range{0.05, 3},
          "Least and greatest diameter of a cylinder.");
  v.field("cylinder_height_m", s.cylinder_height_m, Range{0.5, 50},
          "Least and greatest height of a cylinder; thick ones are high.");
  v.field("ceiling_m", s.ceiling_m, Range{3, 50}, "Height of the hall's ceiling.");
  v.field("texture_opacity", s.texture_opacity, Range{0, 1},
          "Strength of the cylinders' painted pattern: low is bland. Does not move any obstacle.");
}

template <class Visitor, ConstOr<MapSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.variant("generator", s, "What makes the map.");
}

/// The fields of a map that comes from a file; null for others.
struct FileOfMap {
  std::string* file = nullptr;
  std::string* digest = nullptr;
};
FileOfMap file_of(MapSpec& spec);

/// Whether maps of this generator come from a file. Such a map is no field of obstacles: their
/// count, density and gaps follow from how the file was made, not from what stands in the way.
inline bool is_from_file(std::string_view generator) {
  return generator == MeshSpec::kind || generator == PointCloudSpec::kind;
}

/// Throws InputError, with all the reasons at once, where the spec contradicts itself (a flight
/// height above the ceiling).
void check_map(const MapSpec& spec);

/// The map of this spec and seed. Throws InputError where the spec contradicts itself (a flight
/// height above the ceiling) or its file is no map.
World make_world(const MapSpec& spec, std::uint64_t map_seed);

}  // namespace avoidbench
