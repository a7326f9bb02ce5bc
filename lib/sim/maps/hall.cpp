#include <algorithm>
#include <array>
#include <optional>

#include "base/math.hpp"
#include "maps/furniture.hpp"
#include "maps/generators.hpp"
#include "world/poisson_disc.hpp"
#include "world/scenery.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

constexpr double kWallThickness_m = 0.2;
constexpr double kCylinderSink_m = 0.05;  // into floor and ceiling, so that no faces coincide
constexpr int kCylinderSides = 32;
constexpr double kBandWallMargin_m = 1.0;
constexpr double kLeastOpacityRatio = 0.8;

/// Lets some cylinders go back and forth, each within half the gap that Poisson-disc sampling
/// leaves to a neighbour, so that none meet.
void add_motions(const HallSpec& spec, std::uint64_t seed, World& world) {
  RandomStream draws = stream(seed, "motions");
  const double reach_m = 0.5 * (spec.poisson_radius_m - spec.cylinder_diameter_m[1]);
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    if (world.obstacles[world.instances[i].obstacle].kind != "cylinder") continue;
    const bool is_moving = draws.uniform() < spec.moving_ratio;
    // Drawn for all cylinders: a higher ratio lets more of them move, and the others' ways stay.
    const double heading_rad = draws.uniform(0.0, math::kTau);
    const double speed_mps = draws.uniform(spec.moving_speed_mps[0], spec.moving_speed_mps[1]);
    const double phase = draws.uniform();
    if (!is_moving) continue;
    const Eigen::Vector3d direction(math::cos(heading_rad), math::sin(heading_rad), 0.0);
    world.motions.push_back({.instance = i,
                             .path = Sway{.amplitude_world = reach_m * direction,
                                          // So that the greatest speed, amplitude · 2π / period, is
                                          // the one that was drawn.
                                          .period_s = math::kTau * reach_m / speed_mps,
                                          .phase = phase}});
  }
}

/// What stands at a place, by a draw in [0, 1); nothing: a cylinder.
std::optional<FurnitureKind> furniture_kind(const HallSpec& spec, double draw) {
  // The shares lie one after the other in [0, 1).
  if (draw < spec.crates_ratio) return FurnitureKind::crates;
  draw -= spec.crates_ratio;
  if (draw < spec.shelf_ratio) return FurnitureKind::shelf;
  draw -= spec.shelf_ratio;
  if (draw < spec.pillar_ratio) return FurnitureKind::pillar;
  return std::nullopt;
}

}  // namespace

/// What is there in every map and no obstacle to count.
bool is_scenery(std::string_view kind) {
  static constexpr std::array<std::string_view, 4> kScenery{"ground", "wall", "ceiling", "lamp"};
  return std::find(kScenery.begin(), kScenery.end(), kind) != kScenery.end();
}

void add_obstacle(World& world, Prototype prototype, Obstacle obstacle) {
  add_turned_obstacle(world, std::move(prototype), std::move(obstacle), 0.0);
}

void add_turned_obstacle(World& world, Prototype prototype, Obstacle obstacle, double yaw_rad) {
  Instance instance;
  instance.prototype = static_cast<std::uint32_t>(world.prototypes.size());
  instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
  instance.T_world_prototype.translation() = obstacle.position_world.cast<float>();
  // The identity stays exact.
  if (yaw_rad != 0.0) {
    instance.T_world_prototype.linear() = upright_turn(yaw_rad);
  }
  world.prototypes.push_back(std::move(prototype));
  world.instances.push_back(instance);
  world.obstacles.push_back(std::move(obstacle));
}

void add_slab(World& world, std::string_view name, std::string_view kind, Material material,
              const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest) {
  Obstacle obstacle;
  obstacle.kind = kind;
  obstacle.position_world = {0.5 * (lowest.x() + highest.x()), 0.5 * (lowest.y() + highest.y()),
                             lowest.z()};
  // Prototypes have their foot at the origin; single precision is finest there.
  Prototype slab;
  slab.name = name;
  add_box(slab, lowest - obstacle.position_world, highest - obstacle.position_world, material);
  add_obstacle(world, std::move(slab), std::move(obstacle));
}

/// Six slabs around the inside, which touch and do not overlap.
void add_shell(const Aabb& inside, World& world) {
  const Eigen::Vector3d& a = inside.min();
  const Eigen::Vector3d& b = inside.max();
  const double t = kWallThickness_m;
  add_slab(world, "floor", "ground", Material::concrete, {a.x() - t, a.y() - t, a.z() - t},
           {b.x() + t, b.y() + t, a.z()});
  add_slab(world, "wall_low_x", "wall", Material::brick, {a.x() - t, a.y() - t, a.z()},
           {a.x(), b.y() + t, b.z()});
  add_slab(world, "wall_high_x", "wall", Material::brick, {b.x(), a.y() - t, a.z()},
           {b.x() + t, b.y() + t, b.z()});
  add_slab(world, "wall_low_y", "wall", Material::brick, {a.x(), a.y() - t, a.z()},
           {b.x(), a.y(), b.z()});
  add_slab(world, "wall_high_y", "wall", Material::brick, {a.x(), b.y(), a.z()},
           {b.x(), b.y() + t, b.z()});
  add_slab(world, "ceiling", "ceiling", Material::concrete, {a.x() - t, a.y() - t, b.z()},
           {b.x() + t, b.y() + t, b.z() + t});
}

void add_cylinders(std::span<const Cylinder> cylinders, double texture_opacity, std::uint64_t seed,
                   World& world) {
  RandomStream textures = stream(seed, "textures");
  double width_sum_m = 0.0;
  for (const Cylinder& cylinder : cylinders) {
    Obstacle obstacle;
    obstacle.kind = "cylinder";
    obstacle.position_world = {cylinder.foot_world.x(), cylinder.foot_world.y(), 0.0};
    obstacle.width_m = cylinder.diameter_m;
    obstacle.texture_opacity = texture_opacity * textures.uniform(kLeastOpacityRatio, 1.0);
    width_sum_m += obstacle.width_m;

    Prototype prototype;
    prototype.name = "cylinder";
    const double radius_m = 0.5 * obstacle.width_m;
    const std::array<TubeRing, 2> rings{
        TubeRing{.centre = {0.0, 0.0, -kCylinderSink_m}, .radius_m = radius_m},
        TubeRing{.centre = {0.0, 0.0, cylinder.top_m}, .radius_m = radius_m}};
    add_tube(prototype, rings, kCylinderSides, Material::painted_metal);
    add_obstacle(world, std::move(prototype), std::move(obstacle));
  }
  world.mean_obstacle_width_m = width_sum_m / static_cast<double>(cylinders.size());
}

void set_hall_bands(const std::array<double, 2>& area_m, double flight_height_m, World& world) {
  const double band_m = band_depth_m(area_m[1]);
  const double last_x_m = area_m[0] - kBandSideMargin_m;
  world.start_region = {{kBandSideMargin_m, kBandWallMargin_m, flight_height_m},
                        {last_x_m, band_m, flight_height_m}};
  world.goal_region = {{kBandSideMargin_m, area_m[1] - band_m, flight_height_m},
                       {last_x_m, area_m[1] - kBandWallMargin_m, flight_height_m}};
}

World make_hall(const HallSpec& spec, std::uint64_t map_seed) {
  const double width_m = spec.area_m[0];
  const double depth_m = spec.area_m[1];
  World world;
  world.flight_bounds =
      Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d(width_m, depth_m, spec.height_m));
  add_shell(world.flight_bounds, world);

  // Feet are drawn in the area less the widest cylinder's radius: none stands in a wall.
  const double inset_m = 0.5 * spec.cylinder_diameter_m[1];
  RandomStream positions = stream(map_seed, "positions");
  RandomStream diameters = stream(map_seed, "diameters");
  RandomStream heights = stream(map_seed, "heights");
  RandomStream kinds = stream(map_seed, "kinds");
  std::vector<Cylinder> cylinders;
  std::vector<Furniture> furniture;
  // All draws are made at each place, whatever comes to stand there, so that other ratios leave the
  // places and sizes alone.
  for (const Eigen::Vector2d& place : poisson_disc(
           {width_m - 2.0 * inset_m, depth_m - 2.0 * inset_m}, spec.poisson_radius_m, positions)) {
    const Eigen::Vector2d foot(place.x() + inset_m, place.y() + inset_m);
    const double diameter_m =
        diameters.uniform(spec.cylinder_diameter_m[0], spec.cylinder_diameter_m[1]);
    const double top_m = heights.uniform(spec.cylinder_height_m[0], spec.cylinder_height_m[1]);
    if (const auto kind = furniture_kind(spec, kinds.uniform())) {
      furniture.push_back({.kind = *kind, .foot_world = foot, .size_m = diameter_m});
    } else {
      cylinders.push_back(
          {.foot_world = foot,
           .diameter_m = diameter_m,
           // One that reaches the ceiling goes into it.
           .top_m = top_m < spec.height_m ? top_m : spec.height_m + kCylinderSink_m});
    }
  }
  add_cylinders(cylinders, spec.texture_opacity, map_seed, world);
  double width_sum_m =
      cylinders.empty() ? 0.0 : world.mean_obstacle_width_m * static_cast<double>(cylinders.size());
  for (std::size_t i = 0; i < furniture.size(); ++i) {
    add_furniture(furniture[i], spec.height_m, stream_seed(map_seed, i), world);
    width_sum_m += world.obstacles.back().width_m;
  }
  world.mean_obstacle_width_m =
      width_sum_m / static_cast<double>(cylinders.size() + furniture.size());
  add_motions(spec, map_seed, world);
  add_lamps(world.flight_bounds, world);
  world.bounds = world.flight_bounds;
  set_hall_bands(spec.area_m, spec.flight_height_m, world);
  world.poisson_radius_m = spec.poisson_radius_m;
  world.digest = world_digest(world);
  return world;
}

}  // namespace avoidbench
