#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "world/world.hpp"

/// What several generators build maps of; each function adds to the world. Those of forests stand
/// in forest.cpp, those of halls in hall.cpp.
namespace avoidbench {

inline constexpr double kGroundMargin_m = 20.0;  ///< ground around a forest's flight space

/// Undulating ground over [0, size] and kGroundMargin_m around it: the first obstacle.
void add_ground(const std::array<double, 2>& size_m, double relief_m, std::uint64_t seed,
                World& world);

struct PlantRules {
  double bush_ratio = 0.4;  ///< share of all feet that are bushes
  double height_m = 2.0;    ///< above the ground, where obstacles' widths are taken
  Eigen::AlignedBox2d kept{Eigen::Vector2d(-1e9, -1e9), Eigen::Vector2d(1e9, 1e9)};
};

/// A tree or bush at each of the feet (world x, y) that the rules keep, on the ground, and the mean
/// of their widths. Which plant stands where does not depend on which are kept.
void add_plants(std::span<const Eigen::Vector2d> feet, const PlantRules& rules, std::uint64_t seed,
                World& world);

/// Flight bounds over [0, size] from below the ground up to `ceiling_m`, and bounds some metres
/// wider.
void set_forest_bounds(const std::array<double, 2>& size_m, double ceiling_m, World& world);

/// Whether things of this kind are the place itself (ground, wall, ceiling, lamp): not counted
/// among a map's obstacles.
bool is_scenery(std::string_view kind);

/// An obstacle of a mesh of its own, which stands at the obstacle's position unturned.
void add_obstacle(World& world, Prototype prototype, Obstacle obstacle);

/// The same, turned about its own upright axis.
void add_turned_obstacle(World& world, Prototype prototype, Obstacle obstacle, double yaw_rad);

/// An upright block between two corners in the world.
void add_slab(World& world, std::string_view name, std::string_view kind, Material material,
              const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest);

/// Starts and goals at the ends of a hall over [0, area].
void set_hall_bands(const std::array<double, 2>& area_m, double flight_height_m, World& world);

/// Floor, four walls and ceiling around the box.
void add_shell(const Aabb& inside, World& world);

struct Cylinder {
  Eigen::Vector2d foot_world = Eigen::Vector2d::Zero();
  double diameter_m = 0.0;
  double top_m = 0.0;  ///< above the floor
};

/// Upright painted cylinders and the mean of their widths. The strength of each one's pattern is
/// drawn, at most `texture_opacity`.
void add_cylinders(std::span<const Cylinder> cylinders, double texture_opacity, std::uint64_t seed,
                   World& world);

}  // namespace avoidbench
