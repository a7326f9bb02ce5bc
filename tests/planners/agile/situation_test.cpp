#include "situation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "avoidbench/planner_eigen.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;

constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A camera of 90° at (1, 2, 3) that looks along the world's y axis, level.
struct DepthCamera {
  explicit DepthCamera(int width = 320, int height = 240, float depth = kNothing)
      : depth_m(std::size_t(width) * std::size_t(height), depth) {
    image.struct_size = sizeof image;
    image.width_px = width;
    image.height_px = height;
    image.fx_px = image.fy_px = 0.5 * width;
    image.cx_px = 0.5 * (width - 1);
    image.cy_px = 0.5 * (height - 1);
    avoidbench::as_vector(image.position_world_m) = Vector3d(1.0, 2.0, 3.0);
    turn(Vector3d::UnitY());
  }
  /// To look along `ahead`, its rows level.
  void turn(const Vector3d& ahead) {
    Eigen::Matrix3d rotation;
    const Vector3d right = ahead.cross(Vector3d::UnitZ()).normalized();
    rotation << right, ahead.cross(right).normalized(), ahead.normalized();
    const Eigen::Quaterniond q(rotation);
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(wxyz), std::end(wxyz), image.q_world_camera);
  }
  float& at(int row, int column) {
    return depth_m[std::size_t(row) * std::size_t(image.width_px) + std::size_t(column)];
  }
  const ab_depth_image& seen() {
    image.depth_m = depth_m.data();
    return image;
  }

  std::vector<float> depth_m;
  ab_depth_image image{};
};

std::uint8_t pixel(const Image& image, int row, int column) {
  return image[std::size_t(row * kImageWidth + column)];
}

/// What it demands of cameras is what the net's image covers, from edge to edge.
TEST(NetImage, IsAsWideAsTheLeastCamera) {
  EXPECT_NEAR(std::tan(0.5 * kFovX_rad), 0.5 * kImageWidth / kFocal_px, 1e-12);
  EXPECT_NEAR(std::tan(0.5 * kFovY_rad), 0.5 * kImageHeight / kFocal_px, 1e-12);
}

TEST(NetImage, HoldsInverseDepthAndNothingWhereNothingIs) {
  EXPECT_EQ(pixel(net_image(DepthCamera(320, 240, 2.0F).seen()), 30, 40), 128);
  EXPECT_EQ(pixel(net_image(DepthCamera(320, 240, 10.0F).seen()), 30, 40), 26);
  EXPECT_EQ(pixel(net_image(DepthCamera(320, 240, 0.3F).seen()), 30, 40), 255);
  EXPECT_EQ(net_image(DepthCamera(320, 240, kNothing).seen()), Image{});
  EXPECT_EQ(net_image(DepthCamera(320, 240, kInvalid).seen()), Image{});
}

/// A pole of one pixel in an image more than three times as wide.
TEST(NetImage, KeepsWhatIsThin) {
  DepthCamera camera;
  for (int row = 0; row < 240; ++row) camera.at(row, 200) = 4.0F;
  const Image image = net_image(camera.seen());
  // Column 200 is 40.5 of 160 px right of the middle: 12.15 of 48.
  const int column = static_cast<int>(std::lround(47.5 + 40.5 * kFocal_px / 160.0));
  for (int row = 0; row < kImageHeight; ++row) {
    for (int x = 0; x < kImageWidth; ++x) {
      ASSERT_EQ(pixel(image, row, x), x == column ? 64 : 0) << row << ", " << x;
    }
  }
}

TEST(NetImage, TakesTheNearestAndPassesInvalidPixelsOver) {
  DepthCamera camera(320, 240, 8.0F);
  camera.at(120, 160) = kInvalid;
  camera.at(120, 161) = 3.0F;
  camera.at(121, 161) = kNothing;
  const Image image = net_image(camera.seen());
  EXPECT_EQ(*std::max_element(image.begin(), image.end()), 85);
  EXPECT_EQ(*std::min_element(image.begin(), image.end()), 32);
}

TEST(NetImage, HasNothingBeyondTheCamerasEdgeAndNoHolesWhereItIsCoarse) {
  DepthCamera wide(320, 100, 5.0F);  // 90° × 35°
  const Image image = net_image(wide.seen());
  EXPECT_EQ(pixel(image, 0, 48), 0);
  EXPECT_EQ(pixel(image, kImageHeight - 1, 48), 0);
  EXPECT_EQ(pixel(image, kImageHeight / 2, 48), 51);
  const Image coarse = net_image(DepthCamera(64, 48, 5.0F).seen());
  EXPECT_EQ(*std::min_element(coarse.begin(), coarse.end()), 51);
}

TEST(ImageFrame, IsLevelWhereTheCameraLooks) {
  DepthCamera camera;
  const ImageFrame level = image_frame(camera.seen());
  EXPECT_NEAR(level.yaw_rad, 1.5707963267948966, 1e-12);
  EXPECT_TRUE(level.up_camera.isApprox(Vector3d(0.0, -1.0, 0.0)));
  camera.turn({0.0, 1.0, -1.0});  // 45° down
  const ImageFrame tilted = image_frame(camera.seen());
  EXPECT_NEAR(tilted.yaw_rad, level.yaw_rad, 1e-12);
  EXPECT_TRUE(tilted.up_camera.isApprox(Vector3d(0.0, -1.0, -1.0).normalized()));
  EXPECT_TRUE(turned_to_world(level, Vector3d::UnitX()).isApprox(Vector3d(Vector3d::UnitY())));
  const Vector3d some(0.3, -1.2, 2.0);
  EXPECT_TRUE(turned_to_frame(level, turned_to_world(level, some)).isApprox(some));
}

TEST(NetInputs, AreWhatTheHeaderSays) {
  DepthCamera camera;
  Situation situation;
  situation.frame = image_frame(camera.seen());
  situation.start = {{1.0, 2.5, 3.0}, {-1.0, 2.0, 0.5}, {0.0, 5.0, 0.0}};
  situation.goal_world = {1.0, 22.5, 3.0};
  situation.desired_speed_mps = 2.0;
  situation.lowest_world = {-3.0, -3.0, 0.0};
  situation.highest_world = {2.0, 43.0, 4.5};
  const Inputs inputs = net_inputs(situation);
  const Inputs expected{0.5F, 0.0F, 0.0F, 1.0F, 0.5F, 0.25F, 0.5F, 0.0F, 0.0F, 0.0F, -1.0F,
                        0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.4F,  1.0F, 0.5F, 1.0F, 1.0F, 0.25F};
  for (std::size_t i = 0; i < inputs.size(); ++i) EXPECT_NEAR(inputs[i], expected[i], 1e-6) << i;
}

}  // namespace
}  // namespace agile
