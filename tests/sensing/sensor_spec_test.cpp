#include "sensing/sensor_spec.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

TEST(SensorSpec, LevelCameraLooksAlongBodyX) {
  const Pose T = T_body_camera({});
  EXPECT_TRUE(T.linear().col(2).isApprox(Eigen::Vector3d::UnitX()));   // forward
  EXPECT_TRUE(T.linear().col(0).isApprox(-Eigen::Vector3d::UnitY()));  // right
  EXPECT_TRUE(T.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ()));  // down
  EXPECT_EQ(T.translation(), Eigen::Vector3d(0.2, 0.0, 0.05));
}

TEST(SensorSpec, PositivePitchLooksDown) {
  MountingSpec mounting;
  mounting.pitch_deg = 90.0;
  EXPECT_TRUE(T_body_camera(mounting).linear().col(2).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
  for (const double pitch_deg : {-60.0, -10.0, 0.0, 25.0, 90.0}) {
    mounting.pitch_deg = pitch_deg;
    const Eigen::Matrix3d R = T_body_camera(mounting).linear();
    EXPECT_TRUE((R.transpose() * R).isIdentity(1e-12));
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
    EXPECT_NEAR(R.col(2).z(), -math::sin(pitch_deg * math::kDegree), 1e-12);
  }
}

TEST(SensorSpec, EdgeRaysSpanTheFieldOfView) {
  SensorSpec sensor;
  sensor.width_px = 200;
  sensor.height_px = 100;
  sensor.fov_x_deg = 70.0;
  const Pinhole camera = sensor_camera(sensor);
  // The image's outer edges are half a pixel beyond the first and last pixel's centres.
  const double left = (-0.5 - camera.cx_px) / camera.fx_px;
  const double right = (199.5 - camera.cx_px) / camera.fx_px;
  EXPECT_NEAR(right, math::tan(35.0 * math::kDegree), 1e-12);
  EXPECT_NEAR(left, -right, 1e-12);
  EXPECT_EQ(camera.fx_px, camera.fy_px);
  EXPECT_EQ(camera.cy_px, 49.5);
  EXPECT_EQ(camera.max_range_m, sensor.max_range_m);
}

TEST(SensorSpec, OneCameraOfARigIsASensorByItself) {
  SensorSpec rig;
  rig.name = "rig";
  MountingSpec left;
  left.yaw_deg = 90.0;
  rig.more_mountings = {left};
  CameraSpec down;
  down.name = "down";
  down.width_px = 64;
  down.mounting.pitch_deg = 90.0;
  rig.more_cameras = {down};
  for (std::size_t i = 0; i < 3; ++i) {
    const SensorSpec one = one_camera(rig, i);
    ASSERT_EQ(rig_cameras(one).size(), 1U);
    EXPECT_EQ(one.mounting.yaw_deg, i == 1 ? 90.0 : 0.0);
    EXPECT_EQ(one.mounting.pitch_deg, i == 2 ? 90.0 : 0.0);
    EXPECT_EQ(one.width_px, i == 2 ? 64 : 320);
    EXPECT_EQ(one.name, i == 2 ? "down" : "rig");
  }
}

}  // namespace
}  // namespace avoidbench
