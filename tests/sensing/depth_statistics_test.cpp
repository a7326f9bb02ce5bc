#include "sensing/depth_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace avoidbench {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kAt1m_px = 20.0;

float depth_of(double disparity_px) { return static_cast<float>(kAt1m_px / disparity_px); }

std::string edges(const std::vector<float>& truth_m, int width_px, int edge_px) {
  std::vector<DepthSample> samples;
  add_samples(truth_m, truth_m, width_px, kAt1m_px, edge_px, samples);
  std::string marks;
  for (const DepthSample& sample : samples) marks += sample.is_edge ? 'e' : '-';
  return marks;
}

TEST(DepthStatistics, EdgesAreWithinReachOfAStepOfMoreThanTwoPixels) {
  const float near = depth_of(7.0), far = depth_of(4.0), slope = depth_of(6.0);
  EXPECT_EQ(edges({near, near, near, near, far, far, far, far}, 8, 2), "--eeee--");
  EXPECT_EQ(edges({near, near, near, near, far, far, far, far}, 8, 1), "---ee---");
  EXPECT_EQ(edges({far, near, near, near}, 4, 3), "eeee");  // cut at the image's edges
  EXPECT_EQ(edges({near, slope, far, far}, 4, 1), "----");  // of 1 and of 2 px
  EXPECT_EQ(edges({near, near, far, far, far, far, far, far}, 2, 1), "eeee----");  // along a column
  // No return is no sample, and a step beside what is near.
  EXPECT_EQ(edges({near, near, near, kNothing}, 4, 2), "-ee");
}

TEST(DepthStatistics, AreThoseOfTheSamplesInRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto sample = [](double truth_px, double measured_px) {
    return DepthSample{.truth_m = depth_of(truth_px), .measured_m = depth_of(measured_px)};
  };
  std::vector<DepthSample> samples{sample(4.0, 4.5), sample(4.0, 3.9), sample(4.0, 5.5)};
  samples.push_back({.truth_m = 5.0F, .measured_m = nan});
  samples.push_back({.truth_m = 5.0F, .measured_m = kNothing});
  samples.push_back({.truth_m = 5.0F, .measured_m = 4.0F, .is_edge = true});
  samples.push_back({.truth_m = 10.0F, .measured_m = 10.0F});  // out of range
  samples.push_back({.truth_m = 1.0F, .measured_m = 1.0F});
  const DepthStatistics s = depth_statistics(samples, false, 2.0, 10.0, kAt1m_px);
  EXPECT_EQ(s.pixel_count, 5U);
  EXPECT_DOUBLE_EQ(s.valid_ratio, 4.0 / 5.0);
  EXPECT_DOUBLE_EQ(s.outlier_ratio, 1.0 / 3.0);
  EXPECT_NEAR(s.disparity_bias_px, 0.2, 1e-6);
  EXPECT_NEAR(s.disparity_sigma_px, 0.3, 1e-6);
  const double error_1_m = kAt1m_px / 4.5 - 5.0, error_2_m = kAt1m_px / 3.9 - 5.0;
  EXPECT_NEAR(s.depth_sigma_m, 0.5 * (error_2_m - error_1_m), 1e-6);
  EXPECT_NEAR(s.expected_depth_sigma_m, 25.0 / kAt1m_px * 0.3, 1e-6);
  EXPECT_EQ(depth_statistics(samples, true, 2.0, 10.0, kAt1m_px).pixel_count, 1U);
  EXPECT_EQ(depth_statistics(samples, false, 1.0, 2.0, kAt1m_px).pixel_count, 1U);
  EXPECT_TRUE(std::isnan(depth_statistics(samples, false, 20.0, 30.0, kAt1m_px).valid_ratio));
}

TEST(DepthStatistics, SizeOfErrorsIsWhereTheirCorrelationHalves) {
  // Errors alike in runs of n pixels, of alternating sign: by triangles, half at lag n / 4.
  for (const int run : {8, 16}) {
    constexpr int kRow_px = 320;
    std::vector<float> truth, measured;
    for (int i = 0; i < 4 * kRow_px; ++i) {
      truth.push_back(depth_of(4.0));
      measured.push_back(depth_of(i / run % 2 == 0 ? 4.25 : 3.75));
    }
    measured[5] = kNothing;         // says nothing
    measured[50] = depth_of(20.0);  // an outlier
    EXPECT_NEAR(error_size_px(truth, measured, kRow_px, kAt1m_px), run / 4.0, 0.2) << run;
  }
}

TEST(DepthStatistics, FatteningIsWhatTheNearSideTakesOfTheFar) {
  const float near = depth_of(12.0), far = depth_of(4.0);
  const std::vector<float> truth{near, near, near, near, far, far, far, far};
  std::vector<float> measured = truth;
  EXPECT_EQ(fattening_px(truth, measured, 8, kAt1m_px, 3), 0.0);
  measured[4] = measured[5] = near;
  EXPECT_EQ(fattening_px(truth, measured, 8, kAt1m_px, 3), 2.0);
  EXPECT_EQ(fattening_px(truth, measured, 8, kAt1m_px, 1), 1.0);
  // Not where the near side itself was missed, nor at the left side of near things.
  measured[3] = far;
  EXPECT_TRUE(std::isnan(fattening_px(truth, measured, 8, kAt1m_px, 3)));
  const std::vector<float> left(truth.rbegin(), truth.rend());
  EXPECT_TRUE(std::isnan(fattening_px(left, left, 8, kAt1m_px, 3)));
}

}  // namespace
}  // namespace avoidbench
