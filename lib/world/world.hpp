#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "base/enum_text.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace avoidbench {

/// What a surface is made of: chooses its procedural texture in shaded images (render/shading.hpp).
enum class Material : std::uint8_t { soil, bark, leaf, brick, concrete, painted_metal };

/// A mesh that may stand in many places. Every triangle has a material.
struct Prototype {
  std::string name;
  TriangleMesh mesh;
  std::vector<Material> triangle_materials;  ///< one a triangle
};

/// One placement of a prototype. The linear part is a rotation times a uniform scale.
struct Instance {
  std::uint32_t prototype = 0;
  std::uint32_t obstacle = 0;  ///< index into World::obstacles
  Eigen::Affine3f T_world_prototype = Eigen::Affine3f::Identity();
};

/// One thing a vehicle may hit, for reports: `kind` is "ground", "wall", "ceiling", "tree", "bush", "cylinder", …
struct Obstacle {
  std::string kind;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< of its foot
  double width_m = 0.0;                                      ///< at flight height; 0 for ground and walls
};

/// A box of positions, for starts, goals and flight.
struct Region {
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();
  Eigen::Vector3d highest = Eigen::Vector3d::Zero();
};

/// A map: instanced triangle meshes in a bounded piece of space. Immutable once made; the same bytes from the same spec and
/// seed on every machine. World frame: ENU, z up, metres.
struct World {
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
  std::vector<Obstacle> obstacles;
  Aabb bounds;         ///< a vehicle's centre that leaves it ends the trial with left_bounds
  Aabb flight_bounds;  ///< within bounds: what reference paths and map metrics use
  Region start_region, goal_region;       ///< z is above the ground where `heights_above_ground`
  bool heights_above_ground = false;
  double poisson_radius_m = 0.0;          ///< 0 where obstacles are not a Poisson-disc field
  double mean_obstacle_width_m = 0.0;     ///< ŵ_obstacle of the relative gap size
  std::string digest;                     ///< SHA-256 of all the above; world_digest() makes it
};

/// SHA-256 over geometry, materials, obstacles, bounds and regions.
std::string world_digest(const World& world);

std::size_t triangle_count(const World& world);  ///< of all instances

}  // namespace avoidbench
