#include <cmath>
#include <stdexcept>

#include "avoidbench/planner.hpp"

// Breaks no rule: asks for all images, samples and the state, throws where one is not as planner.h
// says, and flies straight at the goal.
class SeesAll {
 public:
  static constexpr const char* name = "sees_all";
  static constexpr const char* summary = "Checks all that can be seen.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR | AB_INPUT_IMU;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;

  explicit SeesAll(const ab_setup& setup) : camera_count_(setup.camera_count) {
    demand(camera_count_ > 0 && setup.cameras[0] == setup.depth_camera, "no cameras");
    for (std::uint32_t i = 0; i < camera_count_; ++i) pixel_count_ = pixels(*setup.cameras[i]);
    baseline_m_ = setup.depth_camera->baseline_m;
  }

  void reset(const ab_mission& mission) {
    std::copy(mission.goal_world_m, mission.goal_world_m + 3, goal_.begin());
    last_imu_s_ = -1.0;
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    demand(seen.depth_count == seen.stereo_count && seen.depth_count == seen.color_count,
           "different numbers of images");
    for (std::uint32_t i = 0; i < seen.stereo_count; ++i) check_pair(*seen.stereo[i]);
    for (std::uint32_t i = 0; i < seen.color_count; ++i) check_color(*seen.color[i]);
    for (std::uint32_t i = 0; i < seen.imu_count; ++i) {
      demand(seen.imu[i].time_s > last_imu_s_, "an IMU sample came twice");
      last_imu_s_ = seen.imu[i].time_s;
    }
    avoidbench::Vec3 velocity{};
    for (std::size_t k = 0; k < 3; ++k) velocity[k] = goal_[k] - seen.state->position_world_m[k];
    const double length = std::sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] +
                                    velocity[2] * velocity[2]);
    for (double& v : velocity) v *= length > 2.0 ? 2.0 / length : 1.0;
    return avoidbench::make_velocity_command(velocity, 0.5 * 3.14159265358979);
  }

 private:
  static void demand(bool holds, const char* otherwise) {
    if (!holds) throw std::runtime_error(otherwise);
  }
  static std::size_t pixels(const ab_camera& camera) {
    return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  }

  void check_pair(const ab_stereo_pair& pair) {
    demand(pair.baseline_m == baseline_m_, "another baseline");
    demand(pair.left->channels == 1 && pair.right->channels == 1, "a pair that is not grey");
    demand(pair.left->camera < camera_count_ && pair.left->time_s == pair.right->time_s,
           "eyes of different moments");
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double step = pair.right->position_world_m[k] - pair.left->position_world_m[k];
      square += step * step;
    }
    demand(std::abs(std::sqrt(square) - baseline_m_) < 1e-9, "eyes not a baseline apart");
    for (std::size_t i = 0; i < pixel_count_; ++i) {
      light_ += static_cast<std::size_t>(pair.left->pixels[i]) + pair.right->pixels[i];
    }
  }

  void check_color(const ab_picture& picture) {
    demand(picture.channels == 3, "a picture without colours");
    for (std::size_t i = 0; i < 3 * pixel_count_; ++i) light_ += picture.pixels[i];
  }

  std::uint32_t camera_count_;
  std::size_t pixel_count_ = 0;
  std::size_t light_ = 0;  ///< of all pixels: every one is read
  double baseline_m_ = 0.0, last_imu_s_ = -1.0;
  avoidbench::Vec3 goal_{};
};

AVOIDBENCH_PLANNER(SeesAll)
