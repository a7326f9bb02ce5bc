#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "base/fields.hpp"
#include "world/file_maps.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// An outdoor forest: trees with trunk and branches and bushes by Poisson-disc sampling on
/// undulating ground.
struct ForestSpec {
  static constexpr std::string_view kind = "forest";
  std::array<double, 2> area_m{40.0, 40.0};
  double poisson_radius_m = 3.5;
  double bush_ratio = 0.4;
  double height_m = 6.0;
  double ground_relief_m = 0.4;
  double flight_height_m = 2.0;
};

/// An indoor hall with a floor, walls and upright cylinders by Poisson-disc sampling.
struct HallSpec {
  static constexpr std::string_view kind = "hall";
  std::array<double, 2> area_m{20.0, 30.0};
  double poisson_radius_m = 3.5;
  std::array<double, 2> cylinder_diameter_m{0.5, 1.0};
  double height_m = 5.0;
  double texture_opacity = 1.0;
  double flight_height_m = 2.0;
};

using MapSpec = std::variant<ForestSpec, HallSpec, MeshSpec, PointCloudSpec>;

/// The start and goal bands are at the ends of y, as in the original suites: a flight crosses the
/// map along +y.
template <class Visitor>
void visit(Visitor& v, ForestSpec& s) {
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

template <class Visitor>
void visit(Visitor& v, HallSpec& s) {
  v.field("area_m", s.area_m, Range{10, 200}, "Size in x and y; flights cross it along y.");
  v.field("poisson_radius_m", s.poisson_radius_m, Range{1.0, 20},
          "Least distance between two cylinders' axes (Bridson 2007); smaller is harder.");
  v.field("cylinder_diameter_m", s.cylinder_diameter_m, Range{0.05, 3},
          "Least and greatest diameter of a cylinder.");
  v.field("height_m", s.height_m, Range{2, 20}, "Height of the ceiling; cylinders reach it.");
  v.field("texture_opacity", s.texture_opacity, Range{0, 1},
          "Strength of the cylinders' painted pattern: low is bland. Does not move any obstacle.");
  v.field("flight_height_m", s.flight_height_m, Range{0.3, 10}, "Height of starts and goals.");
}

template <class Visitor>
void visit(Visitor& v, MapSpec& s) {
  v.variant("generator", s, "What makes the map.");
}

/// The fields of a map that comes from a file; null for others.
struct FileOfMap {
  std::string* file = nullptr;
  std::string* digest = nullptr;
};
FileOfMap file_of(MapSpec& spec);

/// Throws InputError, with all the reasons at once, where the spec contradicts itself (a flight
/// height above the ceiling).
void check_map(const MapSpec& spec);

/// The map of this spec and seed. Throws InputError where the spec contradicts itself (a flight
/// height above the ceiling) or its file is no map.
World make_world(const MapSpec& spec, std::uint64_t map_seed);

}  // namespace avoidbench
