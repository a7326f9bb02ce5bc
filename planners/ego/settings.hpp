#pragma once

#include <array>

#include "avoidbench/planner.hpp"
#include "planning/bspline.hpp"
#include "planning/heading.hpp"
#include "planning/preset.hpp"
#include "planning/rolling_grid.hpp"

namespace ego {

/// Weights of the costs; see cost.hpp.
struct Weights {
  double smoothness = 1.0, collision = 0.5, feasibility = 0.1, fitness = 1.0;
};

/// Fixed for an instance; README.md has what each figure is for and its authors' own.
struct Settings {
  double max_speed_mps = 3.0, max_acceleration_mps2 = 4.0;
  double max_jerk_mps3 = 40.0;
  double vehicle_acceleration_mps2 = 6.0;  ///< what no command may exceed
  double gravity_mps2 = 9.81;
  double max_turn_rate_radps = 7.0;  ///< of the thrust; vehicles roll and pitch faster
  planning::RollingGridSpec grid;
  double image_border_ratio = 0.05, map_period_s = 0.0;
  Eigen::Vector3d body_size_m = Eigen::Vector3d(0.5, 0.5, 0.12);
  double departure_m = 1.0;  ///< how far it may climb above or sink below the missions' heights
  double least_height_m = 0.5, ceiling_m = 1000.0;
  int limits_per_axis = 0;  ///< 0: speed and acceleration are limited by their norms
  double horizon_m = 7.5;
  double replan_distance_m = 1.5, keep_distance_m = 2.0, replan_period_s = 0.2;
  double emergency_s = 1.0;
  double spacing_m = 0.4;  ///< between control points at full speed, about
  double safety_distance_m = 1.0;
  double feasibility_tolerance = 0.05;
  double tracking_error_m = 0.5;  ///< from which it plans from the odometry
  double look_ahead_s = 1.0;
  Weights weights;
  planning::HeadingLimits heading;
};

/// What a sweep may set.
inline constexpr std::array kParameters{
    avoidbench::Setting<Settings>{planning::kPreset, nullptr},
    avoidbench::parameter<&Settings::max_speed_mps>("max_speed_mps", "m/s", 3.0, 0.2, 15.0,
                                                    "Greatest speed."),
    avoidbench::parameter<&Settings::max_acceleration_mps2>(
        "max_acceleration_mps2", "m/s^2", 4.0, 0.5, 20.0, "Greatest acceleration it plans with."),
    avoidbench::parameter<&Settings::max_jerk_mps3>(
        "max_jerk_mps3", "m/s^3", 40.0, 1.0, 1000.0,
        "Greatest jerk it plans with: over 9.8 m/s^2 the body rate it asks for."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::resolution_m>(
        "resolution_m", "m", 0.1, 0.05, 0.5, "Edge of the map's cells."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::half_size_m>(
        "map_range_m", "m", 6.0, 2.0, 15.0, "Half the map's side; beyond it nothing is known."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::longest_ray_m>(
        "ray_length_m", "m", 5.5, 1.0, 15.0, "Depth beyond this only frees the cells up to there."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::least_ray_m>(
        "least_depth_m", "m", 0.5, 0.0, 5.0,
        "Nearer depth is left out: a stereo matcher's mistakes, mostly."),
    avoidbench::parameter<&Settings::image_border_ratio>(
        "image_border_ratio", "", 0.05, 0.0, 0.4,
        "Share of an image's rows left out at its upper and at its lower edge, "
        "for the same reason."),
    avoidbench::integer_parameter<&Settings::grid, &planning::RollingGridSpec::pixel_step>(
        "pixel_step", "px", 2, 1, 16, "Every so many-th pixel and row goes into the map."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::hit>(
        "hit_log_odds", "", 1.0, 0.05, 10.0,
        "What an image adds to a cell in which it sees a surface."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::miss>(
        "miss_log_odds", "", -0.4, -10.0, -0.05, "What it adds to a cell that it sees through."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::lowest_log_odds>(
        "least_log_odds", "", -1.2, -20.0, 0.0,
        "A cell gets no freer than this: the nearer to 0, the sooner something "
        "that was missed before counts."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::unknown_log_odds>(
        "unknown_log_odds", "", 0.0, -20.0, 1.0, "From which a cell's first image counts."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::passes_per_hit>(
        "passes_per_hit", "", 2.0, 0.25, 10.0,
        "An image hits a cell if fewer rays than this go on behind it for each that ends in it."),
    avoidbench::integer_parameter<&Settings::grid, &planning::RollingGridSpec::keeps_grazed>(
        "keeps_grazed", "", 1, 0, 1,
        "1: cells of surfaces that are seen flat are hit and not missed; 0: they count as others."),
    avoidbench::parameter<&Settings::map_period_s>(
        "map_period_s", "s", 0.0, 0.0, 10.0,
        "At most one image in each such period goes into the map; 0: all."),
    avoidbench::parameter<&Settings::grid, &planning::RollingGridSpec::inflation_m>(
        "inflation_m", "m", 0.5, 0.0, 2.0,
        "How far from an occupied cell along each axis the way counts as "
        "blocked for the vehicle's centre."),
    avoidbench::parameter<&Settings::departure_m>(
        "departure_m", "m", 1.0, 0.0, 50.0,
        "How far it climbs above or sinks below start and goal."),
    avoidbench::parameter<&Settings::least_height_m>(
        "least_height_m", "m", 0.5, -1000.0, 1000.0,
        "It flies no lower than this, unless start or goal are."),
    avoidbench::parameter<&Settings::ceiling_m>(
        "ceiling_m", "m", 1000.0, -1000.0, 1000.0,
        "It flies no higher than this, unless start or goal are."),
    avoidbench::integer_parameter<&Settings::limits_per_axis>(
        "limits_per_axis", "", 0, 0, 1,
        "1: speed and acceleration are limited along each axis; 0: by their norms."),
    avoidbench::parameter<&Settings::horizon_m>(
        "horizon_m", "m", 7.5, 2.0, 30.0,
        "Distance of the local target along the way to the goal."),
    avoidbench::parameter<&Settings::replan_distance_m>("replan_distance_m", "m", 1.5, 0.1, 20.0,
                                                        "It plans again after so much way."),
    avoidbench::parameter<&Settings::keep_distance_m>(
        "keep_distance_m", "m", 2.0, 0.0, 20.0,
        "So near the goal it keeps a trajectory that ends there."),
    avoidbench::parameter<&Settings::replan_period_s>(
        "replan_period_s", "s", 0.2, 0.0, 10.0,
        "It plans again after so much time; 0: only by way and collision."),
    avoidbench::parameter<&Settings::emergency_s>(
        "emergency_s", "s", 1.0, 0.1, 5.0,
        "It brakes where a collision is nearer than this and no plan is found."),
    avoidbench::parameter<&Settings::spacing_m>(
        "control_point_spacing_m", "m", 0.4, 0.1, 2.0,
        "Between control points at full speed; their interval is 1.2 times the "
        "time for it."),
    avoidbench::parameter<&Settings::safety_distance_m>(
        "safety_distance_m", "m", 1.0, 0.05, 3.0,
        "How far the collision cost pushes control points off an obstacle."),
    avoidbench::parameter<&Settings::weights, &Weights::smoothness>(
        "weight_smoothness", "", 1.0, 0.0, 1000.0, "Of squared jerk."),
    avoidbench::parameter<&Settings::weights, &Weights::collision>(
        "weight_collision", "", 0.5, 0.0, 1000.0, "Of penetration, doubled at each new try."),
    avoidbench::parameter<&Settings::weights, &Weights::feasibility>(
        "weight_feasibility", "", 0.1, 0.0, 1000.0,
        "Of velocity and acceleration beyond the limits."),
    avoidbench::parameter<&Settings::weights, &Weights::fitness>(
        "weight_fitness", "", 1.0, 0.0, 1000.0, "Of distance from the curve that is made slower."),
    avoidbench::parameter<&Settings::look_ahead_s>(
        "look_ahead_s", "s", 1.0, 0.05, 5.0,
        "It looks at the place where it will be so much later.")};

/// What its authors' launch files say (README.md).
inline constexpr std::array kPublished{
    ab_named_number{"max_speed_mps", 2.0},     ab_named_number{"max_acceleration_mps2", 3.0},
    ab_named_number{"map_range_m", 5.5},       ab_named_number{"ray_length_m", 4.5},
    ab_named_number{"hit_log_odds", 0.619},    ab_named_number{"miss_log_odds", -0.619},
    ab_named_number{"least_depth_m", 0.2},     ab_named_number{"image_border_ratio", 0.0},
    ab_named_number{"least_log_odds", -1.992}, ab_named_number{"safety_distance_m", 0.5},
    ab_named_number{"inflation_m", 0.099},     ab_named_number{"replan_period_s", 0.0},
    ab_named_number{"passes_per_hit", 1.0},    ab_named_number{"unknown_log_odds", -2.002},
    ab_named_number{"keeps_grazed", 0.0},      ab_named_number{"map_period_s", 0.05},
    ab_named_number{"departure_m", 50.0},      ab_named_number{"least_height_m", -0.01},
    ab_named_number{"ceiling_m", 2.5},         ab_named_number{"limits_per_axis", 1.0}};

/// What its curves are to keep.
inline planning::MotionLimits limits_of(const Settings& settings) {
  return {settings.max_speed_mps, settings.max_acceleration_mps2, settings.max_jerk_mps3,
          settings.limits_per_axis != 0 ? planning::LimitOf::axes : planning::LimitOf::norm};
}

/// Never beyond what the vehicle of `setup` can do.
Settings settings_from(const ab_setup& setup);

}  // namespace ego
