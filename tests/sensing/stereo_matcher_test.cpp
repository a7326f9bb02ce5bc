// What the stereo sensors make of a matcher's disparities: which ones are valid.
#include "sensing/stereo_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.hpp"

namespace avoidbench {
namespace {

/// Of a pair without texture, where 0 px is the least of equally good disparities.
std::vector<float> bland_disparities(bool subpixel) {
  CameraSpec sensor;
  sensor.width_px = 90;
  sensor.height_px = 40;
  sensor.method = StereoSgmSpec{.disparities = 64, .subpixel = subpixel};
  const std::vector<std::uint8_t> grey(90 * 40, 77);
  std::vector<float> disparity_px(grey.size(), 1.0F);
  make_stereo_matcher(sensor)->match(grey, grey, disparity_px);
  return disparity_px;
}

TEST(StereoMatcher, NoWholePixelIsInvalidAsInTheOriginalButNoSubpixelIsFarAway) {
  const std::vector<float> whole = bland_disparities(false), fine = bland_disparities(true);
  EXPECT_TRUE(std::all_of(whole.begin(), whole.end(), [](float d) { return std::isnan(d); }));
  EXPECT_EQ(std::count(fine.begin(), fine.end(), 0.0F), 90 * 40);
}

/// Disparities of a textured wall, 4 px, with a square of 20 px before it, `side_px` wide.
std::vector<float> square_disparities(int side_px, std::int64_t speckle_window_px) {
  constexpr int kWidth_px = 160, kHeight_px = 80;
  CameraSpec sensor;
  sensor.width_px = kWidth_px;
  sensor.height_px = kHeight_px;
  sensor.method = StereoSgmSpec{.window = CensusWindow::five_by_five,
                                .disparities = 64,
                                .p1 = 5,
                                .p2 = 32,
                                .subpixel = true,
                                .speckle_window_px = speckle_window_px,
                                .left_right_px = -1};
  RandomStream random(21);
  std::vector<std::uint8_t> right(kWidth_px * kHeight_px), left(right.size());
  for (std::uint8_t& value : right) value = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      const bool is_square = x >= 80 && x < 80 + side_px && y >= 40 && y < 40 + side_px;
      const int from = std::max(0, x - (is_square ? 20 : 4));
      left[static_cast<std::size_t>(y * kWidth_px + x)] =
          right[static_cast<std::size_t>(y * kWidth_px + from)];
    }
  }
  std::vector<float> disparity_px(left.size());
  make_stereo_matcher(sensor)->match(left, right, disparity_px);
  return disparity_px;
}

TEST(StereoMatcher, PatchesUpToTheSpeckleWindowAreInvalid) {
  const auto inside = [](const std::vector<float>& disparity_px, int side_px) {
    const int at = 80 + side_px / 2 + (40 + side_px / 2) * 160;
    return disparity_px[static_cast<std::size_t>(at)];
  };
  // 20 × 20 pixels are at most 600, with what the window blurs; 30 × 30 are not.
  EXPECT_NEAR(inside(square_disparities(20, 0), 20), 20.0, 0.125);
  EXPECT_TRUE(std::isnan(inside(square_disparities(20, 600), 20)));
  EXPECT_NEAR(inside(square_disparities(30, 600), 30), 20.0, 0.125);
}

TEST(StereoMatcher, SgbmMatchesNothingLeftOfTheRightImage) {
  constexpr int kWidth_px = 160, kHeight_px = 80, kDisparity_px = 8;
  CameraSpec sensor;
  sensor.width_px = kWidth_px;
  sensor.height_px = kHeight_px;
  sensor.method = StereoSgbmSpec{.speckle_window_px = 0};
  RandomStream random(22);
  std::vector<std::uint8_t> right(kWidth_px * kHeight_px), left(right.size());
  for (std::uint8_t& value : right) value = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * kWidth_px + x); };
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      // What the right eye does not see looks as its first column, which the border repeats.
      left[at(x, y)] = right[at(std::max(0, x - kDisparity_px), y)];
    }
  }
  std::vector<float> disparity_px(left.size());
  make_stereo_matcher(sensor)->match(left, right, disparity_px);
  int first_count = 0;
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kDisparity_px; ++x) {
      const float disparity = disparity_px[at(x, y)];
      EXPECT_FALSE(disparity > static_cast<float>(x) + 0.5F) << x << ", " << y;
    }
    first_count += std::abs(disparity_px[at(kDisparity_px, y)] - kDisparity_px) < 0.5F ? 1 : 0;
  }
  EXPECT_GT(first_count, kHeight_px / 2) << "the first column with a partner";
}

}  // namespace
}  // namespace avoidbench
