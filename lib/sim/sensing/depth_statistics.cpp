#include "sensing/depth_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"

namespace avoidbench {
namespace {

constexpr float kStep_px = 2.0F;  ///< of disparity

/// 0 for infinite depth; NaN stays NaN.
std::vector<float> disparities(std::span<const float> depth_m, double at_1m_px) {
  std::vector<float> result(depth_m.size());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    result[i] = static_cast<float>(at_1m_px) / depth_m[i];
  }
  return result;
}

/// Marks the pixels within `reach` of a step along a line of `count` pixels, `stride` apart.
void mark_edges(const float* disparity, std::size_t count, std::size_t stride, std::size_t reach,
                std::vector<bool>& is_edge, std::size_t first) {
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const float step = disparity[(i + 1) * stride] - disparity[i * stride];
    if (std::abs(step) <= kStep_px) continue;
    const std::size_t from = i + 1 < reach ? 0 : i + 1 - reach;
    const std::size_t to = std::min(i + reach, count - 1);
    for (std::size_t k = from; k <= to; ++k) is_edge[first + k * stride] = true;
  }
}

}  // namespace

void add_samples(std::span<const float> truth_m, std::span<const float> measured_m, int width_px,
                 double disparity_at_1m_px, int edge_px, std::vector<DepthSample>& samples) {
  const auto width = static_cast<std::size_t>(width_px);
  const std::size_t height = truth_m.size() / width;
  const auto reach = static_cast<std::size_t>(edge_px);
  AB_CHECK(truth_m.size() == measured_m.size() && truth_m.size() == width * height);
  const std::vector<float> disparity = disparities(truth_m, disparity_at_1m_px);
  std::vector<bool> is_edge(truth_m.size(), false);
  for (std::size_t y = 0; y < height; ++y) {
    mark_edges(&disparity[y * width], width, 1, reach, is_edge, y * width);
  }
  for (std::size_t x = 0; x < width; ++x) {
    mark_edges(&disparity[x], height, width, reach, is_edge, x);
  }
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    if (std::isfinite(truth_m[i])) samples.push_back({truth_m[i], measured_m[i], is_edge[i]});
  }
}

double error_size_px(std::span<const float> truth_m, std::span<const float> measured_m,
                     int width_px, double disparity_at_1m_px) {
  const auto width = static_cast<std::size_t>(width_px);
  const std::vector<float> truth = disparities(truth_m, disparity_at_1m_px);
  std::vector<float> errors = disparities(measured_m, disparity_at_1m_px);
  double mean = 0.0, count = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i] -= truth[i];
    // Outliers and invalid pixels tell nothing of patches.
    if (!(std::abs(errors[i]) <= 1.0F) || measured_m[i] > 1e9F) {
      errors[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    mean += static_cast<double>(errors[i]);
    count += 1.0;
  }
  mean /= count;
  // Errors alike over more than that are a shift of the whole, not patches.
  constexpr std::size_t kMost = 40;
  double variance = 0.0, last = 1.0;
  // The lag at which the errors' autocorrelation along rows has fallen to one half.
  for (std::size_t lag = 0; lag < std::min(kMost, width); ++lag) {
    double sum = 0.0, pairs = 0.0;
    for (std::size_t i = 0; i + lag < errors.size(); ++i) {
      // Pairs within one row only.
      if (i % width + lag >= width) continue;
      const double product =
          (static_cast<double>(errors[i]) - mean) * (static_cast<double>(errors[i + lag]) - mean);
      if (std::isnan(product)) continue;
      sum += product;
      pairs += 1.0;
    }
    const double covariance = sum / pairs;
    if (lag == 0) variance = covariance;
    const double correlation = covariance / variance;
    if (correlation < 0.5) {
      // Between the lags by proportion.
      return static_cast<double>(lag) - (0.5 - correlation) / (last - correlation);
    }
    last = correlation;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

DepthStatistics depth_statistics(std::span<const DepthSample> samples, bool edges, double nearest_m,
                                 double farthest_m, double disparity_at_1m_px) {
  DepthStatistics result;
  std::size_t valid = 0, finite = 0, outliers = 0;
  double sum = 0.0, squares = 0.0, depth_squares = 0.0, depth_sum = 0.0, expected = 0.0;
  for (const DepthSample& sample : samples) {
    const auto truth = static_cast<double>(sample.truth_m);
    const auto measured = static_cast<double>(sample.measured_m);
    if (sample.is_edge != edges || truth < nearest_m || truth >= farthest_m) continue;
    ++result.pixel_count;
    // NaN is invalid; infinite depth, "nothing there", is valid and has no error.
    if (std::isnan(measured)) continue;
    ++valid;
    if (!std::isfinite(measured)) continue;
    ++finite;
    const double error = disparity_at_1m_px / measured - disparity_at_1m_px / truth;
    if (std::abs(error) > 1.0) {
      ++outliers;
      continue;
    }
    sum += error;
    squares += error * error;
    depth_sum += measured - truth;
    depth_squares += (measured - truth) * (measured - truth);
    // A pixel of disparity is z² / (f b) of depth.
    expected += truth * truth / disparity_at_1m_px;
  }
  const auto count = static_cast<double>(finite - outliers);
  const auto ratio = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole)
                     : std::numeric_limits<double>::quiet_NaN();
  };
  result.valid_ratio = ratio(valid, result.pixel_count);
  result.outlier_ratio = ratio(outliers, finite);
  result.disparity_bias_px = sum / count;
  result.disparity_sigma_px = std::sqrt(std::max(0.0, squares / count - sum / count * sum / count));
  result.depth_sigma_m =
      std::sqrt(std::max(0.0, depth_squares / count - depth_sum / count * depth_sum / count));
  result.expected_depth_sigma_m = expected / count * result.disparity_sigma_px;
  return result;
}

double fattening_px(std::span<const float> truth_m, std::span<const float> measured_m, int width_px,
                    double disparity_at_1m_px, int reach_px) {
  const auto width = static_cast<std::size_t>(width_px);
  const auto reach = static_cast<std::size_t>(reach_px);
  const std::vector<float> truth = disparities(truth_m, disparity_at_1m_px);
  const std::vector<float> measured = disparities(measured_m, disparity_at_1m_px);
  std::size_t steps = 0, taken = 0;
  for (std::size_t y = 0; y * width < truth.size(); ++y) {
    const float* row = &truth[y * width];
    // Only the right side of near things: the left one is half hidden from the right eye.
    for (std::size_t x = reach; x + reach < width; ++x) {
      const float near = row[x], far = row[x + 1];
      // A step from near to far.
      if (near - far <= 2.0F * kStep_px) continue;
      bool is_clean = true;  // the background goes on, and the near side was measured
      for (std::size_t k = 1; k <= reach; ++k) {
        is_clean = is_clean && std::abs(row[x + k] - far) < 0.5F * kStep_px;
      }
      if (!is_clean || !(std::abs(measured[y * width + x] - near) < 1.0F)) continue;
      ++steps;
      for (std::size_t k = 1; k <= reach; ++k) {
        if (std::abs(measured[y * width + x + k] - near) < 1.0F) ++taken;
      }
    }
  }
  return steps > 0 ? static_cast<double>(taken) / static_cast<double>(steps)
                   : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace avoidbench
