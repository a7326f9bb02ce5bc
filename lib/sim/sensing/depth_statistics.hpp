#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// One pixel whose true depth is known.
struct DepthSample {
  float truth_m = 0, measured_m = 0;  ///< along camera z; measured NaN: invalid, +inf: no return
  bool is_edge = false;               ///< near a step in depth, where matchers guess
};

/// Adds the pixels of one image whose truth is finite. Both are height × width, row-major. A step
/// is a difference of more than 2 px of disparity within `edge_px` in the same row or column.
void add_samples(std::span<const float> truth_m, std::span<const float> measured_m, int width_px,
                 double disparity_at_1m_px, int edge_px, std::vector<DepthSample>& samples);

/// How far the errors of at most 1 px of pixels in a row are alike: the distance at which their
/// correlation falls below one half. NaN where there are too few. Same layout as add_samples.
double error_size_px(std::span<const float> truth_m, std::span<const float> measured_m,
                     int width_px, double disparity_at_1m_px);

/// What a sensor does to true depth.
struct DepthStatistics {
  std::size_t pixel_count = 0;
  double valid_ratio = 0;             ///< not NaN; no return (+inf) is an answer too
  double disparity_bias_px = 0;       ///< mean of the errors of at most 1 px
  double disparity_sigma_px = 0;      ///< their standard deviation
  double outlier_ratio = 0;           ///< of the finite ones: errors of more than 1 px
  double depth_sigma_m = 0;           ///< standard deviation of the depth errors of the others
  double expected_depth_sigma_m = 0;  ///< Z² / (focal length × baseline) × disparity_sigma_px
};

/// Over the samples of one kind with a truth in [nearest_m, farthest_m). NaN where there are none.
DepthStatistics depth_statistics(std::span<const DepthSample> samples, bool edges, double nearest_m,
                                 double farthest_m, double disparity_at_1m_px);

/// By how many pixels near things look wider on their right side: background pixels within
/// `reach_px` of a step that got the near side's disparity, a step. Same layout as add_samples.
double fattening_px(std::span<const float> truth_m, std::span<const float> measured_m, int width_px,
                    double disparity_at_1m_px, int reach_px);

}  // namespace avoidbench
