#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "avoidbench/planner.hpp"
#include "avoidbench/planner_eigen.hpp"
#include "smooth_line.hpp"
#include "speed_profile.hpp"

namespace {

using omniscient::Line;

constexpr double kLineStep_m = 0.1;
constexpr double kPointStep_s = 0.05;
constexpr int kPoints = 30;  ///< of a command: it reaches 1.5 s ahead
// What the vehicle keeps of its acceleration for wind, and to come back to the line.
constexpr double kUsedAcceleration = 0.6;
constexpr double kPace_mps = 1.0;
// Beside the body, from wide to narrow: the first with which there is a way.
constexpr double kKeptMargin = 0.5;  ///< of it: the rest is for smoothing
constexpr std::array kMargins_m{0.4, 0.3, 0.2, 0.12, 0.06, 0.02};

struct Settings {
  double max_speed_mps = 20.0;
};

/// Asks for the map, bends the shortest path into a smooth line and flies it as fast as the vehicle
/// can: what no planner that has to see obstacles can reach.
class Omniscient {
 public:
  static constexpr const char* name = "omniscient";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary =
      "Knows the map and flies the shortest path as fast as the vehicle can: a ceiling, no "
      "competitor.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_WORLD | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr std::array parameters{avoidbench::parameter<&Settings::max_speed_mps>(
      "max_speed_mps", "m/s", 20.0, 0.1, 20.0, "Speed limit; the vehicle's own holds as well.")};

  Omniscient(const ab_setup& setup, const ab_host& host) : canvas_(host), world_(host) {
    const auto settings = avoidbench::settings_from(parameters, setup);
    limits_ = {.speed_mps = std::min(settings.max_speed_mps, setup.max_speed_mps),
               .acceleration_mps2 = kUsedAcceleration * setup.max_acceleration_mps2};
    // That of the reference paths: the largest ball in the outline.
    body_radius_m_ = 0.5 * std::min(setup.body_size_m[0], setup.body_size_m[1]);
  }

  void reset(const ab_mission& mission) {
    yaw_rad_ = mission.start_yaw_rad;
    latency_s_ = std::isfinite(mission.command_latency_s) ? mission.command_latency_s : 0.0;
    begin_s_.reset();
    line_.clear();
    goal_.reset(mission);
    Line widest;  // path, as it was asked for
    for (const double margin_m : kMargins_m) {
      const Line path = path_for(body_radius_m_ + margin_m);
      if (path.empty()) continue;
      if (widest.empty()) widest = path;
      const Line smooth = omniscient::smoothed(
          path, body_radius_m_ + kKeptMargin * margin_m,
          [this](const Line& places_world) { return distances_m(places_world); },
          held_points(path, mission));
      if (smooth.empty()) continue;
      fly_along(smooth, limits_);
      return;
    }
    if (widest.empty()) avoidbench::give_up("no way to the goal is wide enough");
    // Round corners that are none at a walking pace.
    fly_along(widest, {.speed_mps = std::min(limits_.speed_mps, kPace_mps),
                       .acceleration_mps2 = 0.2 * limits_.acceleration_mps2});
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    if (line_.empty()) return std::nullopt;  // reset() gave up
    // A goal that moves comes back to where it was: there it is waited for.
    if (goal_.update(seen) && !goal_.is_next() && !flown_limits_.ends_at_rest) {
      flown_limits_.ends_at_rest = true;
      timed_ = omniscient::TimedLine(line_, flown_limits_);
    }
    // The line's time is 0 when the first command acts.
    const double acts_s = seen.time_s + latency_s_;
    if (!begin_s_) begin_s_ = acts_s;
    points_.clear();
    for (int i = 0; i <= kPoints; ++i) {
      const double ahead_s = i * kPointStep_s;
      const omniscient::Motion motion = timed_.at(acts_s - *begin_s_ + ahead_s);
      ab_point& point = points_.emplace_back();
      point.time_s = ahead_s;
      avoidbench::as_vector(point.position_world_m) = motion.position_world;
      avoidbench::as_vector(point.velocity_world_mps) = motion.velocity_world;
      avoidbench::as_vector(point.acceleration_world_mps2) = motion.acceleration_world;
      point.yaw_rad = yaw_rad_;
    }
    if (canvas_.is_wanted()) canvas_.line("line", 0x20a040, line_);
    return avoidbench::make_trajectory_command(points_);
  }

 private:
  /// The shortest path for a ball of this radius, in even steps; empty where it has none.
  Line path_for(double radius_m) const {
    Line corners;
    for (const avoidbench::Vec3& point : world_.shortest_path_m(radius_m)) {
      corners.emplace_back(avoidbench::as_vector(point));
      if (!corners.back().allFinite()) return {};  // to a goal that is no place
    }
    if (corners.size() < 2) return {};
    const Line path = omniscient::resampled(corners, kLineStep_m);
    return path.size() < 3 ? Line{} : path;
  }

  /// Where the path enters each goal but the last: there the line stays on it.
  static std::vector<std::size_t> held_points(const Line& path, const ab_mission& mission) {
    std::vector<avoidbench::Vec3> goals = avoidbench::goals_of(mission);
    goals.pop_back();
    std::vector<std::size_t> held;
    auto from = path.begin();
    for (const avoidbench::Vec3& goal : goals) {
      // The host's path goes half into the circle.
      from = std::find_if(from, path.end(), [&](const Eigen::Vector3d& point) {
        return (point - avoidbench::as_vector(goal)).head<2>().norm() <=
               0.5 * mission.goal_radius_m + kLineStep_m;
      });
      if (from == path.end()) break;
      held.push_back(static_cast<std::size_t>(from - path.begin()));
    }
    return held;
  }

  std::vector<double> distances_m(const Line& places_world) const {
    std::vector<avoidbench::Vec3> places;
    for (const Eigen::Vector3d& place : places_world) {
      places.push_back(avoidbench::as_array(place));
    }
    return world_.distances_m(places);
  }

  void fly_along(const Line& line, const omniscient::Limits& limits) {
    line_ = omniscient::resampled(line, kLineStep_m);
    // TimedLine takes evenly spaced points: a last leg of another length goes straight on.
    line_.back() = 2.0 * line_[line_.size() - 2] - line_[line_.size() - 3];
    flown_limits_ = limits;
    timed_ = omniscient::TimedLine(line_, flown_limits_);
  }

  avoidbench::Canvas canvas_;
  avoidbench::KnownWorld world_;
  avoidbench::CurrentGoal goal_;
  omniscient::Limits limits_, flown_limits_;
  double body_radius_m_ = 0.0, yaw_rad_ = 0.0, latency_s_ = 0.0;
  std::optional<double> begin_s_;  ///< when the line's first point is flown
  Line line_;
  omniscient::TimedLine timed_;
  std::vector<ab_point> points_;
};

}  // namespace

AVOIDBENCH_PLANNER(Omniscient)
