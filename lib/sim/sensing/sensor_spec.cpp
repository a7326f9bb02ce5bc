#include "sensing/sensor_spec.hpp"

#include "base/check.hpp"

namespace avoidbench {
namespace {

Eigen::Matrix3d rotation(double angle_rad, const Eigen::Vector3d& axis) {
  // By our own sine: Eigen's AngleAxis asks the C library.
  const double c = math::cos(angle_rad), s = math::sin(angle_rad);
  const Eigen::Matrix3d cross{
      {0.0, -axis.z(), axis.y()}, {axis.z(), 0.0, -axis.x()}, {-axis.y(), axis.x(), 0.0}};
  // Rodrigues' formula.
  return Eigen::Matrix3d::Identity() + s * cross + (1.0 - c) * cross * cross;
}

}  // namespace

std::vector<CameraSpec> camera_kinds(const SensorSpec& sensor) {
  std::vector<CameraSpec> kinds{sensor};
  kinds.insert(kinds.end(), sensor.more_cameras.begin(), sensor.more_cameras.end());
  std::erase_if(kinds, [](const CameraSpec& kind) {
    return std::holds_alternative<NoCameraSpec>(kind.method);
  });
  return kinds;
}

Pinhole sensor_camera(const CameraSpec& camera) {
  Pinhole pinhole = make_pinhole(static_cast<std::int32_t>(camera.width_px),
                                 static_cast<std::int32_t>(camera.height_px),
                                 camera.fov_x_deg * math::kDegree, camera.max_range_m);
  pinhole.min_range_m = camera.min_range_m;
  return pinhole;
}

Pose T_body_camera(const MountingSpec& mounting) {
  const double sine = math::sin(mounting.pitch_deg * math::kDegree);
  const double cosine = math::cos(mounting.pitch_deg * math::kDegree);
  // Columns are the camera's axes in the body frame; a positive pitch looks down.
  Eigen::Matrix3d pitched;
  pitched.col(0) = Eigen::Vector3d(0.0, -1.0, 0.0);       // right
  pitched.col(1) = Eigen::Vector3d(-sine, 0.0, -cosine);  // down
  pitched.col(2) = Eigen::Vector3d(cosine, 0.0, -sine);   // forward
  Pose pose = Pose::Identity();
  pose.linear() = pitched;
  // Roll about the camera's own axis; below, yaw about the body's vertical.
  if (mounting.roll_deg != 0.0) {
    pose.linear() *= rotation(mounting.roll_deg * math::kDegree, Eigen::Vector3d::UnitZ());
  }
  if (mounting.yaw_deg != 0.0) {
    pose.linear() =
        rotation(mounting.yaw_deg * math::kDegree, Eigen::Vector3d::UnitZ()) * pose.linear();
  }
  pose.translation() = to_eigen(mounting.position_body_m);
  return pose;
}

std::vector<MountingSpec> mountings(const CameraSpec& camera) {
  std::vector<MountingSpec> all{camera.mounting};
  all.insert(all.end(), camera.more_mountings.begin(), camera.more_mountings.end());
  return all;
}

std::vector<RigCamera> rig_cameras(const SensorSpec& sensor) {
  std::vector<RigCamera> all;
  for (const CameraSpec& kind : camera_kinds(sensor)) {
    for (const MountingSpec& mounting : mountings(kind)) all.push_back({kind, mounting});
  }
  return all;
}

SensorSpec one_camera(const SensorSpec& rig, std::size_t index) {
  const std::vector<RigCamera> cameras = rig_cameras(rig);
  AB_CHECK(index < cameras.size(), index, cameras.size());
  SensorSpec sensor{cameras[index].kind, {}, rig.lidars};
  sensor.mounting = cameras[index].mounting;
  sensor.more_mountings.clear();
  return sensor;
}

bool is_stereo(const CameraSpec& camera) {
  return std::holds_alternative<StereoSgbmSpec>(camera.method) ||
         std::holds_alternative<StereoSgmSpec>(camera.method);
}

double disparity_at_1m_px(const CameraSpec& camera) {
  return sensor_camera(camera).fx_px * camera.baseline_m;
}

}  // namespace avoidbench
