// Which disparities of 0 px the stereo sensors take for valid.
#include "sensing/stereo_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace avoidbench {
namespace {

/// Of a pair without texture, where 0 px is the least of equally good disparities.
std::vector<float> bland_disparities(bool subpixel) {
  CameraSpec sensor;
  sensor.width_px = 90;
  sensor.height_px = 40;
  sensor.method = StereoCensusSpec{.disparities = 64, .subpixel = subpixel};
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

}  // namespace
}  // namespace avoidbench
