#include "sensing/depth_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "sensing/depth_statistics.hpp"

namespace avoidbench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kWidth = 400, kHeight = 300;
constexpr NoisyDepthView kView{kWidth, kHeight, 20.0, 0.1, 15.0};

/// No noise at all.
DepthNoisySpec quiet() {
  DepthNoisySpec spec;
  spec.disparity_sigma_px = spec.bland_disparity_sigma_px = spec.disparity_step_px = 0.0;
  spec.outlier_ratio = spec.bland_outlier_ratio = 0.0;
  spec.hole_ratio = spec.bland_hole_ratio = spec.dropout_ratio = 0.0;
  spec.half_occlusion_ratio = 0.0;
  spec.fattening_px = 0;
  return spec;
}

std::vector<float> made_noisy(const DepthNoisySpec& spec, std::vector<float> depth_m,
                              float opacity = 1.0F, std::uint64_t seed = 1) {
  DepthNoise noise(spec);
  RandomStream random(seed);
  const std::vector<std::uint32_t> surfaces(depth_m.size(), 0);
  const std::vector<float> opacities{opacity};
  noise.apply(kView, {surfaces, opacities}, random, depth_m);
  return depth_m;
}

std::vector<float> plane(float depth_m) { return std::vector<float>(kWidth * kHeight, depth_m); }

/// Far at the left and right, near in columns [150, 250).
std::vector<float> pillar(float near_m, float far_m) {
  std::vector<float> depth_m = plane(far_m);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (i % kWidth >= 150 && i % kWidth < 250) depth_m[i] = near_m;
  }
  return depth_m;
}

/// Right of the strip that the right eye does not see.
bool is_seen_by_both(std::size_t i, float depth_m) {
  return static_cast<float>(i % kWidth) > 20.0F / depth_m;
}

double nan_share(const std::vector<float>& depth_m, float truth_m) {
  double count = 0.0, nans = 0.0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (!is_seen_by_both(i, truth_m)) continue;
    count += 1.0;
    nans += std::isnan(depth_m[i]) ? 1.0 : 0.0;
  }
  return nans / count;
}

TEST(DepthNoise, QuietOneLeavesDepthAsItIs) {
  const std::vector<float> depth_m = made_noisy(quiet(), pillar(2.0F, 8.0F));
  const std::vector<float> truth_m = pillar(2.0F, 8.0F);
  ASSERT_EQ(depth_m.size(), truth_m.size());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (!is_seen_by_both(i, truth_m[i])) continue;
    EXPECT_NEAR(depth_m[i], truth_m[i], 1e-5F);
    ++seen;
  }
  EXPECT_GT(seen, depth_m.size() / 2);
}

TEST(DepthNoise, DisparityHasItsStandardDeviationAndDepthThatTimesZ2OverBf) {
  for (const double sigma_px : {0.1, 0.4}) {
    for (const double size_px : {1.0, 6.0}) {
      DepthNoisySpec spec = quiet();
      spec.disparity_sigma_px = sigma_px;
      spec.noise_size_px = size_px;
      for (const float truth_m : {2.0F, 6.0F}) {
        std::vector<DepthSample> samples;
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
          const auto depth_m = made_noisy(spec, plane(truth_m), 1.0F, seed);
          for (std::size_t i = 0; i < depth_m.size(); ++i) {
            if (is_seen_by_both(i, truth_m)) samples.push_back({truth_m, depth_m[i], false});
          }
        }
        const DepthStatistics seen = depth_statistics(samples, false, 0.0, 15.0, 20.0);
        // Errors beyond 1 px are not counted: 1.2 % of a sigma of 0.4 px.
        EXPECT_NEAR(seen.disparity_sigma_px, sigma_px, 0.06 * sigma_px);
        EXPECT_NEAR(seen.disparity_bias_px, 0.0, 0.05 * sigma_px);
        if (sigma_px < 0.2) {
          EXPECT_NEAR(seen.depth_sigma_m,
                      sigma_px * std::pow(static_cast<double>(truth_m), 2.0) / 20.0,
                      0.06 * seen.depth_sigma_m);
        }
      }
    }
  }
}

TEST(DepthNoise, DisparityIsAWholeMultipleOfItsStep) {
  DepthNoisySpec spec = quiet();
  spec.disparity_sigma_px = 0.3;
  spec.disparity_step_px = 0.25;
  std::set<double> values;
  for (const float depth_m : made_noisy(spec, plane(4.0F))) {
    if (!std::isfinite(depth_m)) continue;
    const double steps = 20.0 / static_cast<double>(depth_m) / 0.25;
    EXPECT_NEAR(steps, std::round(steps), 1e-4);
    values.insert(std::round(steps));
  }
  EXPECT_GT(values.size(), 4U);
}

TEST(DepthNoise, HolesAndDropoutsHaveTheirShares) {
  DepthNoisySpec spec = quiet();
  spec.hole_ratio = 0.1;
  spec.bland_hole_ratio = 0.5;
  const auto share = [&](float opacity) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      sum += 0.1 * nan_share(made_noisy(spec, plane(5.0F), opacity, seed), 5.0F);
    }
    return sum;
  };
  EXPECT_NEAR(share(1.0F), 0.1, 0.015);
  EXPECT_NEAR(share(0.5F), 0.2, 0.02);  // the lack of texture squared: 0.1 + 0.4 / 4
  EXPECT_NEAR(share(0.0F), 0.5, 0.02);
  spec = quiet();
  spec.dropout_ratio = 0.02;
  EXPECT_NEAR(share(1.0F), 0.02, 0.001);
  spec.dropout_ratio = 1.0;
  EXPECT_EQ(nan_share(made_noisy(spec, plane(5.0F)), 5.0F), 1.0);
}

/// Of ten images of a plane at 1 m.
DepthStatistics statistics_at(const DepthNoisySpec& spec, float opacity) {
  std::vector<DepthSample> samples;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const float depth_m : made_noisy(spec, plane(1.0F), opacity, seed)) {
      if (!std::isnan(depth_m)) samples.push_back({1.0F, depth_m, false});
    }
  }
  return depth_statistics(samples, false, 0.0, 15.0, 20.0);
}

TEST(DepthNoise, OutliersErrByTheirOwnDeviation) {
  DepthNoisySpec spec = quiet();
  spec.outlier_ratio = 0.2;
  spec.outlier_sigma_px = 5.0;
  // Of a deviation of 5 px, 84 % are beyond 1 px.
  EXPECT_NEAR(statistics_at(spec, 1.0F).outlier_ratio, 0.2 * 0.84, 0.02);
}

TEST(DepthNoise, BlandSurfacesHaveTheirOwnHolesOutliersAndErrors) {
  DepthNoisySpec spec = quiet();
  spec.outlier_sigma_px = 5.0;
  spec.hole_ratio = 0.3;
  spec.outlier_ratio = 0.02;
  spec.bland_hole_ratio = 0.05;
  spec.bland_outlier_ratio = 0.2;
  // Of what is no hole.
  EXPECT_NEAR(statistics_at(spec, 1.0F).outlier_ratio, 0.02 * 0.84 / 0.7, 0.006);
  EXPECT_NEAR(statistics_at(spec, 0.0F).outlier_ratio, 0.2 * 0.84 / 0.95, 0.02);
  EXPECT_NEAR(nan_share(made_noisy(spec, plane(5.0F), 0.0F), 5.0F), 0.05, 0.03);
  spec = quiet();
  spec.disparity_sigma_px = 0.1;
  spec.bland_disparity_sigma_px = 0.3;
  EXPECT_NEAR(statistics_at(spec, 1.0F).disparity_sigma_px, 0.1, 0.01);
  EXPECT_NEAR(statistics_at(spec, 0.5F).disparity_sigma_px, 0.15, 0.015);
  EXPECT_NEAR(statistics_at(spec, 0.0F).disparity_sigma_px, 0.3, 0.03);
}

TEST(DepthNoise, NearThingsGrowByTheFattening) {
  DepthNoisySpec spec = quiet();
  spec.fattening_px = 3;
  const std::vector<float> truth_m = pillar(2.0F, 8.0F);
  const std::vector<float> depth_m = made_noisy(spec, truth_m);
  const float* row = &depth_m[100 * kWidth];
  EXPECT_NEAR(row[252], 2.0F, 1e-5F);
  EXPECT_NEAR(row[253], 8.0F, 1e-4F);
  EXPECT_NEAR(row[147], 2.0F, 1e-5F);
  EXPECT_NEAR(row[146], 8.0F, 1e-4F);
  EXPECT_NEAR(fattening_px(truth_m, depth_m, kWidth, 20.0, 8), 3.0, 1e-9);
  // A slope is no step.
  std::vector<float> slope(kWidth * kHeight);
  for (std::size_t i = 0; i < slope.size(); ++i) {
    slope[i] = 20.0F / (30.0F - 0.05F * static_cast<float>(i % kWidth));
  }
  const std::vector<float> same = made_noisy(spec, slope);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    if (!is_seen_by_both(i, slope[i])) continue;
    EXPECT_NEAR(same[i], slope[i], 1e-4F);
    ++seen;
  }
  EXPECT_GT(seen, slope.size() / 2);
}

TEST(DepthNoise, WhatTheRightEyeCannotSeeIsInvalid) {
  DepthNoisySpec spec = quiet();
  spec.half_occlusion_ratio = 1.0;
  const std::vector<float> depth_m = made_noisy(spec, pillar(2.0F, 8.0F));
  // Disparities 10 and 2.5 px: the 7.5 px left of the pillar are hidden from the right eye.
  const float* row = &depth_m[100 * kWidth];
  for (std::size_t x = 143; x < 150; ++x) EXPECT_TRUE(std::isnan(row[x])) << x;
  EXPECT_FALSE(std::isnan(row[141]));
  EXPECT_FALSE(std::isnan(row[150]));
  for (std::size_t x = 250; x < 260; ++x) EXPECT_FALSE(std::isnan(row[x])) << x;
  EXPECT_TRUE(std::isnan(row[1]));  // outside of the right image
}

TEST(DepthNoise, RangesAreKept) {
  DepthNoisySpec spec = quiet();
  EXPECT_EQ(made_noisy(spec, plane(15.1F))[5000], kInfinity);
  EXPECT_EQ(made_noisy(spec, plane(kInfinity))[5000], kInfinity);
  EXPECT_TRUE(std::isnan(made_noisy(spec, plane(0.05F))[5399]));
  EXPECT_NEAR(made_noisy(spec, plane(14.9F))[5000], 14.9F, 1e-4F);
}

TEST(DepthNoise, FollowsFromTheSeedAlone) {
  DepthNoise used{DepthNoisySpec{}};
  const std::vector<std::uint32_t> surfaces(kWidth * kHeight, 0);
  const std::vector<float> textured{1.0F}, bland{0.2F};
  std::vector<float> first = pillar(2.0F, 8.0F), other = plane(3.0F), again = pillar(2.0F, 8.0F);
  RandomStream a(9), b(10), c(9);
  used.apply(kView, {surfaces, textured}, a, first);
  used.apply(kView, {surfaces, bland}, b, other);
  used.apply(kView, {surfaces, textured}, c, again);
  EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(float)), 0);
}

}  // namespace
}  // namespace avoidbench
