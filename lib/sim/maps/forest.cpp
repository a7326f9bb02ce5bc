#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math.hpp"
#include "maps/generators.hpp"
#include "maps/plants.hpp"
#include "world/ground.hpp"
#include "world/poisson_disc.hpp"
#include "world/scenery.hpp"

namespace avoidbench {
namespace {

constexpr double kOutside_m = 3.0;  // how far a vehicle may swing out of the area
// The bounds reach below the ground, which undulates: who is under it has collided already.
constexpr double kDepthBelowGround_m = 1.0;

/// Which plants are bushes: the wanted number of them, those of the least draws.
std::vector<bool> draw_bushes(std::size_t plant_count, double bush_ratio, RandomStream random) {
  std::vector<double> draws(plant_count);
  for (double& draw : draws) draw = random.uniform();
  std::vector<std::size_t> order(plant_count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Exactly so many, not each by its own draw: a map's share of bushes is that of the spec.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return draws[a] < draws[b]; });
  const auto bush_count =
      static_cast<std::size_t>(std::round(bush_ratio * static_cast<double>(plant_count)));
  std::vector<bool> is_bush(plant_count, false);
  for (std::size_t i = 0; i < bush_count; ++i) is_bush[order[i]] = true;
  return is_bush;
}

struct PlantPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1.0;
};

/// Any yaw, a slight tilt and a scale; always four draws.
PlantPose draw_pose(RandomStream& random) {
  const double yaw = random.uniform(0.0, math::kTau);
  const double tilt = random.uniform(0.0, 4.0) * math::kDegree;
  const double tilt_turn = random.uniform(0.0, math::kTau);
  const double scale = random.uniform(0.82, 1.18);
  const Eigen::Quaterniond turn = yaw_rotation(yaw);
  const double sine = math::sin(0.5 * tilt);
  // About a level axis in the direction of tilt_turn.
  const Eigen::Quaterniond lean(math::cos(0.5 * tilt), sine * math::cos(tilt_turn),
                                sine * math::sin(tilt_turn), 0.0);
  return {(lean * turn).toRotationMatrix(), scale};
}

}  // namespace

void add_ground(const std::array<double, 2>& size_m, double relief_m, std::uint64_t seed,
                World& world) {
  world.ground =
      make_ground(size_m[0], size_m[1], kGroundMargin_m, relief_m, stream_seed(seed, "ground"));
  world.prototypes.push_back(ground_prototype(world.ground));
  world.instances.emplace_back();
  world.obstacles.push_back({.kind = "ground"});
}

void add_plants(std::span<const Eigen::Vector2d> feet, const PlantRules& rules, std::uint64_t seed,
                World& world) {
  const std::vector<PlantModel> trees = tree_models();
  const std::vector<PlantModel> bushes = bush_models();
  // All models are in each forest, also those that no plant has: indices stay the same.
  const auto first_tree = static_cast<std::uint32_t>(world.prototypes.size());
  for (const PlantModel& model : trees) world.prototypes.push_back(model.prototype);
  const auto first_bush = static_cast<std::uint32_t>(world.prototypes.size());
  for (const PlantModel& model : bushes) world.prototypes.push_back(model.prototype);

  const std::vector<bool> is_bush =
      draw_bushes(feet.size(), rules.bush_ratio, stream(seed, "kinds"));
  // A stream for each question: another bush_ratio changes no pose.
  RandomStream choices = stream(seed, "prototypes");
  RandomStream poses = stream(seed, "poses");
  double width_sum_m = 0.0, count = 0.0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    // Drawn for plants that are left out, too: a kept plant does not depend on what is kept.
    const double choice = choices.uniform();
    const PlantPose pose = draw_pose(poses);
    if (!rules.kept.contains(feet[i])) continue;
    const std::vector<PlantModel>& models = is_bush[i] ? bushes : trees;
    const auto model = static_cast<std::uint32_t>(choice * static_cast<double>(models.size()));

    Obstacle obstacle;
    obstacle.kind = is_bush[i] ? "bush" : "tree";
    obstacle.position_world = {feet[i].x(), feet[i].y(),
                               ground_height_m(world.ground, feet[i].x(), feet[i].y())};
    obstacle.width_m = obstacle_width_m(models[model], pose.scale, rules.height_m);
    width_sum_m += obstacle.width_m;
    count += 1.0;

    Instance instance;
    instance.prototype = (is_bush[i] ? first_bush : first_tree) + model;
    instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
    instance.T_world_prototype.linear() = (pose.scale * pose.rotation).cast<float>();
    instance.T_world_prototype.translation() = obstacle.position_world.cast<float>();
    world.instances.push_back(instance);
    world.obstacles.push_back(obstacle);
  }
  if (count > 0.0) world.mean_obstacle_width_m = width_sum_m / count;
}

void set_forest_bounds(const std::array<double, 2>& size_m, double ceiling_m, World& world) {
  world.flight_bounds = Aabb(Eigen::Vector3d(0.0, 0.0, -kDepthBelowGround_m),
                             Eigen::Vector3d(size_m[0], size_m[1], ceiling_m));
  const Eigen::Vector3d outside(kOutside_m, kOutside_m, 0.0);
  // A vehicle that swings out of the area and comes back has not left the map.
  world.bounds = Aabb(world.flight_bounds.min() - outside, world.flight_bounds.max() + outside);
}

World make_forest(const ForestSpec& spec, std::uint64_t map_seed) {
  const double width_m = spec.area_m[0];
  const double depth_m = spec.area_m[1];
  World world;
  add_ground(spec.area_m, spec.ground_relief_m, map_seed, world);
  RandomStream positions = stream(map_seed, "positions");
  const std::vector<Eigen::Vector2d> feet =
      poisson_disc({width_m, depth_m}, spec.poisson_radius_m, positions);
  add_plants(feet, {.bush_ratio = spec.bush_ratio, .height_m = spec.flight_height_m}, map_seed,
             world);
  set_forest_bounds(spec.area_m, spec.ground_relief_m + spec.height_m, world);

  const double band_m = band_depth_m(depth_m);
  const double last_x_m = width_m - kBandSideMargin_m;
  const double height_m = spec.flight_height_m;
  // Bands at both ends of y: flights go along +y.
  world.start_region = {{kBandSideMargin_m, 0.0, height_m}, {last_x_m, band_m, height_m}};
  world.goal_region = {{kBandSideMargin_m, depth_m - band_m, height_m},
                       {last_x_m, depth_m, height_m}};
  world.heights_above_ground = true;
  world.poisson_radius_m = spec.poisson_radius_m;
  world.digest = world_digest(world);
  return world;
}

}  // namespace avoidbench
