#pragma once

#include <array>

#include "avoidbench/planner.hpp"
#include "planning/preset.hpp"

namespace mbplanner {

/// Fixed for an instance: the parameters within the vehicle's limits, and what the vehicle is.
struct Settings {
  double speed_mps = 0.0, follower_speed_mps = 0.0;
  double acceleration_mps2 = 0.0, climb_mps2 = 0.0, braking_mps2 = 0.0, jerk_mps3 = 0.0;
  double greatest_acceleration_mps2 = 0.0;  ///< of the vehicle
  double robot_length_m = 0.0, robot_height_m = 0.0, body_length_m = 0.0, body_height_m = 0.0;
  double primitive_s = 0.0, substep_s = 0.0;
  int min_edge_substeps = 0, relaxations = 0;
  int levels = 0, branch_levels = 0, root_samples = 0, child_samples = 0, max_tries = 0;
  double cone_rad = 0.0, vertex_separation_m = 0.0, goal_bias = 0.0;
  int evasive_arcs = 0;
  double time_weight = 0.0, clearance_weight_m = 0.0, deviation_weight = 0.0;
  double similarity_m = 0.0, max_traverse_m = 0.0;
  double replan_period_s = 0.0, lead_s = 0.0, yaw_rate_radps = 0.0;
  double focal_length_px = 0.0;  ///< the shortest of its cameras'
  double resolution_m = 0.0, range_m = 0.0, max_departure_m = 0.0;
  double hit_log_odds = 0.0, miss_log_odds = 0.0, least_log_odds = 0.0;
};

/// What can be set, with the presets of this benchmark; README.md has the authors' beside them.
inline constexpr std::array kParameters{
    avoidbench::Setting<Settings>{planning::kPreset, nullptr},
    avoidbench::parameter<&Settings::speed_mps>("max_speed_mps", "m/s", 3.0, 0.2, 15.0,
                                                "Greatest speed of the tree."),
    avoidbench::parameter<&Settings::follower_speed_mps>(
        "follower_speed_mps", "m/s", 20.0, 0.1, 20.0,
        "Paths are flown more slowly, so that this is the greatest speed."),
    avoidbench::parameter<&Settings::acceleration_mps2>(
        "max_acceleration_mps2", "m/s^2", 4.0, 0.5, 20.0,
        "Greatest horizontal acceleration of a primitive."),
    avoidbench::parameter<&Settings::climb_mps2>("max_climb_mps2", "m/s^2", 0.5, 0.0, 10.0,
                                                 "Greatest vertical acceleration of a primitive."),
    avoidbench::parameter<&Settings::braking_mps2>(
        "braking_mps2", "m/s^2", 4.0, 0.5, 20.0,
        "Deceleration of the stop that must be free at a path's end."),
    avoidbench::parameter<&Settings::jerk_mps3>("jerk_mps3", "m/s^3", 20.0, 2.0, 100.0,
                                                "How fast one acceleration becomes the next."),
    avoidbench::parameter<&Settings::robot_length_m>(
        "robot_length_m", "m", 1.2, 0.1, 5.0, "Side of the box that must be free, along x and y."),
    avoidbench::parameter<&Settings::robot_height_m>("robot_height_m", "m", 0.8, 0.1, 5.0,
                                                     "Its height."),
    avoidbench::integer_parameter<&Settings::relaxations>(
        "relaxations", "", 2, 0, 2,
        "How many tighter boxes, flown more slowly, are tried where the "
        "whole one leaves no way."),
    avoidbench::parameter<&Settings::primitive_s>("primitive_s", "s", 0.9, 0.2, 5.0,
                                                  "Duration of a primitive."),
    avoidbench::parameter<&Settings::substep_s>("substep_s", "s", 0.15, 0.05, 1.0,
                                                "Between two checks on a primitive."),
    avoidbench::integer_parameter<&Settings::min_edge_substeps>(
        "min_edge_substeps", "", 3, 1, 20,
        "Shorter primitives are dropped, but on the last level."),
    avoidbench::integer_parameter<&Settings::levels>("levels", "", 7, 1, 12, "Depth of the tree."),
    avoidbench::integer_parameter<&Settings::branch_levels>(
        "branch_levels", "", 4, 0, 12,
        "Levels after the first on which a vertex has several children; "
        "after them it has one."),
    avoidbench::integer_parameter<&Settings::root_samples>("root_samples", "", 15, 1, 200,
                                                           "Children of the root."),
    avoidbench::integer_parameter<&Settings::child_samples>("child_samples", "", 2, 1, 10,
                                                            "Children of the next levels."),
    avoidbench::integer_parameter<&Settings::max_tries>(
        "max_tries", "", 90, 1, 500,
        "Samples a vertex before it gives up; four times that at the "
        "root."),
    avoidbench::parameter<&Settings::cone_rad>(
        "cone_rad", "rad", 1.7, 0.1, 3.2,
        "How far a child's acceleration turns from its parent's."),
    avoidbench::parameter<&Settings::vertex_separation_m>(
        "vertex_separation_m", "m", 0.25, 0.0, 5.0,
        "Least distance between vertices from the third level on."),
    avoidbench::parameter<&Settings::goal_bias>(
        "goal_bias", "", 0.4, 0.0, 1.0,
        "Share of samples that steer to the goal and to the height between start "
        "and goal."),
    avoidbench::integer_parameter<&Settings::evasive_arcs>(
        "evasive_arcs", "", 8, 0, 32, "Arcs tried where braking straight ahead is not free."),
    avoidbench::parameter<&Settings::time_weight>(
        "time_weight", "", 0.25, 0.0, 1.0,
        "Progress that a path has to make up for its time, as a share of what "
        "full speed makes."),
    avoidbench::parameter<&Settings::clearance_weight_m>(
        "clearance_weight_m", "m", 1.5, 0.0, 20.0,
        "Progress worth as much as a path away from all obstacles."),
    avoidbench::parameter<&Settings::deviation_weight>(
        "deviation_weight", "", 0.4, 0.0, 10.0,
        "Progress a new path has to make up for its distance from the old one."),
    avoidbench::parameter<&Settings::similarity_m>(
        "similarity_m", "m", 0.5, 0.0, 5.0,
        "Paths nearer to the best than this compete by clearance alone."),
    avoidbench::parameter<&Settings::max_traverse_m>(
        "max_traverse_m", "m", 10.0, 1.0, 50.0, "Vertices farther along a path get no children."),
    avoidbench::parameter<&Settings::replan_period_s>("replan_period_s", "s", 0.2, 0.03, 60.0,
                                                      "A new tree is grown this often."),
    avoidbench::parameter<&Settings::lead_s>("lead_s", "s", 0.8, 0.0, 5.0,
                                             "… and this long before a path's end."),
    avoidbench::parameter<&Settings::yaw_rate_radps>("yaw_rate_radps", "rad/s", 2.0, 0.1, 10.0,
                                                     "Greatest yaw rate."),
    avoidbench::parameter<&Settings::resolution_m>("resolution_m", "m", 0.15, 0.05, 0.5,
                                                   "Side of the map's cells."),
    avoidbench::parameter<&Settings::range_m>("range_m", "m", 8.0, 2.0, 20.0,
                                              "How far the map reaches."),
    avoidbench::parameter<&Settings::hit_log_odds>(
        "hit_log_odds", "", 1.0, 0.05, 10.0,
        "What an image adds to a cell in which it sees a surface."),
    avoidbench::parameter<&Settings::miss_log_odds>("miss_log_odds", "", -0.4, -10.0, -0.05,
                                                    "What it adds to a cell that it sees through."),
    avoidbench::parameter<&Settings::least_log_odds>(
        "least_log_odds", "", -1.2, -20.0, 0.0,
        "A cell gets no freer than this: the nearer to 0, the sooner something "
        "that was missed before counts."),
    avoidbench::parameter<&Settings::max_departure_m>(
        "max_departure_m", "m", 1.5, 0.2, 20.0,
        "How far it climbs above or sinks below both start and goal."),
};

/// What mbplanner_config.yaml and planner_control_interface_sim_config.yaml of the authors'
/// repository have, where it differs from ours.
inline constexpr std::array kPublished{
    ab_named_number{"max_speed_mps", 1.75},
    ab_named_number{"follower_speed_mps", 1.0},
    ab_named_number{"max_acceleration_mps2", 2.0},
    ab_named_number{"max_climb_mps2", 0.3},
    ab_named_number{"braking_mps2", 2.0},
    ab_named_number{"robot_length_m", 1.4},
    ab_named_number{"relaxations", 0.0},
    ab_named_number{"primitive_s", 1.5},
    ab_named_number{"substep_s", 0.25},
    ab_named_number{"goal_bias", 0.0},
    ab_named_number{"time_weight", 0.0},
    ab_named_number{"clearance_weight_m", 0.0},
    ab_named_number{"deviation_weight", 0.0},
    ab_named_number{"replan_period_s", 60.0},
    ab_named_number{"yaw_rate_radps", 0.5},
    ab_named_number{"resolution_m", 0.2},
    ab_named_number{"range_m", 20.0},
    ab_named_number{"max_departure_m", 3.0},
};

/// The setup's values, within the vehicle's limits.
Settings settings_from(const ab_setup& setup);

}  // namespace mbplanner
