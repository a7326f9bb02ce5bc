#include "world/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "world/noise.hpp"

namespace avoidbench {
namespace {

TEST(Ground, CoversTheAreaAndItsMarginAndHasItsRelief) {
  const HeightField ground = make_ground(20.0, 30.5, 4.0, 1.5, 7);
  EXPECT_EQ(ground.low_x_m, -4.0);
  EXPECT_EQ(ground.low_y_m, -4.0);
  EXPECT_EQ(ground.columns, 29U);  // corners of 28 cells
  EXPECT_EQ(ground.rows, 40U);     // 38.5 m, rounded up
  ASSERT_EQ(ground.heights_m.size(), std::size_t{29} * 40);
  const auto [low, high] = std::minmax_element(ground.heights_m.begin(), ground.heights_m.end());
  EXPECT_EQ(*low, 0.0F);
  EXPECT_EQ(*high, 1.5F);
}

TEST(Ground, IsTheNoiseAtItsPlaces) {
  const HeightField ground = make_ground(20.0, 20.0, 2.0, 2.0, 9);
  // Heights are the noise's up to offset and scale: ratios of differences are its own.
  const auto noise = [](double x, double y) {
    return fractal_noise(Eigen::Vector3d(x / 17.0, y / 17.0, 0.37), 4, 9);
  };
  const double scale = (ground_height_m(ground, 11.0, 3.0) - ground_height_m(ground, -1.0, 8.0)) /
                       (noise(11.0, 3.0) - noise(-1.0, 8.0));
  EXPECT_GT(scale, 0.0);
  EXPECT_NEAR(ground_height_m(ground, 5.0, 17.0) - ground_height_m(ground, 19.0, 2.0),
              scale * (noise(5.0, 17.0) - noise(19.0, 2.0)), 1e-5);
}

TEST(Ground, TheHeightIsThatOfItsMesh) {
  HeightField ground{
      .low_x_m = -1.0, .low_y_m = 2.0, .cell_m = 2.0, .columns = 3, .rows = 2, .heights_m = {}};
  ground.heights_m = {1.0F, 2.0F, 4.0F, 3.0F, 7.0F, 5.0F};
  const Prototype mesh = ground_prototype(ground);
  ASSERT_EQ(mesh.mesh.triangles.size(), 4U);
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    const auto corner = [&](std::uint32_t i) { return mesh.mesh.vertices[i].cast<double>(); };
    const Eigen::Vector3d inside = 0.5 * corner(a) + 0.2 * corner(b) + 0.3 * corner(c);
    EXPECT_NEAR(ground_height_m(ground, inside.x(), inside.y()), inside.z(), 1e-12);
    EXPECT_GT((corner(b) - corner(a)).cross(corner(c) - corner(a)).z(), 0.0);  // turned upwards
  }
  // Beyond its edge it goes on as there.
  EXPECT_EQ(ground_height_m(ground, -9.0, 2.0), 1.0);
  EXPECT_EQ(ground_height_m(ground, 9.0, 9.0), 5.0);
  EXPECT_EQ(ground_height_m(ground, 3.0, -9.0), 4.0);
  EXPECT_EQ(ground_height_m(HeightField{}, 3.0, 4.0), 0.0);
}

TEST(Noise, IsZeroAtLatticePointsAndHasItsGradientThere) {
  // One of twelve directions to a cube's edges: two parts of ±1 and one of 0; all of them occur.
  std::array<std::array<int, 3>, 3> seen{};  // by axis and part
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d corner(i, -2 * i, i % 7);
    ASSERT_EQ(gradient_noise(corner, 4), 0.0);
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-6;
      const double slope = gradient_noise(corner + kStep * Eigen::Vector3d::Unit(axis), 4) / kStep;
      ASSERT_NEAR(slope, std::round(slope), 1e-4);
      squares += slope * slope;
      const auto part = static_cast<std::size_t>(std::round(slope) + 1.0);
      ASSERT_LT(part, 3U);
      ++seen[static_cast<std::size_t>(axis)][part];
    }
    ASSERT_NEAR(squares, 2.0, 1e-3);
  }
  for (const auto& parts : seen) {
    for (const int count : parts) EXPECT_GT(count, 35);  // a third each, of 200
  }
}

TEST(Noise, IsSmooth) {
  // Across a lattice plane: value and slope go on.
  const Eigen::Vector3d on_plane(3.0, 1.3, 2.6);
  const Eigen::Vector3d step(1e-5, 0.0, 0.0);
  const double here = gradient_noise(on_plane, 8);
  const double slope_before = (here - gradient_noise(on_plane - step, 8)) / 1e-5;
  const double slope_after = (gradient_noise(on_plane + step, 8) - here) / 1e-5;
  EXPECT_NEAR(slope_before, slope_after, 1e-3);
  EXPECT_GT(std::abs(slope_after), 1e-2);
}

TEST(Noise, OctavesHalveInLengthAndHeight) {
  const Eigen::Vector3d point(0.3, 1.7, -2.4);
  EXPECT_EQ(fractal_noise(point, 3, 5), gradient_noise(point, 5) +
                                            gradient_noise(2.0 * point, 6) / 2.0 +
                                            gradient_noise(4.0 * point, 7) / 4.0);
}

}  // namespace
}  // namespace avoidbench
