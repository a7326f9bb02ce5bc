#pragma once

#include <array>

#include "avoidbench/planner.hpp"
#include "planning/heading.hpp"
#include "planning/preset.hpp"

namespace agile {

/// Fixed for an instance; README.md says what each figure is for.
struct Settings {
  double max_speed_mps = 3.0;
  double vehicle_acceleration_mps2 = 6.0;  ///< what no command may exceed
  double brake_cost = 1.0;
  double keep_cost = 0.1;
  double tracking_error_m = 0.5;  ///< from which it plans from the odometry
  double look_ahead_s = 1.0;
  double scan_s = 0.8, scan_rad = 0.7;
  planning::HeadingLimits heading;
};

/// What a sweep may set.
inline constexpr std::array kParameters{
    avoidbench::Setting<Settings>{planning::kPreset, nullptr},
    avoidbench::parameter<&Settings::max_speed_mps>(
        "max_speed_mps", "m/s", 3.0, 0.2, 10.0,
        "Speed it flies at where it can; the net was trained from 1.5 to 6.5 m/s."),
    avoidbench::parameter<&Settings::brake_cost>(
        "brake_cost", "", 1.0, 0.1, 4.0,
        "It brakes where every mode's predicted cost is above this; standing still costs 1."),
    avoidbench::parameter<&Settings::keep_cost>(
        "keep_cost", "", 0.1, 0.0, 1.0,
        "Of the modes that cost at most this more than the best, it flies the one nearest to what "
        "it flies already."),
    avoidbench::parameter<&Settings::look_ahead_s>("look_ahead_s", "s", 1.0, 0.1, 3.0,
                                                   "It looks to where it will be after this time."),
    avoidbench::parameter<&Settings::scan_s>(
        "scan_s", "s", 0.8, 0.2, 5.0,
        "Where it sees no way it stands and looks about, so long in each direction."),
    avoidbench::parameter<&Settings::heading, &planning::HeadingLimits::rate_radps>(
        "max_yaw_rate_radps", "rad/s", 2.0, 0.2, 10.0, "Greatest yaw rate.")};

/// Preset `published`: the speed that the authors' test settings fly at.
inline constexpr std::array kPublished{ab_named_number{"max_speed_mps", 7.0}};

/// The values of `setup`, kept within the vehicle's limits.
Settings settings_from(const ab_setup& setup);

}  // namespace agile
