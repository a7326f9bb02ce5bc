#include "base/random.hpp"
#include "maps/avoidbench_field.hpp"
#include "maps/generators.hpp"
#include "world/scenery.hpp"

namespace avoidbench {
namespace {

constexpr double kHallEndMargin_m = 2.0;  // from the field or flight space to the walls across y

/// Feet in the world's frame, whose origin is the low corner of the flight space.
template <class Spec>
std::vector<Eigen::Vector2d> world_feet(const AvoidbenchField& field, const Spec& spec) {
  const Eigen::Vector2d origin(spec.range_origin_m[0], spec.range_origin_m[1]);
  std::vector<Eigen::Vector2d> feet;
  feet.reserve(field.positions_m.size());
  for (const Eigen::Vector2f& place : field.positions_m) {
    feet.emplace_back(place.cast<double>() - origin);
  }
  return feet;
}

/// Of what the original draws otherwise or not at all: kinds of plants, the ground, textures.
template <class Spec>
std::uint64_t scenery_seed(const Spec& spec, std::uint64_t map_number) {
  return stream_seed(static_cast<std::uint64_t>(spec.suite_seed), map_number);
}

/// x is across: flights go from the start's band to the goal's along y.
template <class Spec>
void set_bands(const Spec& spec, World& world) {
  // The bands are in the middle of the flight space's width.
  const double side_m = 0.5 * (spec.range_m[0] - spec.band_width_m);
  const double last_x_m = spec.range_m[0] - side_m;
  world.start_region = {{side_m, spec.start_band_m[0], spec.start_height_m},
                        {last_x_m, spec.start_band_m[1], spec.start_height_m}};
  world.goal_region = {{side_m, spec.goal_band_m[0], spec.goal_height_m[0]},
                       {last_x_m, spec.goal_band_m[1], spec.goal_height_m[1]}};
}

}  // namespace

FieldSuite field_suite(const AvoidbenchForestSpec& spec) {
  return {spec.suite_seed, spec.radius_origin_m, spec.radius_span_m, spec.field_area_m};
}

FieldSuite field_suite(const AvoidbenchIndoorSpec& spec) {
  return {spec.suite_seed, spec.radius_origin_m, spec.radius_span_m, spec.field_area_m};
}

World make_avoidbench_forest(const AvoidbenchForestSpec& spec, std::uint64_t map_number) {
  const AvoidbenchField field = make_avoidbench_field(field_suite(spec), map_number);
  const std::uint64_t seed = scenery_seed(spec, map_number);
  const std::array<double, 2> size_m{spec.range_m[0], spec.range_m[1]};
  World world;
  add_ground(size_m, spec.ground_relief_m, seed, world);
  PlantRules rules{.bush_ratio = spec.bush_ratio, .height_m = spec.start_height_m};
  // Plants are kept on the ground around the flight space too, since they are seen from there.
  const Eigen::Vector2d margin(kGroundMargin_m, kGroundMargin_m);
  rules.kept = {-margin, Eigen::Vector2d(size_m[0], size_m[1]) + margin};
  add_plants(world_feet(field, spec), rules, seed, world);
  set_forest_bounds(size_m, spec.ground_relief_m + spec.range_m[2], world);
  set_bands(spec, world);
  world.heights_above_ground = true;
  world.poisson_radius_m = static_cast<double>(field.radius_m);
  world.digest = world_digest(world);
  return world;
}

World make_avoidbench_indoor(const AvoidbenchIndoorSpec& spec, std::uint64_t map_number) {
  const AvoidbenchField field = make_avoidbench_field(field_suite(spec), map_number);
  World world;
  world.flight_bounds = Aabb(Eigen::Vector3d::Zero(),
                             Eigen::Vector3d(spec.range_m[0], spec.range_m[1], spec.range_m[2]));
  // The hall holds the flight space and the whole field of obstacles.
  world.bounds = world.flight_bounds;
  world.bounds.extend(Eigen::Vector3d(-spec.range_origin_m[0], -spec.range_origin_m[1], 0.0));
  world.bounds.extend(Eigen::Vector3d(spec.field_area_m[0] - spec.range_origin_m[0],
                                      spec.field_area_m[1] - spec.range_origin_m[1], 0.0));
  world.bounds.min().y() -= kHallEndMargin_m;
  world.bounds.max().y() += kHallEndMargin_m;
  Aabb hall = world.bounds;
  hall.max().z() = spec.ceiling_m;
  add_shell(hall, world);

  const std::vector<Eigen::Vector2d> feet = world_feet(field, spec);
  // One ratio for diameter and height: the wide ones are the tall ones.
  const std::vector<double> ratios = avoidbench_size_ratios(field.map_seed, feet.size());
  const auto between = [](const std::array<double, 2>& ends, double ratio) {
    return ends[0] + (ends[1] - ends[0]) * ratio;
  };
  std::vector<Cylinder> cylinders;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    cylinders.push_back({.foot_world = feet[i],
                         .diameter_m = between(spec.cylinder_diameter_m, ratios[i]),
                         .top_m = between(spec.cylinder_height_m, ratios[i])});
  }
  add_cylinders(cylinders, spec.texture_opacity, scenery_seed(spec, map_number), world);
  set_bands(spec, world);
  world.poisson_radius_m = static_cast<double>(field.radius_m);
  world.digest = world_digest(world);
  return world;
}

}  // namespace avoidbench
