#include "trial/sensor_errors.hpp"

#include <cmath>
#include <limits>
#include <set>

#include "base/option_error.hpp"
#include "base/random.hpp"
#include "base/words.hpp"
#include "render/depth.hpp"
#include "render/rays.hpp"
#include "sensing/camera.hpp"
#include "sensing/lidar_scan.hpp"
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

/// Whether the instance is part of an obstacle of this kind; "": of any.
bool is_of_kind(const World& world, const std::string& kind, std::uint32_t instance) {
  if (kind.empty()) return true;
  const std::uint32_t obstacle = world.instances[instance].obstacle;
  return obstacle < world.obstacles.size() && world.obstacles[obstacle].kind == kind;
}

/// Forgets the truth of pixels that show something else than obstacles of this kind.
void keep_kind(const World& world, const std::string& kind,
               const std::vector<std::uint32_t>& instances, std::vector<float>& truth_m) {
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    if (instances[i] == kNoInstance || is_of_kind(world, kind, instances[i])) continue;
    // Infinite depth: what add_samples() leaves out.
    truth_m[i] = std::numeric_limits<float>::infinity();
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

/// Images of the sensor's own kind of camera, of all its mountings.
void measure_cameras(const Scene& scene, const std::vector<Pose>& poses, std::uint64_t seed,
                     const std::string& kind, SensorErrors& result) {
  const CameraSpec& sensor = result.sensor;
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
  Mean edges, sizes;
  std::uint64_t index = 0;
  for (const Pose& T_world_body : poses) {
    for (const MountingSpec& mounting : mountings(sensor)) {
      const Pose T_world_camera = T_world_body * T_body_camera(mounting);
      // Noise of its own for each image.
      camera.expose(scene, T_world_camera, {}, {.depth = true}, stream_seed(seed, index++), images);
      render_depth(scene, ideal, T_world_camera, truth_m, instances);
      keep_kind(scene.world(), kind, instances, truth_m);
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
}

/// The first surfaces along the shots of a sweep from one place, however far and faint: shots in
/// the directions that the lidar reports.
std::vector<RayHit> true_hits(const Scene& scene, const LidarSpec& lidar, const Pose& T_world_lidar,
                              std::int64_t sweep) {
  std::vector<Ray> rays;
  for (std::int64_t i = 0; i < shots_per_sweep(lidar); ++i) {
    rays.push_back(
        {T_world_lidar.translation(), T_world_lidar.linear() * shot_direction(lidar, sweep, i)});
  }
  std::vector<RayHit> hits(rays.size());
  first_hits(scene, rays, std::numeric_limits<double>::infinity(), hits);
  return hits;
}

/// One sweep from each pose.
LidarErrors measured_lidar(const Scene& scene, const std::vector<Pose>& poses,
                           const LidarSpec& spec, std::uint64_t seed, const std::string& kind) {
  LidarErrors result{.lidar = spec};
  Lidar lidar(spec);
  LidarSweep sweep;
  for (std::size_t index = 0; index < poses.size(); ++index) {
    const Pose T_world_lidar = poses[index] * T_body_lidar(spec.mounting);
    const auto number = static_cast<std::int64_t>(index);
    lidar.begin_sweep(number, stream_seed(seed, std::uint64_t{index}));
    lidar.fire(scene, at_rest(spec, T_world_lidar));
    lidar.end_sweep(T_world_lidar, sweep);
    const std::vector<float> measured_m = measured_ranges_m(spec, sweep);
    const std::vector<RayHit> hits = true_hits(scene, spec, T_world_lidar, number);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      // With a kind, shots at nothing are left out, too, as pixels are.
      const bool is_asked = kind.empty() || (std::isfinite(hits[i].distance_m) &&
                                             is_of_kind(scene.world(), kind, hits[i].instance));
      if (!is_asked) continue;
      result.shots.push_back(
          {.truth_m = static_cast<float>(hits[i].distance_m), .measured_m = measured_m[i]});
    }
  }
  return result;
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
  const World world = make_world(trial.map, trial.map_seed);
  check_kind(world, kind);
  const Scene scene(world);
  const std::vector<Pose> poses = poses_along_missions(scene, trial, mission_count);
  SensorErrors result{.sensor = trial.sensor};
  if (!std::holds_alternative<NoCameraSpec>(trial.sensor.method)) {
    measure_cameras(scene, poses, trial.seed, kind, result);
  }
  for (std::size_t i = 0; i < trial.sensor.lidars.size(); ++i) {
    const std::uint64_t seed = stream_seed(stream_seed(trial.seed, "lidar"), std::uint64_t{i});
    result.lidars.push_back(measured_lidar(scene, poses, trial.sensor.lidars[i], seed, kind));
  }
  return result;
}

}  // namespace avoidbench
