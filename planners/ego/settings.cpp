#include "settings.hpp"

#include <algorithm>
#include <array>

#include "avoidbench/planner_eigen.hpp"
#include "planning/published_values.hpp"

namespace ego {
namespace {

/// What its authors' launch files say (README.md).
constexpr std::array<planning::PublishedValue, 12> kPublished{{{"max_speed_mps", 2.0},
                                                               {"max_acceleration_mps2", 3.0},
                                                               {"map_range_m", 5.5},
                                                               {"ray_length_m", 4.5},
                                                               {"hit_log_odds", 0.619},
                                                               {"miss_log_odds", -0.619},
                                                               {"least_depth_m", 0.2},
                                                               {"image_border_ratio", 0.0},
                                                               {"least_log_odds", -1.992},
                                                               {"safety_distance_m", 0.5},
                                                               {"inflation_m", 0.099},
                                                               {"replan_period_s", 0.0}}};

using Values = planning::PublishedValues<Declared, kPublished.size()>;

planning::RollingGridSpec grid_from(const Values& values) {
  planning::RollingGridSpec grid;
  grid.resolution_m = values.number("resolution_m");
  grid.half_size_m = values.number("map_range_m");
  grid.longest_ray_m = values.number("ray_length_m");
  grid.least_ray_m = values.number("least_depth_m");
  grid.pixel_step = values.integer("pixel_step");
  grid.hit = values.number("hit_log_odds");
  grid.miss = values.number("miss_log_odds");
  grid.lowest_log_odds = values.number("least_log_odds");
  grid.inflation_m = values.number("inflation_m");
  return grid;
}

}  // namespace

Settings settings_from(const ab_setup& setup) {
  const Values values(setup, kPublished);
  Settings settings;
  settings.max_speed_mps = std::min(values.number("max_speed_mps"), setup.max_speed_mps);
  settings.vehicle_acceleration_mps2 = setup.max_acceleration_mps2;
  settings.max_acceleration_mps2 =
      std::min(values.number("max_acceleration_mps2"), 0.8 * setup.max_acceleration_mps2);
  settings.grid = grid_from(values);
  settings.image_border_ratio = values.number("image_border_ratio");
  settings.body_size_m = avoidbench::as_vector(setup.body_size_m);
  if (setup.gravity_mps2 > 0.0) settings.gravity_mps2 = setup.gravity_mps2;
  settings.max_jerk_mps3 = values.number("max_jerk_mps3");
  settings.departure_m = values.number("departure_m");
  settings.horizon_m = values.number("horizon_m");
  settings.replan_distance_m = values.number("replan_distance_m");
  settings.keep_distance_m = values.number("keep_distance_m");
  settings.replan_period_s = values.number("replan_period_s");
  settings.emergency_s = values.number("emergency_s");
  settings.spacing_m = values.number("control_point_spacing_m");
  settings.safety_distance_m = values.number("safety_distance_m");
  settings.weights = {values.number("weight_smoothness"), values.number("weight_collision"),
                      values.number("weight_feasibility"), values.number("weight_fitness")};
  settings.look_ahead_s = values.number("look_ahead_s");
  settings.heading = {0.8 * setup.max_yaw_rate_radps, 6.0};
  return settings;
}

}  // namespace ego
