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

/// to[i] = the larger of both.
void larger_of(const float* from, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i] > to[i] ? from[i] : to[i];
}

/// out[i] = greatest of in[i - reach … i + reach], as far as there are such.
void running_max(const float* in, std::size_t count, std::size_t reach, float* out) {
  std::copy_n(in, count, out);
  for (std::size_t shift = 1; shift <= reach && shift < count; ++shift) {
    larger_of(in, count - shift, out + shift);
    larger_of(in + shift, count - shift, out);
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

void NormalField::draw(std::size_t width_px, std::size_t height_px, RandomStream& random) {
  const auto cells = [&](std::size_t size) {
    return static_cast<std::size_t>(static_cast<double>(size) / size_px_) + 2;
  };
  cells_across_ = cells(width_px);
  lattice_.resize(cells_across_ * cells(height_px));
  random.coarse_normals(lattice_);
  row_cells_.resize(cells_across_);
  if (columns_.size() == width_px) return;
  columns_.resize(width_px);
  row_.resize(width_px);
  for (std::size_t x = 0; x < width_px; ++x) {
    const double at = static_cast<double>(x) / size_px_;
    const double cell = std::floor(at);
    const auto [left, right] = even_weights(at - cell);
    columns_[x] = {static_cast<std::size_t>(cell), left, right};
  }
}

const std::vector<float>& NormalField::row(std::size_t y) {
  const double at = static_cast<double>(y) / size_px_;
  const double cell = std::floor(at);
  const auto [upper, lower] = even_weights(at - cell);
  const float* above = &lattice_[static_cast<std::size_t>(cell) * cells_across_];
  for (std::size_t i = 0; i < cells_across_; ++i) {
    row_cells_[i] = upper * above[i] + lower * above[i + cells_across_];
  }
  for (std::size_t x = 0; x < columns_.size(); ++x) {
    const Column& column = columns_[x];
    row_[x] = column.left * row_cells_[column.cell] + column.right * row_cells_[column.cell + 1];
  }
  return row_;
}

void DepthNoise::apply(const NoisyDepthView& view, std::span<const float> opacity,
                       RandomStream& random, std::span<float> depth_m) {
  AB_CHECK(depth_m.size() == view.width_px * view.height_px, depth_m.size());
  AB_CHECK(opacity.size() == depth_m.size(), opacity.size());
  const auto at_1m = static_cast<float>(view.disparity_at_1m_px);
  texture_ = {};
  disparity_.resize(depth_m.size());
  for (std::size_t i = 0; i < depth_m.size(); ++i) disparity_[i] = at_1m / depth_m[i];
  fatten(view.width_px, view.height_px);
  holes_.draw(view.width_px, view.height_px, random);
  errors_.draw(view.width_px, view.height_px, random);
  for (std::size_t y = 0; y < view.height_px; ++y) finish_row(view, y, opacity, random, depth_m);
}

/// A block matcher gives pixels beside a step the nearer side's disparity; slopes stay as they are.
void DepthNoise::fatten(std::size_t width, std::size_t height) {
  const auto reach = static_cast<std::size_t>(spec_.fattening_px);
  if (reach == 0) return;
  rows_max_.resize(disparity_.size());
  max_.resize(width);
  for (std::size_t y = 0; y < height; ++y) {
    running_max(&disparity_[y * width], width, reach, &rows_max_[y * width]);
  }
  const float least_step = 1.5F;  // px of disparity: what no slope has within the reach
  for (std::size_t y = 0; y < height; ++y) {
    const std::size_t last = std::min(y + reach, height - 1);
    std::size_t k = y < reach ? 0 : y - reach;
    std::copy_n(&rows_max_[k * width], width, max_.data());
    for (++k; k <= last; ++k) larger_of(&rows_max_[k * width], width, max_.data());
    float* out = &disparity_[y * width];
    for (std::size_t x = 0; x < width; ++x) {
      out[x] = max_[x] - out[x] > least_step ? max_[x] : out[x];
    }
  }
}

/// Marks with disparity -1 what has no partner in the right image: where a nearer thing covers it
/// there, in as many patches as the ratio says, and what lies outside of it.
void DepthNoise::occlude_row(const std::vector<float>& patches, float* disparity) const {
  const float limit = normal_limit(spec_.half_occlusion_ratio);
  float leftmost = kInfinity;  // column in the right image of all that lies further right
  for (std::size_t x = patches.size(); x-- > 0;) {
    const float column = static_cast<float>(x) - disparity[x];
    const bool is_covered = column >= leftmost && patches[x] < limit;
    leftmost = std::min(leftmost, column);
    if (is_covered || column <= -0.5F) disparity[x] = -1.0F;
  }
}

/// What follows from the opacity of a surface.
void DepthNoise::take_texture(float opacity) {
  const auto lack = static_cast<double>((1.0F - opacity) * (1.0F - opacity));
  const auto between = [lack](double textured, double bland) {
    return textured + (bland - textured) * lack;
  };
  texture_.opacity = opacity;
  texture_.hole_below = normal_limit(between(spec_.hole_ratio, spec_.bland_hole_ratio));
  texture_.outlier_above = -normal_limit(between(spec_.outlier_ratio, spec_.bland_outlier_ratio));
  texture_.sigma_px =
      static_cast<float>(between(spec_.disparity_sigma_px, spec_.bland_disparity_sigma_px));
}

void DepthNoise::finish_row(const NoisyDepthView& view, std::size_t y,
                            std::span<const float> opacity, RandomStream& random,
                            std::span<float> depth_m) {
  const std::size_t width = view.width_px;
  float* disparity = &disparity_[y * width];
  const std::vector<float>& patches = holes_.row(y);
  occlude_row(patches, disparity);
  if (spec_.dropout_ratio > 0.0) {
    const float limit = normal_limit(spec_.dropout_ratio);
    dropouts_.resize(width);
    random.coarse_normals(dropouts_);
    for (std::size_t x = 0; x < width; ++x) {
      if (dropouts_[x] < limit) disparity[x] = -1.0F;
    }
  }
  const std::vector<float>& errors = errors_.row(y);
  const auto outlier_sigma = static_cast<float>(spec_.outlier_sigma_px);
  const auto step = static_cast<float>(spec_.disparity_step_px);
  const float steps_a_px = step > 0.0F ? 1.0F / step : 0.0F;
  const auto at_1m = static_cast<float>(view.disparity_at_1m_px);
  const auto nearest = static_cast<float>(view.min_range_m);
  const auto farthest = static_cast<float>(view.max_range_m);
  float* out = &depth_m[y * width];
  for (std::size_t x = 0; x < width; ++x) {
    if (opacity[y * width + x] != texture_.opacity) take_texture(opacity[y * width + x]);
    const float exact = patches[x] < texture_.hole_below ? -1.0F : disparity[x];
    const float sigma = patches[x] > texture_.outlier_above ? outlier_sigma : texture_.sigma_px;
    const float error = sigma * errors[x];
    const float noisy = exact + error > 0.0F ? exact + error : 0.0F;
    const auto whole = static_cast<float>(static_cast<std::int32_t>(noisy * steps_a_px + 0.5F));
    const float measured = steps_a_px > 0.0F ? whole * step : noisy;
    const float depth = at_1m / measured;
    const float in_range = depth > farthest ? kInfinity : depth;
    out[x] = exact < 0.0F || depth < nearest ? kNaN : in_range;
  }
}

}  // namespace avoidbench
