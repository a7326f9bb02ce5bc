#pragma once

#include "planners/support/kinematic_flight.hpp"
#include "settings.hpp"
#include "surroundings.hpp"

namespace ego {

/// Surroundings in which a course has been seen from `eye_world`, looking along +y, long enough for
/// every visible surface to count. Heights from 0.8 to 3.2 m.
inline Surroundings seen(const avoidbench::kinematic::Course& course,
                         const Eigen::Vector3d& eye_world, const Settings& settings = {}) {
  namespace kinematic = avoidbench::kinematic;
  planning::RollingGridSpec spec = settings.grid;
  spec.pixel_step = 1;
  spec.longest_ray_m = 8.0;
  spec.half_size_m = 8.0;
  Surroundings surroundings{planning::RollingGrid(spec), planning::PathSearch({}), 0.8, 3.2,
                            settings.body_size_m};
  surroundings.search.use_heights(0.8, 3.2);
  surroundings.grid.reset(eye_world);
  avoidbench::CameraSetup camera = kinematic::vehicle_setup().cameras.front();
  camera.width_px = 320;
  camera.height_px = 240;
  camera.fx_px = camera.fy_px = 160.0;
  camera.cx_px = 159.5;
  camera.cy_px = 119.5;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // x right is +x, z forward is +y
  T_world_camera.translation() = eye_world;
  const std::vector<float> depth_m = kinematic::depth_image(course, camera, T_world_camera);
  ab_depth_image image{};
  image.width_px = camera.width_px;
  image.height_px = camera.height_px;
  image.fx_px = image.fy_px = camera.fx_px;
  image.cx_px = camera.cx_px;
  image.cy_px = camera.cy_px;
  for (int i = 0; i < 3; ++i) image.position_world_m[i] = eye_world[i];
  const Eigen::Quaterniond q(T_world_camera.linear());
  image.q_world_camera[0] = q.w();
  image.q_world_camera[1] = q.x();
  image.q_world_camera[2] = q.y();
  image.q_world_camera[3] = q.z();
  image.depth_m = depth_m.data();
  for (int i = 0; i < 3; ++i) surroundings.grid.integrate(image);
  return surroundings;
}

}  // namespace ego
