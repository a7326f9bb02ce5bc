#include <algorithm>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"
#include "obstacle_memory.hpp"
#include "sight.hpp"
#include "steering.hpp"

template <>
struct avoidbench::IsThreeDoubles<reactive::Vector3> : std::true_type {};

namespace {

using reactive::SteeringSettings;
using reactive::Vector3;

struct Settings {
  SteeringSettings steering;
  double memory_s = 0.0;
};

/// Local and map-free: a polar histogram of what depth cameras and lidars see and saw a moment ago;
/// see README.md.
class Reactive {
 public:
  static constexpr const char* name = "reactive";
  static constexpr const char* version = "1.1";
  static constexpr const char* summary =
      "Polar histogram of nearest depth with a short memory; no map.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_POINTS | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::parameter<&Settings::steering, &SteeringSettings::max_speed_mps>(
          "max_speed_mps", "m/s", 2.5, 0.2, 15.0, "Speed where the way is free."),
      avoidbench::parameter<&Settings::steering, &SteeringSettings::braking_mps2>(
          "braking_mps2", "m/s^2", 3.0, 0.5, 20.0,
          "Deceleration it counts on: it never flies faster than it could stop "
          "in what it sees free."),
      avoidbench::parameter<&Settings::steering, &SteeringSettings::margin_m>(
          "margin_m", "m", 0.3, 0.0, 2.0,
          "Distance kept between body and surfaces where there is room."),
      avoidbench::parameter<&Settings::steering, &SteeringSettings::lookahead_m>(
          "lookahead_m", "m", 6.0, 1.0, 30.0, "Obstacles farther than this don't count."),
      avoidbench::parameter<&Settings::memory_s>(
          "memory_s", "s", 15.0, 0.0, 60.0, "How long an obstacle counts after it left the view."),
      avoidbench::parameter<&Settings::steering, &SteeringSettings::max_departure_m>(
          "max_departure_m", "m", 1.0, 0.0, 20.0,
          "How far it climbs or sinks from the line between start and goal.")};

  Reactive(const ab_setup& setup, const ab_host& host)
      : settings_(settings_from(setup)),
        camera_count_(setup.camera_count),
        lidar_count_(setup.lidar_count),
        steerer_(settings_.steering),
        canvas_(host) {}

  void reset(const ab_mission& mission) {
    start_ = reactive::vector3(mission.start_world_m);
    current_goal_.reset(mission);
    goal_ = reactive::vector3(mission.goal_world_m);
    yaw_rad_ = mission.start_yaw_rad;
    sight_.forget();
    memory_.forget();
    steerer_.forget();
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    reactive::Situation now;
    now.position = reactive::vector3(seen.state->position_world_m);
    now.velocity = reactive::vector3(seen.state->velocity_world_mps);
    if (current_goal_.update(seen)) take_goal(now.position);
    now.goal = goal_;
    if (!reactive::is_finite(now.position) || !reactive::is_finite(now.velocity) ||
        !reactive::is_finite(goal_)) {
      return std::nullopt;
    }
    look(seen, now.position);
    if (!sight_.is_ready()) return hold();
    now.line_height_m = line_height_m(now.position);
    now.points = &points_;
    now.sight = &sight_;
    const reactive::Steering steering = steerer_.steer(now);
    if (reactive::horizontal_norm(steering.look) > 0.05) {
      yaw_rad_ = avoidbench::portable::atan2(steering.look.y, steering.look.x);
    }
    const Vector3& v = steering.velocity;
    if (canvas_.is_wanted()) draw(now.position, steering);
    return with_horizon(avoidbench::make_velocity_command({v.x, v.y, v.z}, yaw_rad_));
  }

 private:
  void take_goal(const Vector3& position) {
    const avoidbench::Vec3& place = current_goal_.place_world_m();
    goal_ = {place[0], place[1], place[2]};
    if (!current_goal_.is_next()) return;
    start_ = position;
    steerer_.forget();
  }

  static Settings settings_from(const ab_setup& setup) {
    Settings settings = avoidbench::settings_from(parameters, setup);
    SteeringSettings& steering = settings.steering;
    steering.body_radius_m = setup.body_radius_m;
    steering.response.acceleration_mps2 = steering.braking_mps2;
    steering.response.latency_s = 0.05 + setup.plan_period_s;
    if (setup.max_speed_mps > 0.0) {
      steering.max_speed_mps = std::min(steering.max_speed_mps, setup.max_speed_mps);
    }
    return settings;
  }

  /// Takes each camera's newest image and each lidar's newest sweep in and gathers what counts as
  /// obstacle now, relative to the vehicle.
  void look(const ab_observation& seen, const Vector3& position) {
    const double time_s = seen.state->time_s;
    points_.clear();
    bool has_new = false;
    for (std::uint32_t camera = 0; camera < camera_count_; ++camera) {
      const ab_depth_image* image = avoidbench::newest_depth(seen, camera);
      if (image == nullptr) continue;
      sight_.take(*image);
      has_new = true;
    }
    for (std::uint32_t lidar = 0; lidar < lidar_count_; ++lidar) {
      const ab_cloud* cloud = avoidbench::newest_cloud(seen, lidar);
      if (cloud == nullptr) continue;
      sight_.take(*cloud);
      has_new = true;
    }
    memory_.prune(position, kMemoryRange_m, time_s, settings_.memory_s, sight_);
    sight_.append_points(settings_.steering.lookahead_m + 1.0, points_);
    seen_count_ = points_.size();
    if (has_new) {
      for (const Vector3& point : points_) {
        const Vector3 offset = point - position;
        const bool matters = std::abs(offset.z) < kMemoryHeight_m && norm(offset) < kMemoryRange_m;
        if (matters) memory_.add(point, time_s);
      }
    }
    memory_.append_points(time_s, points_);
    for (Vector3& point : points_) point = point - position;
  }

  /// For `avoidbench replay`: what counts as obstacle, and where it flies and looks.
  void draw(const Vector3& position, const reactive::Steering& steering) const {
    std::vector<Vector3> seen, remembered;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      (i < seen_count_ ? seen : remembered).push_back(points_[i] + position);
    }
    canvas_.points("remembered", 0x9060c0, remembered);
    canvas_.points("seen", 0x1060e0, seen);
    const std::vector<Vector3> look{position, position + steering.look};
    const std::vector<Vector3> course{position, position + kDrawnCourse_s * steering.velocity};
    canvas_.line("looks along", 0x707070, look, 1.0);
    canvas_.line("chosen course, 3 s", 0xe02080, course, 1.0);
  }

  double line_height_m(const Vector3& position) const {
    const Vector3 course = goal_ - start_;
    const double square_length = course.x * course.x + course.y * course.y;
    if (square_length < 1e-6) return goal_.z;
    const Vector3 flown = position - start_;
    const double share = (flown.x * course.x + flown.y * course.y) / square_length;
    return start_.z + std::clamp(share, 0.0, 1.0) * course.z;
  }

  ab_command hold() const {
    return with_horizon(avoidbench::make_velocity_command({0.0, 0.0, 0.0}, yaw_rad_));
  }

  static ab_command with_horizon(ab_command command) {
    command.horizon_s = 0.5;
    return command;
  }

  static constexpr double kDrawnCourse_s = 3.0;
  static constexpr double kMemoryRange_m = 8.0, kMemoryHeight_m = 1.5;

  Settings settings_;
  std::uint32_t camera_count_ = 0, lidar_count_ = 0;
  reactive::Steerer steerer_;
  reactive::Sight sight_;
  reactive::ObstacleMemory memory_;
  avoidbench::Canvas canvas_;
  std::vector<Vector3> points_;  ///< relative to the vehicle
  std::size_t seen_count_ = 0;   ///< of them, that the newest images show
  avoidbench::CurrentGoal current_goal_;
  Vector3 start_, goal_;
  double yaw_rad_ = 0.0;
};

}  // namespace

AVOIDBENCH_PLANNER(Reactive)
