#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "base/enum_text.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"
#include "world/motion.hpp"

namespace avoidbench {

/// What a surface is made of: chooses its procedural texture in shaded images (render/shading.hpp).
enum class Material : std::uint8_t { soil, bark, leaf, brick, concrete, painted_metal, lamp };

/// Those that a spec may name: lamps belong to generators.
template <>
struct EnumText<Material> {
  static constexpr std::pair<Material, std::string_view> entries[] = {
      {Material::soil, "soil"},         {Material::bark, "bark"},
      {Material::leaf, "leaf"},         {Material::brick, "brick"},
      {Material::concrete, "concrete"}, {Material::painted_metal, "painted_metal"}};
};

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

/// One thing a vehicle may hit, for reports: `kind` is "ground", "wall", "ceiling", "tree", "bush",
/// "cylinder", …
struct Obstacle {
  std::string kind;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< of its foot
  double width_m = 0.0;          ///< at flight height; 0 for ground and walls
  double texture_opacity = 1.0;  ///< strength of the surface's pattern in [0, 1]: low is bland
};

/// A box of positions, for starts, goals and flight.
struct Region {
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();
  Eigen::Vector3d highest = Eigen::Vector3d::Zero();
};

/// Heights of the ground over a grid of square cells. Each cell is two triangles that share its
/// diagonal from the low corner to the high one, so that heights between the grid's points are
/// exactly those of the ground's mesh.
struct HeightField {
  double low_x_m = 0.0, low_y_m = 0.0;  ///< the first point of the grid
  double cell_m = 1.0;
  std::uint32_t columns = 0, rows = 0;  ///< points along x and along y; none: flat ground at z = 0
  std::vector<float> heights_m;         ///< rows × columns, x fastest
};

/// A map: instanced triangle meshes in a bounded piece of space. Immutable once made; the same
/// bytes from the same spec and seed on every machine. World frame: ENU, z up, metres.
struct World {
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
  std::vector<Motion> motions;  ///< of the instances that move; of most maps none
  std::vector<Obstacle> obstacles;
  HeightField ground;
  Aabb bounds;         ///< a vehicle's centre that leaves it ends the trial with left_bounds
  Aabb flight_bounds;  ///< within bounds: where missions start and end, and what map metrics use
  Region start_region, goal_region;  ///< z is above the ground where `heights_above_ground`
  bool heights_above_ground = false;
  double poisson_radius_m = 0.0;       ///< 0 where obstacles are not a Poisson-disc field
  double mean_obstacle_width_m = 0.0;  ///< ŵ_obstacle of the relative gap size
  std::string digest;                  ///< SHA-256 of all the above; world_digest() makes it
};

/// SHA-256 over geometry, materials, obstacles, bounds and regions.
std::string world_digest(const World& world);

std::size_t triangle_count(const World& world);  ///< of all instances

std::size_t memory_bytes(
    const World& world);  ///< estimate: the arrays' contents, without any renderer's hierarchy

/// "[0.00, 40.00] × [0.00, 40.00] × [0.00, 6.00]", m.
std::string box_text(const Aabb& box);

/// Of any of its points, while it turns and goes.
double greatest_surface_speed_mps(const World& world, const Motion& motion);

/// The world as it is at a moment, in which nothing moves any more. Its digest stays that of
/// `world`.
World standing_at(World world, double time_s);

/// Height of the ground at (x, y), that of its mesh; beyond the mesh, that of its nearest edge.
double ground_height_m(const HeightField& ground, double x_m, double y_m);
double ground_height_m(const World& world, double x_m, double y_m);

}  // namespace avoidbench
