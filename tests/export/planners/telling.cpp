#include <cstdint>
#include <cstdio>
#include <cstring>

#include "avoidbench/planner.hpp"

/// Flies slowly ahead and logs what it sees: each image's time, camera and FNV-1a of its bytes, and
/// the same of each sweep; so that what an export has can be compared with what a planner had.
class Telling {
 public:
  static constexpr const char* name = "telling";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO |
                                         AB_INPUT_COLOR | AB_INPUT_POINTS | AB_INPUT_IMU;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  Telling(const ab_setup&, const ab_host& host) : host_(&host) {}
  void reset(const ab_mission&) { log("reset", 0.0, 0, nullptr, 0); }

  std::optional<ab_command> plan(const ab_observation& seen) {
    for (std::uint32_t i = 0; i < seen.depth_count; ++i) {
      const ab_depth_image& image = *seen.depth[i];
      log("depth", image.time_s, image.camera, image.depth_m,
          sizeof(float) * static_cast<std::size_t>(image.width_px * image.height_px));
    }
    for (std::uint32_t i = 0; i < seen.stereo_count; ++i) {
      tell("left", *seen.stereo[i]->left);
      tell("right", *seen.stereo[i]->right);
    }
    for (std::uint32_t i = 0; i < seen.color_count; ++i) tell("color", *seen.color[i]);
    for (std::uint32_t i = 0; i < seen.cloud_count; ++i) {
      const ab_cloud& cloud = *seen.clouds[i];
      log("points", cloud.time_s, cloud.lidar, cloud.points,
          sizeof(ab_lidar_point) * cloud.point_count);
    }
    return avoidbench::make_velocity_command({0.5, 0.0, 0.0}, 0.0);
  }

 private:
  void tell(const char* what, const ab_picture& picture) {
    const auto pixels = static_cast<std::size_t>(picture.width_px * picture.height_px);
    log(what, picture.time_s, picture.camera, picture.pixels, pixels * picture.channels);
  }
  void log(const char* what, double time_s, std::uint32_t index, const void* bytes,
           std::size_t size) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (std::size_t i = 0; i < size; ++i) {
      hash = (hash ^ static_cast<const std::uint8_t*>(bytes)[i]) * 0x100000001b3U;
    }
    char line[100];
    std::snprintf(line, sizeof line, "%s %u %.9f %016llx", what, index, time_s,
                  static_cast<unsigned long long>(hash));
    host_->log(host_->context, AB_LOG_INFO, line);
  }

  const ab_host* host_;
};

AVOIDBENCH_PLANNER(Telling)
