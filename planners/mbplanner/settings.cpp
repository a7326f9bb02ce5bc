#include "settings.hpp"

#include <algorithm>
#include <array>

namespace mbplanner {
namespace {

/// mbplanner_config.yaml and planner_control_interface_sim_config.yaml of the authors' repository,
/// where they differ from ours.
constexpr std::array<planning::PublishedValue, 18> kPublished{{
    {"max_speed_mps", 1.75},
    {"follower_speed_mps", 1.0},
    {"max_acceleration_mps2", 2.0},
    {"max_climb_mps2", 0.3},
    {"braking_mps2", 2.0},
    {"robot_length_m", 1.4},
    {"relaxations", 0.0},
    {"primitive_s", 1.5},
    {"substep_s", 0.25},
    {"goal_bias", 0.0},
    {"time_weight", 0.0},
    {"clearance_weight_m", 0.0},
    {"deviation_weight", 0.0},
    {"replan_period_s", 60.0},
    {"yaw_rate_radps", 0.5},
    {"resolution_m", 0.2},
    {"range_m", 20.0},
    {"max_departure_m", 3.0},
}};

/// `limit` where the vehicle has one.
double capped(double value, double limit) { return limit > 0.0 ? std::min(value, limit) : value; }

}  // namespace

Settings settings_from(const ab_setup& setup) {
  const planning::PublishedValues<Declaration, kPublished.size()> values(setup, kPublished);
  Settings s;
  const double pull_mps2 =
      setup.max_acceleration_mps2 > 0.0 ? 0.95 * setup.max_acceleration_mps2 : 20.0;
  s.speed_mps = capped(values.number("max_speed_mps"), setup.max_speed_mps);
  s.follower_speed_mps = values.number("follower_speed_mps");
  s.climb_mps2 = std::min(values.number("max_climb_mps2"), 0.3 * pull_mps2);
  s.acceleration_mps2 = std::min(values.number("max_acceleration_mps2"), 0.9 * pull_mps2);
  s.braking_mps2 = std::min(values.number("braking_mps2"), 0.9 * pull_mps2);
  s.greatest_acceleration_mps2 = pull_mps2;
  s.jerk_mps3 = values.number("jerk_mps3");
  s.robot_length_m = values.number("robot_length_m");
  s.robot_height_m = values.number("robot_height_m");
  s.body_length_m = std::max({setup.body_size_m[0], setup.body_size_m[1], 0.1});
  s.body_height_m = std::max(setup.body_size_m[2], 0.05);
  s.primitive_s = values.number("primitive_s");
  s.substep_s = values.number("substep_s");
  s.min_edge_substeps = values.integer("min_edge_substeps");
  s.relaxations = values.integer("relaxations");
  s.levels = values.integer("levels");
  s.branch_levels = values.integer("branch_levels");
  s.root_samples = values.integer("root_samples");
  s.child_samples = values.integer("child_samples");
  s.max_tries = values.integer("max_tries");
  s.cone_rad = values.number("cone_rad");
  s.vertex_separation_m = values.number("vertex_separation_m");
  s.goal_bias = values.number("goal_bias");
  s.evasive_arcs = values.integer("evasive_arcs");
  s.time_weight = values.number("time_weight");
  s.clearance_weight_m = values.number("clearance_weight_m");
  s.deviation_weight = values.number("deviation_weight");
  s.similarity_m = values.number("similarity_m");
  s.max_traverse_m = values.number("max_traverse_m");
  s.replan_period_s = values.number("replan_period_s");
  s.lead_s = values.number("lead_s");
  s.yaw_rate_radps = capped(values.number("yaw_rate_radps"), 0.95 * setup.max_yaw_rate_radps);
  s.focal_length_px = setup.depth_camera != nullptr ? setup.depth_camera->fx_px : 0.0;
  s.resolution_m = values.number("resolution_m");
  s.range_m = values.number("range_m");
  s.max_departure_m = values.number("max_departure_m");
  s.hit_log_odds = values.number("hit_log_odds");
  s.miss_log_odds = values.number("miss_log_odds");
  s.least_log_odds = values.number("least_log_odds");
  return s;
}

}  // namespace mbplanner
