#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "avoidbench/planner.hpp"

// Breaks no rule: asks for sweeps, tracks and goals, throws where one is not as planner.h says, and
// flies at the goal that it is shown, slower where anything is near.
class SeesMovers {
 public:
  static constexpr const char* name = "sees_movers";
  static constexpr const char* summary = "Checks sweeps, tracks and goals.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_POINTS | AB_INPUT_TRACKS | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;

  explicit SeesMovers(const ab_setup& setup) : lidar_count_(setup.lidar_count) {
    demand(lidar_count_ > 0, "no lidars");
    for (std::uint32_t i = 0; i < lidar_count_; ++i) {
      const ab_lidar& lidar = *setup.lidars[i];
      demand(lidar.shots > 0 && lidar.rate_hz > 0.0, "a lidar that fires nothing");
      demand(lidar.min_range_m < lidar.max_range_m, "a lidar without a range");
      shots_ = std::max(shots_, lidar.shots);
      range_m_ = std::max(range_m_, lidar.max_range_m);
    }
  }

  void reset(const ab_mission& mission) { goal_count_ = avoidbench::goals_of(mission).size(); }

  std::optional<ab_command> plan(const ab_observation& seen) {
    demand(seen.depth_count == 0 && seen.imu_count == 0, "what was not asked for");
    demand(seen.goal_index < goal_count_, "a goal that the mission does not have");
    double speed_mps = 2.0;
    for (std::uint32_t i = 0; i < seen.cloud_count; ++i) check_sweep(*seen.clouds[i], speed_mps);
    for (std::uint32_t i = 0; i < seen.track_count; ++i) {
      const ab_track& track = seen.tracks[i];
      demand(track.time_s <= seen.time_s, "a track from the future");
      const double x_m = track.center_world_m[0] - seen.state->position_world_m[0];
      const double y_m = track.center_world_m[1] - seen.state->position_world_m[1];
      speed_mps = std::min(speed_mps, 0.2 + 0.3 * std::sqrt(x_m * x_m + y_m * y_m));
    }
    avoidbench::Vec3 velocity{};
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      velocity[k] = seen.goal_world_m[k] - seen.state->position_world_m[k];
      square += velocity[k] * velocity[k];
    }
    const double length = std::sqrt(square);
    if (!std::isfinite(length)) return std::nullopt;
    for (double& v : velocity) v *= length > speed_mps ? speed_mps / length : 1.0;
    return avoidbench::make_velocity_command(velocity, 0.0);
  }

 private:
  static void demand(bool holds, const char* otherwise) {
    if (!holds) throw std::runtime_error(otherwise);
  }

  void check_sweep(const ab_cloud& cloud, double& speed_mps) const {
    demand(cloud.lidar < lidar_count_, "a sweep of a lidar that is not there");
    demand(cloud.point_count + cloud.miss_count <= shots_, "more points than shots");
    for (std::uint32_t i = 0; i < cloud.point_count; ++i) {
      const ab_lidar_point& point = cloud.points[i];
      demand(point.time_s <= 0.0F && std::isfinite(point.position_lidar_m[0]), "an odd point");
      const double x_m = static_cast<double>(point.position_lidar_m[0]);
      const double y_m = static_cast<double>(point.position_lidar_m[1]);
      const double level_m = std::sqrt(x_m * x_m + y_m * y_m);
      demand(level_m <= 1.1 * range_m_, "a point beyond the range");
      speed_mps = std::min(speed_mps, 0.2 + 0.5 * level_m);
    }
    for (std::uint32_t i = 0; i < 3 * cloud.miss_count; ++i) {
      demand(std::abs(cloud.misses_lidar[i]) <= 1.001F, "a direction that is no unit vector");
    }
  }

  std::uint32_t lidar_count_, shots_ = 0;
  double range_m_ = 0.0;
  std::size_t goal_count_ = 0;
};

AVOIDBENCH_PLANNER(SeesMovers)
