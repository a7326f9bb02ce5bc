#include <cmath>

#include "avoidbench/planner.hpp"
#include "surfaces.hpp"

namespace stopping_distance {
namespace {

using Eigen::Vector3d;

struct Settings {
  double margin_m = 0.0, braking_mps2 = 0.0, lag_s = 0.0, memory_s = 0.0;
};

constexpr double kReach_m = 12.0;     // of surfaces that count
constexpr double kLineGain_hz = 1.0;  // back to a trajectory that is flown slower
constexpr double kLead_s = 0.1;       // the point of a trajectory that it then flies toward
constexpr double kUnknownLatency_s = 0.1;

Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Slows down what the vehicle could not stop from before a surface that was seen.
class StoppingDistance {
 public:
  static constexpr const char* name = "stopping_distance";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary =
      "A filter: slows commands down so that the vehicle can stop before what it sees.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_POINTS | AB_INPUT_COMMAND;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY | AB_COMMAND_TRAJECTORY;
  static constexpr std::array parameters{
      avoidbench::parameter<&Settings::margin_m>("margin_m", "m", 0.1, 0.0, 5.0,
                                                 "Distance kept between the body and surfaces."),
      avoidbench::parameter<&Settings::braking_mps2>("braking_mps2", "m/s^2", 2.5, 0.1, 50.0,
                                                     "Deceleration that it counts on."),
      avoidbench::parameter<&Settings::lag_s>(
          "lag_s", "s", 0.25, 0.0, 5.0, "How long the vehicle lags behind a command that acts."),
      avoidbench::parameter<&Settings::memory_s>("memory_s", "s", 3.0, 0.05, 600.0,
                                                 "How long a surface counts after it was seen.")};

  explicit StoppingDistance(const ab_setup& setup)
      : settings_(avoidbench::settings_from(parameters, setup)),
        radius_m_(setup.body_radius_m + settings_.margin_m),
        plan_period_s_(setup.plan_period_s),
        surfaces_(settings_.memory_s, kReach_m) {}

  void reset(const ab_mission& mission) {
    surfaces_.clear();
    const double latency_s = mission.command_latency_s;
    // What is seen after this command acts is answered a period later.
    reaction_s_ = plan_period_s_ + settings_.lag_s +
                  (std::isfinite(latency_s) ? latency_s : kUnknownLatency_s);
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    surfaces_.add(seen);
    if (seen.wanted == nullptr) return std::nullopt;
    const ab_command& wanted = *seen.wanted;
    if (wanted.kind == AB_COMMAND_TRAJECTORY) {
      return is_safe(wanted) ? wanted : slowed(toward(wanted, *seen.state), *seen.state);
    }
    return slowed(wanted, *seen.state);
  }

 private:
  /// The speed from which it stops within this way, after the time that it takes to react.
  double speed_for_mps(double way_m) const {
    const double lost_mps = settings_.braking_mps2 * reaction_s_;
    return std::sqrt(lost_mps * lost_mps + 2.0 * settings_.braking_mps2 * way_m) - lost_mps;
  }

  /// The way on which it stops from this speed.
  double stopping_way_m(double speed_mps) const {
    return speed_mps * reaction_s_ + 0.5 * speed_mps * speed_mps / settings_.braking_mps2;
  }

  /// The velocity command, as fast as the way along it allows.
  ab_command slowed(ab_command command, const ab_state& state) const {
    const Vector3d wanted = vector(command.velocity_world_mps);
    const double wanted_mps = wanted.norm();
    if (!(wanted_mps > 0.0)) return command;
    const Vector3d here = vector(state.position_world_m);
    const double needed_m = stopping_way_m(wanted_mps);
    const double way_m = free_way_m(surfaces_.near(here, needed_m + radius_m_), here,
                                    wanted / wanted_mps, radius_m_, needed_m);
    if (way_m >= needed_m) return command;
    const double share = speed_for_mps(way_m) / wanted_mps;
    for (double& v : command.velocity_world_mps) v *= share;
    return command;
  }

  /// The way along the trajectory to where it would touch a surface; `most_m` where it does not
  /// before.
  double free_way_along_m(const ab_command& trajectory, double most_m) const {
    const ab_point* const points = trajectory.points;
    const std::vector<Vector3d> near =
        surfaces_.near(vector(points[0].position_world_m), most_m + radius_m_);
    double way_m = 0.0;
    for (std::uint32_t i = 0; i + 1 < trajectory.point_count && way_m < most_m; ++i) {
      const Vector3d from = vector(points[i].position_world_m);
      const Vector3d step = vector(points[i + 1].position_world_m) - from;
      const double length_m = step.norm();
      if (!(length_m > 0.0)) continue;
      const double free_m = free_way_m(near, from, step / length_m, radius_m_, length_m);
      way_m += free_m;
      if (free_m < length_m) return std::min(way_m, most_m);
    }
    return most_m;
  }

  /// Whether the vehicle could still stop once the next command acts. What the trajectory does
  /// later, the next calls see.
  bool is_safe(const ab_command& trajectory) const {
    double most_mps = 0.0;
    for (std::uint32_t i = 0; i < trajectory.point_count; ++i) {
      if (i > 0 && trajectory.points[i].time_s > reaction_s_) break;
      most_mps = std::max(most_mps, vector(trajectory.points[i].velocity_world_mps).norm());
    }
    // It is at the last of these points that it may have to begin to brake.
    const double needed_m = most_mps * reaction_s_ + stopping_way_m(most_mps);
    const double free_m = free_way_along_m(trajectory, needed_m);
    if (free_m >= needed_m) return true;
    double way_m = 0.0;
    for (std::uint32_t i = 0; i < trajectory.point_count; ++i) {
      const ab_point& point = trajectory.points[i];
      if (i > 0 && point.time_s > reaction_s_) break;
      if (i > 0) {
        way_m +=
            (vector(point.position_world_m) - vector(trajectory.points[i - 1].position_world_m))
                .norm();
      }
      const double speed_mps = vector(point.velocity_world_mps).norm();
      if (speed_mps > speed_for_mps(std::max(0.0, free_m - way_m))) return false;
    }
    return true;
  }

  /// The velocity that leads back to the trajectory and along it.
  static ab_command toward(const ab_command& trajectory, const ab_state& state) {
    std::uint32_t i = 0;
    while (i + 1 < trajectory.point_count && trajectory.points[i].time_s < kLead_s) ++i;
    const ab_point& next = trajectory.points[i];
    avoidbench::Vec3 velocity_world_mps{};
    for (std::size_t k = 0; k < 3; ++k) {
      velocity_world_mps[k] = next.velocity_world_mps[k] +
                              kLineGain_hz * (next.position_world_m[k] - state.position_world_m[k]);
    }
    return avoidbench::make_velocity_command(velocity_world_mps, next.yaw_rad);
  }

  Settings settings_;
  double radius_m_, plan_period_s_;
  double reaction_s_ = 0.0;
  Surfaces surfaces_;
};

}  // namespace
}  // namespace stopping_distance

AVOIDBENCH_PLANNER(stopping_distance::StoppingDistance)
