#include "settings.hpp"

#include <algorithm>
#include <string_view>

#include "avoidbench/planner_eigen.hpp"

namespace ego {
namespace {

struct Figure {
  std::string_view name;
  double value;
};

/// What its authors' launch files say (README.md).
constexpr std::array kPublished{
    Figure{"max_speed_mps", 2.0},     Figure{"max_acceleration_mps2", 3.0},
    Figure{"map_range_m", 5.5},       Figure{"ray_length_m", 4.5},
    Figure{"hit_log_odds", 0.619},    Figure{"miss_log_odds", -0.619},
    Figure{"least_depth_m", 0.2},     Figure{"image_border_ratio", 0.0},
    Figure{"least_log_odds", -1.992}, Figure{"safety_distance_m", 0.5},
    Figure{"inflation_m", 0.099},     Figure{"replan_period_s", 0.0}};

/// The value given, or its authors' where the preset says so and nothing else was given.
double value_of(const ab_setup& setup, std::string_view name) {
  const avoidbench::Parameters<Declared> given(setup);
  const double value = given.number(name);
  if (given.text("preset") != "published") return value;
  const auto declared =
      std::find_if(Declared::parameters.begin(), Declared::parameters.end(),
                   [&](const ab_parameter& parameter) { return name == parameter.name; });
  const auto published = std::find_if(kPublished.begin(), kPublished.end(),
                                      [&](const Figure& figure) { return name == figure.name; });
  const bool is_left = declared != Declared::parameters.end() && value == declared->preset;
  return is_left && published != kPublished.end() ? published->value : value;
}

planning::RollingGridSpec grid_from(const ab_setup& setup) {
  planning::RollingGridSpec grid;
  grid.resolution_m = value_of(setup, "resolution_m");
  grid.half_size_m = value_of(setup, "map_range_m");
  grid.longest_ray_m = value_of(setup, "ray_length_m");
  grid.least_ray_m = value_of(setup, "least_depth_m");
  grid.pixel_step = static_cast<int>(value_of(setup, "pixel_step"));
  grid.hit = value_of(setup, "hit_log_odds");
  grid.miss = value_of(setup, "miss_log_odds");
  grid.lowest_log_odds = value_of(setup, "least_log_odds");
  grid.inflation_m = value_of(setup, "inflation_m");
  return grid;
}

}  // namespace

Settings settings_from(const ab_setup& setup) {
  const auto value = [&](std::string_view name) { return value_of(setup, name); };
  Settings settings;
  settings.max_speed_mps = std::min(value("max_speed_mps"), setup.max_speed_mps);
  settings.vehicle_acceleration_mps2 = setup.max_acceleration_mps2;
  settings.max_acceleration_mps2 =
      std::min(value("max_acceleration_mps2"), 0.8 * setup.max_acceleration_mps2);
  settings.grid = grid_from(setup);
  settings.image_border_ratio = value("image_border_ratio");
  settings.body_size_m = avoidbench::as_vector(setup.body_size_m);
  if (setup.gravity_mps2 > 0.0) settings.gravity_mps2 = setup.gravity_mps2;
  settings.max_jerk_mps3 = value("max_jerk_mps3");
  settings.departure_m = value("departure_m");
  settings.horizon_m = value("horizon_m");
  settings.replan_distance_m = value("replan_distance_m");
  settings.keep_distance_m = value("keep_distance_m");
  settings.replan_period_s = value("replan_period_s");
  settings.emergency_s = value("emergency_s");
  settings.spacing_m = value("control_point_spacing_m");
  settings.safety_distance_m = value("safety_distance_m");
  settings.weights = {value("weight_smoothness"), value("weight_collision"),
                      value("weight_feasibility"), value("weight_fitness")};
  settings.look_ahead_s = value("look_ahead_s");
  settings.heading = {0.8 * setup.max_yaw_rate_radps, 6.0};
  return settings;
}

}  // namespace ego
