#include "explain/sight.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "render/camera.hpp"

namespace avoidbench {
namespace {

/// How many places of the patch fulfil each condition.
struct Counts {
  std::size_t near = 0, in_cone = 0, unoccluded = 0, in_range = 0;
};

/// A ray may not end on the patch itself.
constexpr double kShorter_m = 0.02;

bool is_occluded(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& place) {
  const Eigen::Vector3d ray = place - eye;
  const double length_m = ray.norm();
  return length_m > kShorter_m && scene.occluded(eye, place - kShorter_m / length_m * ray);
}

Counts counts_of(const Pinhole& camera, const Pose& T_world_camera, const Scene& scene,
                 const std::vector<Eigen::Vector3d>& places) {
  const Pose T_camera_world = T_world_camera.inverse();
  Counts counts;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d p = T_camera_world * place;
    if (p.norm() <= camera.max_range_m) ++counts.near;
    if (p.z() <= 0.0) continue;
    const double x = camera.fx_px * p.x() / p.z() + camera.cx_px;
    const double y = camera.fy_px * p.y() / p.z() + camera.cy_px;
    // Pixel centres are whole: the image reaches half a pixel beyond them.
    if (x < -0.5 || y < -0.5 || x > camera.width_px - 0.5 || y > camera.height_px - 0.5) continue;
    ++counts.in_cone;
    if (is_occluded(scene, T_world_camera.translation(), place)) continue;
    ++counts.unoccluded;
    if (p.z() >= camera.min_range_m && p.z() <= camera.max_range_m) ++counts.in_range;
  }
  return counts;
}

void add_exposures(const CameraSpec& kind, Scene& scene, const StruckPatch& patch,
                   const std::vector<Sample>& samples, std::vector<PatchExposure>& exposures) {
  const Pinhole camera = sensor_camera(kind);
  const std::vector<MountingSpec> places_of_cameras = mountings(kind);
  const auto count = static_cast<std::int64_t>(std::floor(patch.contact_s * kind.rate_hz)) + 1;
  const auto enough = [&](std::size_t places) {
    return static_cast<double>(places) >=
           kEnoughOfPatch * static_cast<double>(patch.places_world.size());
  };
  for (std::int64_t i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(i) / kind.rate_hz;
    scene.set_time(time_s);
    const Pose T_world_body = body_pose_at(samples, time_s);
    const std::vector<Eigen::Vector3d> places = places_at(patch, time_s);
    PatchExposure exposure{.time_s = time_s};
    for (const MountingSpec& mounting : places_of_cameras) {
      const Counts counts =
          counts_of(camera, T_world_body * T_body_camera(mounting), scene, places);
      exposure.is_near = exposure.is_near || enough(counts.near);
      exposure.in_cone = exposure.in_cone || enough(counts.in_cone);
      exposure.unoccluded = exposure.unoccluded || enough(counts.unoccluded);
      exposure.in_range = exposure.in_range || enough(counts.in_range);
    }
    exposures.push_back(exposure);
  }
}

/// The same of the sweeps of a lidar, each as seen from where its end is. A beam is as wide as the
/// gap to the next ones, which later sweeps may fill.
void add_sweeps(const LidarSpec& lidar, Scene& scene, const StruckPatch& patch,
                const std::vector<Sample>& samples, std::vector<PatchExposure>& exposures) {
  constexpr double kBeside_rad = math::kDegree;
  const auto [lowest_rad, highest_rad] = elevations_rad(lidar);
  const Pose T_body = T_body_lidar(lidar.mounting);
  const auto count = static_cast<std::int64_t>(std::floor(patch.contact_s * lidar.rate_hz));
  for (std::int64_t i = 1; i <= count; ++i) {
    const double time_s = static_cast<double>(i) / lidar.rate_hz;
    scene.set_time(time_s);
    const Pose T_world_lidar = body_pose_at(samples, time_s) * T_body;
    const Pose T_lidar_world = T_world_lidar.inverse();
    Counts counts;
    for (const Eigen::Vector3d& place : places_at(patch, time_s)) {
      const Eigen::Vector3d p = T_lidar_world * place;
      if (p.norm() <= lidar.max_range_m) ++counts.near;
      const double elevation_rad = math::atan2(p.z(), p.head<2>().norm());
      if (elevation_rad < lowest_rad - kBeside_rad || elevation_rad > highest_rad + kBeside_rad) {
        continue;
      }
      ++counts.in_cone;
      if (is_occluded(scene, T_world_lidar.translation(), place)) continue;
      ++counts.unoccluded;
      if (p.norm() >= lidar.min_range_m && p.norm() <= lidar.max_range_m) ++counts.in_range;
    }
    const auto enough = [&](std::size_t places) {
      return static_cast<double>(places) >=
             kEnoughOfPatch * static_cast<double>(patch.places_world.size());
    };
    exposures.push_back({.time_s = time_s,
                         .is_near = enough(counts.near),
                         .in_cone = enough(counts.in_cone),
                         .unoccluded = enough(counts.unoccluded),
                         .in_range = enough(counts.in_range)});
  }
}

}  // namespace

std::vector<PatchExposure> patch_exposures(const SensorSpec& sensor, const World& world,
                                           const StruckPatch& patch,
                                           const std::vector<Sample>& samples) {
  // Its own: the caller's keeps its time.
  Scene scene(world);
  std::vector<PatchExposure> exposures;
  for (const CameraSpec& kind : camera_kinds(sensor)) {
    add_exposures(kind, scene, patch, samples, exposures);
  }
  for (const LidarSpec& lidar : sensor.lidars) {
    add_sweeps(lidar, scene, patch, samples, exposures);
  }
  std::stable_sort(exposures.begin(), exposures.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return exposures;
}

}  // namespace avoidbench
