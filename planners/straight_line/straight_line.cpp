#include <cmath>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"

namespace {

using avoidbench::Vec3;

struct Settings {
  double max_speed_mps = 0.0, line_gain_hz = 0.0;
};

/// Flies along the line from start to goal without looking: the share of missions that need no
/// avoidance at all.
class StraightLine {
 public:
  static constexpr const char* name = "straight_line";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary = "Flies the straight line to the goal and avoids nothing.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::parameter<&Settings::max_speed_mps>("max_speed_mps", "m/s", 3.0, 0.1, 20.0,
                                                      "Speed held until the goal is near."),
      avoidbench::parameter<&Settings::line_gain_hz>(
          "line_gain_hz", "1/s", 1.0, 0.0, 5.0,
          "Speed back toward the line for each metre beside it.")};

  explicit StraightLine(const ab_setup& setup)
      : settings_(avoidbench::settings_from(parameters, setup)) {
    if (setup.max_speed_mps > 0.0) {
      settings_.max_speed_mps = std::min(settings_.max_speed_mps, setup.max_speed_mps);
    }
    braking_mps2_ = setup.max_acceleration_mps2 > 0.0 ? 0.3 * setup.max_acceleration_mps2 : 1.0;
  }

  void reset(const ab_mission& mission) {
    goal_.reset(mission);
    yaw_rad_ = mission.start_yaw_rad;
    aim(mission.start_world_m);
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    if (goal_.update(seen)) aim(seen.state->position_world_m);
    const Vec3& goal_world_m = goal_.place_world_m();
    double left_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      left_m += (goal_world_m[i] - seen.state->position_world_m[i]) * course_[i];
    }
    // As fast as it can still stop from within the way that is left, and back to the line.
    double speed_mps =
        std::min(settings_.max_speed_mps, std::sqrt(2.0 * braking_mps2_ * std::abs(left_m)));
    speed_mps = std::copysign(std::min(speed_mps, 2.0 * std::abs(left_m)), left_m);
    Vec3 velocity_world_mps{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double on_line_m = goal_world_m[i] - left_m * course_[i];
      const double aside_m = on_line_m - seen.state->position_world_m[i];
      velocity_world_mps[i] = speed_mps * course_[i] + settings_.line_gain_hz * aside_m;
    }
    for (const double v : velocity_world_mps) {
      if (!std::isfinite(v)) return std::nullopt;
    }
    return avoidbench::make_velocity_command(velocity_world_mps, yaw_rad_);
  }

 private:
  /// The line to the goal begins here.
  void aim(const double (&from_world_m)[3]) {
    Vec3 along{};
    for (std::size_t i = 0; i < 3; ++i) along[i] = goal_.place_world_m()[i] - from_world_m[i];
    const double length_m =
        std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (std::size_t i = 0; i < 3; ++i) course_[i] = length_m > 0.0 ? along[i] / length_m : 0.0;
    // A course straight up has no heading.
    if (along[0] * along[0] + along[1] * along[1] > 1e-6) {
      yaw_rad_ = avoidbench::portable::atan2(along[1], along[0]);
    }
  }

  Settings settings_;
  double braking_mps2_ = 0.0;
  avoidbench::CurrentGoal goal_;
  Vec3 course_{};
  double yaw_rad_ = 0.0;
};

}  // namespace

AVOIDBENCH_PLANNER(StraightLine)
