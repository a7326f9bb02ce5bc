#include "wind/turbulence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <vector>

#include "base/digest.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Of sampling period d in time constants, of all three filters.
DrydenFilter filter_of(double d) { return make_dryden({1, 1, 1}, 1.0, d); }

Matrix2d transition(const LateralFilter& filter) {
  Matrix2d F;
  F << filter.keep, 0, filter.feed, filter.keep;
  return F;
}

TEST(Dryden, SampledFiltersKeepTheStationaryCovarianceForAnyPeriod) {
  Matrix2d stationary_covariance;
  stationary_covariance << 0.5, 0.25, 0.25, 0.25;
  const Vector2d output(std::sqrt(3.0), 1 - std::sqrt(3.0));
  EXPECT_NEAR(output.dot(stationary_covariance * output), 1.0, 1e-15);
  for (const double d : {1e-6, 1e-4, 1e-3, 0.02, 0.3, 0.99, 1.01, 3.0, 40.0}) {
    const DrydenFilter filter = filter_of(d);
    EXPECT_NEAR(filter.keep_u * filter.keep_u + filter.noise_u * filter.noise_u, 1.0, 1e-14) << d;
    const LateralFilter& lateral = filter.lateral[0];
    Matrix2d L;
    L << lateral.noise_11, 0, lateral.noise_21, lateral.noise_22;
    const Matrix2d F = transition(lateral);
    const Matrix2d after = F * stationary_covariance * F.transpose() + L * L.transpose();
    EXPECT_LT((after - stationary_covariance).cwiseAbs().maxCoeff(), 1e-14) << d;
    // The noise of a short step is tiny but not lost: d³/3 in the second state.
    if (d < 1e-3) {
      EXPECT_NEAR((L * L.transpose())(1, 1) / (d * d * d / 3), 1.0, 2 * d) << d;
    }
  }
}

TEST(Dryden, AutocorrelationOfTheFiltersIsDrydens) {
  const Vector2d output(std::sqrt(3.0), 1 - std::sqrt(3.0));
  Matrix2d covariance;
  covariance << 0.5, 0.25, 0.25, 0.25;
  const DrydenFilter filter = filter_of(0.05);
  Matrix2d lagged = covariance;
  double u = 1.0;
  for (int k = 1; k <= 200; ++k) {
    lagged = transition(filter.lateral[1]) * lagged;
    u *= filter.keep_u;
    const double tau = 0.05 * k;
    EXPECT_NEAR(output.dot(lagged * output), std::exp(-tau) * (1 - 0.5 * tau), 1e-13);
    EXPECT_NEAR(u, std::exp(-tau), 1e-13);
  }
}

std::vector<Eigen::Vector3d> samples(std::size_t count, double d, std::uint64_t seed) {
  RandomStream random(seed);
  const DrydenFilter filter = filter_of(d);
  DrydenState state = stationary(random);
  std::vector<Eigen::Vector3d> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(unit_velocity(state));
    advance(state, filter, random);
  }
  return values;
}

TEST(Dryden, DrawnVarianceAndAutocorrelationAreTheClosedForms) {
  constexpr std::size_t kCount = 2'000'000;
  constexpr double kStep = 0.05;
  const auto values = samples(kCount, kStep, 3);
  // kCount kStep / 2 = 50000 independent values: one standard error is 0.6 %.
  for (int axis = 0; axis < 3; ++axis) {
    double mean = 0.0;
    for (const auto& v : values) mean += v[axis] / kCount;
    EXPECT_NEAR(mean, 0.0, 0.02) << axis;
    for (const std::size_t lag : {0U, 5U, 10U, 20U, 40U, 80U}) {
      double product = 0.0;
      for (std::size_t i = lag; i < kCount; ++i) product += values[i][axis] * values[i - lag][axis];
      product /= static_cast<double>(kCount - lag);
      const double tau = kStep * static_cast<double>(lag);
      const double exact = std::exp(-tau) * (axis == 0 ? 1.0 : 1.0 - 0.5 * tau);
      EXPECT_NEAR(product, exact, 0.025) << axis << ' ' << tau;
    }
  }
  double across = 0.0, upwards = 0.0;
  for (const auto& v : values) across += v.x() * v.y() / kCount, upwards += v.y() * v.z() / kCount;
  EXPECT_NEAR(across, 0.0, 0.02);
  EXPECT_NEAR(upwards, 0.0, 0.02);
}

TEST(Dryden, SpectraAreDrydens) {
  constexpr double kStep = 0.05;
  constexpr std::size_t kLength = 4096, kSegments = 400;
  const auto values = samples(kLength * kSegments, kStep, 5);
  const double duration = kStep * kLength;
  for (const std::size_t bin : {16U, 33U, 98U, 326U}) {
    const double w = 2 * M_PI * static_cast<double>(bin) / duration;
    Eigen::Vector3d power = Eigen::Vector3d::Zero();
    for (std::size_t s = 0; s < kSegments; ++s) {
      std::complex<double> sum[3] = {};
      const std::complex<double> turn = std::polar(1.0, -w * kStep);
      std::complex<double> phase = 1.0;
      for (std::size_t i = 0; i < kLength; ++i, phase *= turn) {
        for (int axis = 0; axis < 3; ++axis) sum[axis] += phase * values[s * kLength + i][axis];
      }
      for (int axis = 0; axis < 3; ++axis) {
        power[axis] += std::norm(sum[axis]) * kStep * kStep / (duration * kSegments);
      }
    }
    // Two-sided, per rad/s times 2 pi: |H|²
    const double u = 2 / (1 + w * w);
    const double v = (1 + 3 * w * w) / ((1 + w * w) * (1 + w * w));
    EXPECT_NEAR(power[0] / u, 1.0, 0.2) << w;  // one standard error is 5 %
    EXPECT_NEAR(power[1] / v, 1.0, 0.2) << w;
    EXPECT_NEAR(power[2] / v, 1.0, 0.2) << w;
  }
}

TEST(Dryden, ScalesAreThoseOfTheStandard) {
  TurbulenceSpec spec;
  EXPECT_EQ(turbulence_scales(spec).sigma_mps, (std::array<double, 3>{0, 0, 0}));
  spec.model = TurbulenceModel::mil_f_8785c;
  spec.wind_6m_mps = 7.716667;                           // 15 kn: light
  const TurbulenceScales low = turbulence_scales(spec);  // at 10 ft
  EXPECT_NEAR(low.sigma_mps[2], 0.7717, 1e-4);
  EXPECT_NEAR(low.sigma_mps[0] / low.sigma_mps[2], std::pow(0.18523, -0.4), 1e-9);
  EXPECT_EQ(low.sigma_mps[0], low.sigma_mps[1]);
  EXPECT_NEAR(low.length_m[0], 3.048 * std::pow(0.18523, -1.2), 1e-9);
  EXPECT_NEAR(low.length_m[2], 3.048, 1e-12);
  spec.height_m = 304.8;  // 1000 ft: the model becomes isotropic
  const TurbulenceScales high = turbulence_scales(spec);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(high.sigma_mps[static_cast<std::size_t>(axis)], 0.7717, 1e-4);
    EXPECT_NEAR(high.length_m[static_cast<std::size_t>(axis)], 304.8, 1e-9);
  }
  spec.model = TurbulenceModel::given;
  EXPECT_EQ(turbulence_scales(spec).length_m, spec.length_m);
}

std::string digest_of(std::uint64_t seed) {
  Digest digest;
  for (const Eigen::Vector3d& v : samples(10000, 0.01, seed)) {
    for (int axis = 0; axis < 3; ++axis) digest.add(v[axis]);
  }
  return digest.hex().substr(0, 16);
}

TEST(Dryden, TheSameBitsForASeedOnAnyMachine) {
  EXPECT_EQ(digest_of(1), "70dc6fd06b13ebe1");
  EXPECT_NE(digest_of(2), digest_of(1));
}

}  // namespace
}  // namespace avoidbench
