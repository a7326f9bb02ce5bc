/* Helpers for what planners see, C++17: the newest image or sweep, and places in the world.
 * Header-only, needs only the standard library; planner.hpp includes it.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_VIEWS_HPP
#define AVOIDBENCH_VIEWS_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "avoidbench/canvas.hpp"
#include "avoidbench/planner.h"

namespace avoidbench {

/// The newest depth image, stereo pair or colour picture of one camera since the last call, or null
/// if there is no new one. `camera`: index into ab_setup.cameras; 0 with AB_INPUT_ONE_CAMERA.
inline const ab_depth_image* newest_depth(const ab_observation& seen, std::uint32_t camera) {
  std::uint32_t i = 0;
  while (i < seen.depth_count && seen.depth[i]->camera != camera) ++i;
  return i < seen.depth_count ? seen.depth[i] : nullptr;
}
inline const ab_stereo_pair* newest_stereo(const ab_observation& seen, std::uint32_t camera) {
  std::uint32_t i = 0;
  while (i < seen.stereo_count && seen.stereo[i]->left->camera != camera) ++i;
  return i < seen.stereo_count ? seen.stereo[i] : nullptr;
}
inline const ab_picture* newest_color(const ab_observation& seen, std::uint32_t camera) {
  std::uint32_t i = 0;
  while (i < seen.color_count && seen.color[i]->camera != camera) ++i;
  return i < seen.color_count ? seen.color[i] : nullptr;
}

/// The newest sweep of one lidar since the last call, or null if there is no new one. `lidar`:
/// index into ab_setup.lidars.
inline const ab_cloud* newest_cloud(const ab_observation& seen, std::uint32_t lidar) {
  std::uint32_t i = 0;
  while (i < seen.cloud_count && seen.clouds[i]->lidar != lidar) ++i;
  return i < seen.cloud_count ? seen.clouds[i] : nullptr;
}

/// `v` rotated by the unit quaternion `q_a_b` (w, x, y, z): coordinates in b to coordinates in a.
inline Vec3 rotated(const double (&q_a_b)[4], const Vec3& v) {
  const double w = q_a_b[0], x = q_a_b[1], y = q_a_b[2], z = q_a_b[3];
  const Vec3 t{2.0 * (y * v[2] - z * v[1]), 2.0 * (z * v[0] - x * v[2]),
               2.0 * (x * v[1] - y * v[0])};
  return {v[0] + w * t[0] + (y * t[2] - z * t[1]), v[1] + w * t[1] + (z * t[0] - x * t[2]),
          v[2] + w * t[2] + (x * t[1] - y * t[0])};
}

/// The world point that pixel (column, row) shows at `depth_m` along camera z.
inline Vec3 pixel_in_world(const ab_depth_image& image, double column_px, double row_px,
                           double depth_m) {
  const Vec3 in_camera{(column_px - image.cx_px) / image.fx_px * depth_m,
                       (row_px - image.cy_px) / image.fy_px * depth_m, depth_m};
  const Vec3 turned = rotated(image.q_world_camera, in_camera);
  return {turned[0] + image.position_world_m[0], turned[1] + image.position_world_m[1],
          turned[2] + image.position_world_m[2]};
}

/// The world point that a point of a de-skewed sweep shows. For other sweeps it holds only for the
/// last points: the lidar was elsewhere when it saw the first ones.
inline Vec3 point_in_world(const ab_cloud& cloud, const ab_lidar_point& point) {
  const Vec3 turned =
      rotated(cloud.q_world_lidar, {static_cast<double>(point.position_lidar_m[0]),
                                    static_cast<double>(point.position_lidar_m[1]),
                                    static_cast<double>(point.position_lidar_m[2])});
  return {turned[0] + cloud.position_world_m[0], turned[1] + cloud.position_world_m[1],
          turned[2] + cloud.position_world_m[2]};
}

/// The direction in the world, a unit vector, of shot `index` of those without a return.
inline Vec3 miss_in_world(const ab_cloud& cloud, std::uint32_t index) {
  const float* const miss = cloud.misses_lidar + 3 * static_cast<std::size_t>(index);
  return rotated(cloud.q_world_lidar, {static_cast<double>(miss[0]), static_cast<double>(miss[1]),
                                       static_cast<double>(miss[2])});
}

}  // namespace avoidbench

#endif
