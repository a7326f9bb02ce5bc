#include "sensing/lidar_spec.hpp"

#include <algorithm>
#include <cmath>

#include "sensing/lidar_scan.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// From -1 to 1 and back while the phase goes from one whole number to the next.
double triangle_wave(double phase) {
  const double part = phase - std::floor(phase);
  return 1.0 - 2.0 * std::abs(2.0 * part - 1.0);
}

Vector3d direction_of(double azimuth_rad, double elevation_rad) {
  const double level = math::cos(elevation_rad);
  return {level * math::cos(azimuth_rad), level * math::sin(azimuth_rad), math::sin(elevation_rad)};
}

Vector3d direction_of(const LidarSpinningSpec& scan, std::int64_t shot) {
  const std::int64_t column = shot / scan.rings, ring = shot % scan.rings;
  const double step =
      static_cast<double>(ring) / static_cast<double>(std::max<std::int64_t>(scan.rings - 1, 1));
  const double elevation_deg =
      scan.lowest_elevation_deg + step * (scan.highest_elevation_deg - scan.lowest_elevation_deg);
  const double turn = static_cast<double>(column) / static_cast<double>(scan.columns);
  return direction_of((turn - 0.5) * math::kTau, elevation_deg * math::kDegree);
}

Vector3d direction_of(const LidarPatternSpec& scan, std::int64_t shot, double time_s) {
  const double lead = static_cast<double>(shot % scan.beams) / static_cast<double>(scan.beams);
  const double middle_deg = 0.5 * (scan.lowest_elevation_deg + scan.highest_elevation_deg);
  const double half_deg = 0.5 * (scan.highest_elevation_deg - scan.lowest_elevation_deg);
  const double nod = triangle_wave(scan.nods_hz * time_s + lead);
  return direction_of(math::wrapped_angle((scan.turns_hz * time_s + lead) * math::kTau),
                      (middle_deg + half_deg * nod) * math::kDegree);
}

/// Velodyne VLP-16 (data sheet 63-9229): 16 beams over 30°, 0.2° of azimuth at 10 turns a second,
/// 100 m, ±3 cm, 903 nm, beams of 3 mrad. The sheet gives no least range nor a range by
/// reflectance: 0.5 m, and half of the greatest at 10 %.
LidarSpec velodyne_16() {
  LidarSpec lidar;
  lidar.range_sigma_m = 0.02;
  lidar.dropout_ratio = 0.002;
  lidar.divergence_mrad = 3.0;
  return lidar;
}

/// Ouster OS0-32 (data sheet, revision 7): 32 beams over 90°, 1,024 columns at 10 turns a second,
/// 35 m at 10 % reflectance, 75 m at most here, from 0.5 m on; beams of 0.35°; precision of 0.8 to
/// 4 cm.
LidarSpec ouster_os0_32() {
  LidarSpec lidar;
  lidar.name = "ouster_os0_32";
  lidar.scan = LidarSpinningSpec{
      .rings = 32, .lowest_elevation_deg = -45.0, .highest_elevation_deg = 45.0, .columns = 1024};
  lidar.max_range_m = 75.0;
  lidar.range_at_10_percent_m = 35.0;
  lidar.range_sigma_m = 0.015;
  lidar.dropout_ratio = 0.002;
  lidar.divergence_mrad = 6.1;
  return lidar;
}

/// Livox Mid-360 (data sheet): 200,000 points a second, sweeps of 0.1 s, 360° × -7° to 52°, 40 m at
/// 10 % and 70 m at 80 % reflectance, from 0.1 m on; errors of ranges up to 2 cm at 10 m, of angles
/// below 0.15°. The maker does not publish the curve: that of LidarPatternSpec covers the view as
/// evenly and repeats as little.
LidarSpec mid360_like() {
  LidarSpec lidar;
  lidar.name = "mid360_like";
  lidar.scan = LidarPatternSpec{};
  lidar.min_range_m = 0.1;
  lidar.max_range_m = 70.0;
  lidar.range_at_10_percent_m = 40.0;
  lidar.range_sigma_m = 0.02;
  lidar.angle_sigma_deg = 0.1;
  lidar.dropout_ratio = 0.002;
  return lidar;
}

}  // namespace

std::vector<LidarSpec> lidar_presets() { return {velodyne_16(), ouster_os0_32(), mid360_like()}; }

Pose T_body_lidar(const MountingSpec& mounting) {
  // A camera looks along its z axis with x to the right and y down.
  Eigen::Matrix3d R_camera_lidar;
  R_camera_lidar << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
  Pose pose = T_body_camera(mounting);
  pose.linear() = pose.linear() * R_camera_lidar;
  return pose;
}

std::int64_t shots_per_sweep(const LidarSpec& lidar) {
  if (const auto* spinning = std::get_if<LidarSpinningSpec>(&lidar.scan)) {
    return spinning->rings * spinning->columns;
  }
  const double shots = std::get<LidarPatternSpec>(lidar.scan).points_per_s / lidar.rate_hz;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(shots)));
}

std::array<double, 2> elevations_rad(const LidarSpec& lidar) {
  return std::visit(
      [](const auto& scan) {
        return std::array<double, 2>{scan.lowest_elevation_deg * math::kDegree,
                                     scan.highest_elevation_deg * math::kDegree};
      },
      lidar.scan);
}

Vector3d shot_direction(const LidarSpec& lidar, std::int64_t sweep, std::int64_t shot) {
  if (const auto* spinning = std::get_if<LidarSpinningSpec>(&lidar.scan)) {
    return direction_of(*spinning, shot);
  }
  const auto shots = static_cast<double>(shots_per_sweep(lidar));
  const double sweeps = static_cast<double>(sweep) + static_cast<double>(shot + 1) / shots;
  return direction_of(std::get<LidarPatternSpec>(lidar.scan), shot, sweeps / lidar.rate_hz);
}

bool repeats(const LidarScan& scan) { return std::holds_alternative<LidarSpinningSpec>(scan); }

double reflectance(Material material) {
  switch (material) {
    case Material::soil:
      return 0.3;
    case Material::bark:
      return 0.35;
    case Material::leaf:
      return 0.5;
    case Material::brick:
      return 0.4;
    case Material::concrete:
      return 0.35;
    case Material::painted_metal:
      return 0.5;
    case Material::lamp:
      return 0.6;
  }
  return 0.0;
}

}  // namespace avoidbench
