#include "trial/sensor_errors.hpp"

#include <cmath>
#include <limits>
#include <set>

#include "base/option_error.hpp"
#include "base/random.hpp"
#include "base/words.hpp"
#include "render/depth.hpp"
#include "sensing/camera.hpp"
#include "trial/mission.hpp"

namespace avoidbench {
namespace {

/// Of the numbers among what is added.
struct Mean {
  double sum = 0.0, count = 0.0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    count += 1.0;
  }
  double value() const { return sum / count; }
};

/// Forgets the truth of pixels that show something else than obstacles of this kind.
void keep_kind(const World& world, const std::string& kind,
               const std::vector<std::uint32_t>& instances, std::vector<float>& truth_m) {
  if (kind.empty()) return;
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    if (instances[i] == kNoInstance) continue;
    const std::uint32_t obstacle = world.instances[instances[i]].obstacle;
    const bool is_kind =
        obstacle < world.obstacles.size() && world.obstacles[obstacle].kind == kind;
    // Infinite depth: what add_samples() leaves out.
    if (!is_kind) truth_m[i] = std::numeric_limits<float>::infinity();
  }
}

void check_kind(const World& world, const std::string& kind) {
  if (kind.empty()) return;
  std::set<std::string> kinds;
  for (const Obstacle& obstacle : world.obstacles) kinds.insert(obstacle.kind);
  if (kinds.contains(kind)) return;
  const std::vector<std::string> known(kinds.begin(), kinds.end());
  throw OptionError(
      kind + ": the map has none" + did_you_mean(kind, known) + "; it has: " + joined(known), "of");
}

}  // namespace

DepthStatistics SensorErrors::statistics(bool edges, double nearest_m, double farthest_m) const {
  return depth_statistics(samples, edges, nearest_m, farthest_m, disparity_at_1m_px(sensor));
}

std::vector<Pose> poses_along_missions(const Scene& scene, const TrialSpec& trial,
                                       std::int64_t mission_count) {
  std::vector<Pose> poses;
  constexpr double kFree_m = 0.6;
  for (std::int64_t i = 0; i < mission_count; ++i) {
    const auto mission = make_mission(scene, trial.mission, trial.seed, i);
    if (!mission) continue;
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const Eigen::Vector3d place =
          mission->start_world + part * (goals_of(*mission).front() - mission->start_world);
      if (scene.nearest(place, kFree_m).distance_m < kFree_m) continue;
      poses.push_back(make_pose(place, yaw_rotation(mission->start_yaw_rad)));
    }
  }
  return poses;
}

SensorErrors measure_sensor(const TrialSpec& trial, std::int64_t mission_count,
                            const std::string& kind) {
  const SensorSpec& sensor = trial.sensor;
  const World world = make_world(trial.map, trial.map_seed);
  check_kind(world, kind);
  const Scene scene(world);
  // The sensor's own image without its noise and its limits of range.
  Pinhole ideal = sensor_camera(sensor);
  ideal.min_range_m = 0.0;
  ideal.max_range_m = std::numeric_limits<double>::infinity();
  const int width = static_cast<int>(sensor.width_px);
  const double at_1m_px = disparity_at_1m_px(sensor);
  Camera camera(sensor);
  CameraImages images;
  std::vector<float> truth_m(static_cast<std::size_t>(sensor.width_px * sensor.height_px));
  std::vector<std::uint32_t> instances(truth_m.size());
  SensorErrors result{.sensor = sensor};
  Mean edges, sizes;
  std::uint64_t index = 0;
  for (const Pose& T_world_body : poses_along_missions(scene, trial, mission_count)) {
    for (const MountingSpec& mounting : mountings(sensor)) {
      const Pose T_world_camera = T_world_body * T_body_camera(mounting);
      // Noise of its own for each image.
      camera.expose(scene, T_world_camera, {}, {.depth = true}, stream_seed(trial.seed, index++),
                    images);
      render_depth(scene, ideal, T_world_camera, truth_m, instances);
      keep_kind(world, kind, instances, truth_m);
      // At edges a pixel's depth is of either side: figures are of what is farther from them than
      // this.
      constexpr int kEdge_px = 8;
      add_samples(truth_m, images.depth_m, width, at_1m_px, kEdge_px, result.samples);
      edges.add(fattening_px(truth_m, images.depth_m, width, at_1m_px, kEdge_px));
      sizes.add(error_size_px(truth_m, images.depth_m, width, at_1m_px));
    }
  }
  result.fattening_px = edges.value();
  result.error_size_px = sizes.value();
  return result;
}

}  // namespace avoidbench
