#include <cmath>
#include <cstdlib>

#include "avoidbench/planner.hpp"

/// Flies one straight trajectory at a constant speed, whatever it sees, and gives up where the one
/// thing that its parameter names is not perfect. So its flights fail by that thing and no other.
namespace {

using avoidbench::Vec3;

struct Settings {
  std::string minds;
  double speed_mps = 0.0;
};

class Picky {
 public:
  static constexpr const char* name = "picky";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_IMU;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr std::array parameters{
      avoidbench::choice_parameter<&Settings::minds>(
          "minds", "nothing",
          "nothing|depth|latency|crash|state|wind|tracking|limit|own_speed|view|range",
          "What it can't bear."),
      avoidbench::parameter<&Settings::speed_mps>("cruise_speed_mps", "m/s", 2.0, 0.1, 20.0,
                                                  "Speed of the trajectory.")};

  explicit Picky(const ab_setup& setup)
      : settings_(avoidbench::settings_from(parameters, setup)),
        max_speed_mps_(setup.max_speed_mps) {
    const ab_camera& camera = *setup.cameras[0];
    half_width_ = 0.5 * camera.width_px / camera.fx_px;
    range_m_ = camera.max_range_m;
  }

  void reset(const ab_mission& mission) {
    latency_s_ = mission.command_latency_s;
    yaw_rad_ = mission.start_yaw_rad;
    double length_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      start_[i] = mission.start_world_m[i];
      along_[i] = mission.goal_world_m[i] - start_[i];
      length_m += along_[i] * along_[i];
    }
    for (double& v : along_) v *= settings_.speed_mps / std::sqrt(length_m);
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    if (minds("latency") && !(latency_s_ == 0.0)) avoidbench::give_up("commands come late");
    if (minds("crash") && seen.time_s > 0.2 && !(latency_s_ == 0.0)) std::abort();
    if (minds("limit") && max_speed_mps_ > 5.0) avoidbench::give_up("it may fly too fast");
    if (minds("own_speed") && settings_.speed_mps > 1.5)
      avoidbench::give_up("it wants to fly fast");
    if (minds("view") && half_width_ < 1.5) avoidbench::give_up("it sees too little");
    if (minds("range") && range_m_ < 20.0) avoidbench::give_up("it does not see far");
    if (minds("state") && seen.state->rates_body_radps[2] != 0.0 && seen.time_s == 0.0) {
      avoidbench::give_up("it turns though it stands");
    }
    if (minds("depth") && seen.depth_count > 0) look_at(*seen.depth[0]);
    if (minds("wind")) feel(seen);
    if (minds("tracking")) look_where(seen);
    points_ = {point_at(seen.time_s + latency_s_), point_at(seen.time_s + latency_s_ + 1.0)};
    points_[0].time_s = 0.0;
    points_[1].time_s = 1.0;
    return avoidbench::make_trajectory_command(points_);
  }

 private:
  bool minds(std::string_view what) const { return settings_.minds == what; }

  void look_at(const ab_depth_image& image) const {
    for (int i = 0; i < image.width_px * image.height_px; ++i) {
      if (std::isnan(image.depth_m[i])) avoidbench::give_up("a pixel has no depth");
    }
  }

  /// Wind pushes the body sideways from the first moment on.
  void feel(const ab_observation& seen) const {
    for (std::uint32_t i = 0; i < seen.imu_count; ++i) {
      const double* force = seen.imu[i].specific_force_body_mps2;
      if (seen.imu[i].time_s == 0.0 && std::abs(force[0]) + std::abs(force[1]) > 0.2) {
        avoidbench::give_up("something pushes");
      }
    }
  }

  /// Its trajectory begins at full speed, which no vehicle can follow.
  void look_where(const ab_observation& seen) const {
    if (seen.time_s < 0.2) return;
    const ab_point wanted = point_at(seen.time_s);
    double away = 0.0;
    for (int i = 0; i < 3; ++i) {
      away += std::abs(wanted.position_world_m[i] - seen.state->position_world_m[i]);
    }
    if (away > 0.03) avoidbench::give_up("it is not where it was told to be");
  }

  ab_point point_at(double time_s) const {
    ab_point point{};
    for (std::size_t i = 0; i < 3; ++i) {
      point.position_world_m[i] = start_[i] + along_[i] * (time_s - latency_s_);
      point.velocity_world_mps[i] = along_[i];
    }
    point.yaw_rad = yaw_rad_;
    return point;
  }

  Settings settings_;
  double max_speed_mps_ = 0.0, half_width_ = 0.0, range_m_ = 0.0;
  double latency_s_ = 0.0, yaw_rad_ = 0.0;
  Vec3 start_{}, along_{};
  std::vector<ab_point> points_;
};

}  // namespace

AVOIDBENCH_PLANNER(Picky)
