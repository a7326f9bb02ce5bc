#pragma once

#include <cstdint>

#include "maps/avoidbench_field.hpp"
#include "maps/map_spec.hpp"

/// One function a kind of map. Specs are checked by make_world().
namespace avoidbench {

World make_forest(const ForestSpec& spec, std::uint64_t map_seed);
World make_hall(const HallSpec& spec, std::uint64_t map_seed);
World make_avoidbench_forest(const AvoidbenchForestSpec& spec, std::uint64_t map_number);
World make_avoidbench_indoor(const AvoidbenchIndoorSpec& spec, std::uint64_t map_number);
World make_maze(const MazeSpec& spec, std::uint64_t map_seed);
World make_gap_walls(const GapWallsSpec& spec, std::uint64_t map_seed);
World make_dead_ends(const DeadEndsSpec& spec, std::uint64_t map_seed);
World make_poles(const PolesSpec& spec, std::uint64_t map_seed);
World make_overhangs(const OverhangsSpec& spec, std::uint64_t map_seed);

/// What the maps' obstacles are drawn from.
FieldSuite field_suite(const AvoidbenchForestSpec& spec);
FieldSuite field_suite(const AvoidbenchIndoorSpec& spec);

/// Start and goal regions keep so far from the sides of the map.
inline constexpr double kBandSideMargin_m = 2.0;
/// Depth along y of the start and of the goal band: 6 m of 40 m, as in the original suites.
inline double band_depth_m(double area_y_m) { return area_y_m * (6.0 / 40.0); }

inline constexpr double kInnerWall_m = 0.2;  ///< thickness of walls within a hall
inline constexpr double kBandGap_m = 1.0;    ///< from a band to the hard cases' first obstacle

/// From a trap's middle to its farthest corner.
double trap_reach_m(const DeadEndsSpec& spec);

}  // namespace avoidbench
