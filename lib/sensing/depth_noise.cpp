#include "sensing/depth_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "base/normal_quantile.hpp"

namespace avoidbench {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// out[i] = greatest of in[i - reach … i + reach], ends aside.
void running_max(const float* in, std::size_t count, std::size_t reach, std::size_t stride,
                 float* out, std::size_t lanes) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i < reach ? 0 : i - reach;
    const std::size_t last = std::min(i + reach, count - 1);
    float* to = out + i * stride;
    std::copy_n(in + first * stride, lanes, to);
    for (std::size_t k = first + 1; k <= last; ++k) {
      const float* from = in + k * stride;
      for (std::size_t lane = 0; lane < lanes; ++lane) to[lane] = std::max(to[lane], from[lane]);
    }
  }
}

/// The number below which a normal falls with this probability; ∓inf for 0 and 1.
float normal_limit(double ratio) {
  if (ratio <= 0.0) return -kInfinity;
  return ratio >= 1.0 ? kInfinity : static_cast<float>(normal_quantile(ratio));
}

/// Two weights of linear interpolation `t` of the way whose squares add up to 1, so that normals
/// stay normals of variance 1.
std::pair<float, float> even_weights(double t) {
  const double norm = std::sqrt((1.0 - t) * (1.0 - t) + t * t);
  return {static_cast<float>((1.0 - t) / norm), static_cast<float>(t / norm)};
}

}  // namespace

void DepthNoise::apply(const NoisyDepthView& view, std::span<const float> opacity,
                       RandomStream& random, std::span<float> depth_m) {
  AB_CHECK(depth_m.size() == view.width_px * view.height_px, depth_m.size());
  AB_CHECK(opacity.size() == depth_m.size(), opacity.size());
  const auto at_1m = static_cast<float>(view.disparity_at_1m_px);
  limit_opacity_ = -1.0F;
  disparity_.resize(depth_m.size());
  for (std::size_t i = 0; i < depth_m.size(); ++i) disparity_[i] = at_1m / depth_m[i];
  fatten(view.width_px, view.height_px);
  draw_patches(view.width_px, view.height_px, random);
  for (std::size_t y = 0; y < view.height_px; ++y) finish_row(view, y, opacity, random, depth_m);
}

/// A block matcher gives a pixel the disparity of the nearest thing in its block.
void DepthNoise::fatten(std::size_t width, std::size_t height) {
  const auto reach = static_cast<std::size_t>(spec_.fattening_px);
  if (reach == 0) return;
  fattened_.resize(disparity_.size());
  running_max(disparity_.data(), height, reach, width, fattened_.data(), width);
  for (std::size_t y = 0; y < height; ++y) {
    const float* in = &fattened_[y * width];
    float* out = &disparity_[y * width];
    std::copy_n(in, width, out);
    for (std::size_t shift = 1; shift <= reach && shift < width; ++shift) {
      for (std::size_t x = shift; x < width; ++x) out[x] = std::max(out[x], in[x - shift]);
      for (std::size_t x = shift; x < width; ++x) {
        out[x - shift] = std::max(out[x - shift], in[x]);
      }
    }
  }
}

void DepthNoise::draw_patches(std::size_t width, std::size_t height, RandomStream& random) {
  const auto cells = [&](std::size_t size) {
    return static_cast<std::size_t>(static_cast<double>(size) / spec_.hole_size_px) + 2;
  };
  patches_across_ = cells(width);
  patches_.resize(patches_across_ * cells(height));
  random.coarse_normals(patches_);
  if (columns_.size() == width) return;
  columns_.resize(width);
  for (std::size_t x = 0; x < width; ++x) {
    const double at = static_cast<double>(x) / spec_.hole_size_px;
    const double cell = std::floor(at);
    const auto [left, right] = even_weights(at - cell);
    columns_[x] = {static_cast<std::size_t>(cell), left, right};
  }
}

/// The patches' numbers along row `y`, each of variance 1.
void DepthNoise::interpolate_patches(std::size_t y) {
  const double at = static_cast<double>(y) / spec_.hole_size_px;
  const double cell = std::floor(at);
  const auto [upper, lower] = even_weights(at - cell);
  const float* above = &patches_[static_cast<std::size_t>(cell) * patches_across_];
  row_cells_.resize(patches_across_);
  for (std::size_t i = 0; i < patches_across_; ++i) {
    row_cells_[i] = upper * above[i] + lower * above[i + patches_across_];
  }
  row_patches_.resize(columns_.size());
  for (std::size_t x = 0; x < columns_.size(); ++x) {
    const Column& column = columns_[x];
    row_patches_[x] =
        column.left * row_cells_[column.cell] + column.right * row_cells_[column.cell + 1];
  }
}

/// Marks with disparity -1 what has no partner in the right image: right of the place where a
/// nearer thing covers it, or outside.
void DepthNoise::occlude_row(float* disparity, std::size_t width) const {
  float leftmost = kInfinity;  // column in the right image of all that lies further right
  for (std::size_t x = width; x-- > 0;) {
    const float column = static_cast<float>(x) - disparity[x];
    const bool seen = column < leftmost && column > -0.5F;
    leftmost = std::min(leftmost, column);
    if (!seen) disparity[x] = -1.0F;
  }
}

/// Least patch number that is no hole, for this opacity.
float DepthNoise::hole_limit(float opacity) {
  if (opacity != limit_opacity_) {
    limit_opacity_ = opacity;
    const double ratio = spec_.bland_hole_ratio +
                         (spec_.hole_ratio - spec_.bland_hole_ratio) * static_cast<double>(opacity);
    limit_ = normal_limit(ratio);
  }
  return limit_;
}

void DepthNoise::finish_row(const NoisyDepthView& view, std::size_t y,
                            std::span<const float> opacity, RandomStream& random,
                            std::span<float> depth_m) {
  const std::size_t width = view.width_px;
  float* disparity = &disparity_[y * width];
  if (spec_.half_occlusion) occlude_row(disparity, width);
  interpolate_patches(y);
  for (std::size_t x = 0; x < width; ++x) {
    if (row_patches_[x] < hole_limit(opacity[y * width + x])) disparity[x] = -1.0F;
  }
  noise_.resize(width);
  if (spec_.dropout_ratio > 0.0) {
    const float limit = normal_limit(spec_.dropout_ratio);
    random.coarse_normals(noise_);
    for (std::size_t x = 0; x < width; ++x) {
      if (noise_[x] < limit) disparity[x] = -1.0F;
    }
  }
  random.coarse_normals(noise_);
  const auto sigma = static_cast<float>(spec_.disparity_sigma_px);
  const auto step = static_cast<float>(spec_.disparity_step_px);
  const float steps_a_px = step > 0.0F ? 1.0F / step : 0.0F;
  const auto at_1m = static_cast<float>(view.disparity_at_1m_px);
  const auto nearest = static_cast<float>(view.min_range_m);
  const auto farthest = static_cast<float>(view.max_range_m);
  float* out = &depth_m[y * width];
  for (std::size_t x = 0; x < width; ++x) {
    const float exact = disparity[x];
    const float noisy = std::max(exact + sigma * noise_[x], 0.0F);
    const auto whole = static_cast<float>(static_cast<std::int32_t>(noisy * steps_a_px + 0.5F));
    const float measured = steps_a_px > 0.0F ? whole * step : noisy;
    const float depth = at_1m / measured;
    const float in_range = depth > farthest ? kInfinity : depth;
    out[x] = exact < 0.0F || depth < nearest ? kNaN : in_range;
  }
}

}  // namespace avoidbench
