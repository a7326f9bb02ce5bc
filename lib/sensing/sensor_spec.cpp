#include "sensing/sensor_spec.hpp"

namespace avoidbench {

Pinhole sensor_camera(const SensorSpec& sensor) {
  Pinhole camera = make_pinhole(static_cast<std::int32_t>(sensor.width_px),
                                static_cast<std::int32_t>(sensor.height_px),
                                sensor.fov_x_deg * math::kDegree, sensor.max_range_m);
  camera.min_range_m = sensor.min_range_m;
  return camera;
}

Pose T_body_camera(const SensorSpec& sensor) {
  const double sine = math::sin(sensor.pitch_deg * math::kDegree);
  const double cosine = math::cos(sensor.pitch_deg * math::kDegree);
  Pose pose = Pose::Identity();
  pose.linear().col(0) = Eigen::Vector3d(0.0, -1.0, 0.0);       // right
  pose.linear().col(1) = Eigen::Vector3d(-sine, 0.0, -cosine);  // down
  pose.linear().col(2) = Eigen::Vector3d(cosine, 0.0, -sine);   // forward
  pose.translation() = to_eigen(sensor.position_body_m);
  return pose;
}

}  // namespace avoidbench
