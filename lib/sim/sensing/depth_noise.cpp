#include "sensing/depth_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "base/math.hpp"
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
  // One shift after the other over whole rows, which compilers make vectors of; the reach is a few
  // pixels.
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
    // A cell beyond the last pixel for interpolation, and one for rounding.
    return static_cast<std::size_t>(static_cast<double>(size) / size_px_) + 2;
  };
  cells_across_ = cells(width_px);
  lattice_.resize(cells_across_ * cells(height_px));
  random.coarse_normals(lattice_);
  row_cells_.resize(cells_across_);
  // Weights depend on the width alone.
  if (row_.size() == width_px) return;
  row_.resize(width_px);
  left_.clear();
  right_.clear();
  first_pixel_.clear();
  for (std::size_t x = 0; x < width_px; ++x) {
    const double at = static_cast<double>(x) / size_px_;
    const double cell = std::floor(at);
    // Where each cell of the lattice begins in a row of pixels.
    while (first_pixel_.size() <= static_cast<std::size_t>(cell)) first_pixel_.push_back(x);
    const auto [left, right] = even_weights(at - cell);
    left_.push_back(left);
    right_.push_back(right);
  }
  first_pixel_.push_back(width_px);
}

/// Bilinear in two steps: between two rows of the lattice, then along the row.
const std::vector<float>& NormalField::row(std::size_t y) {
  const double at = static_cast<double>(y) / size_px_;
  const double cell = std::floor(at);
  const auto [upper, lower] = even_weights(at - cell);
  const float* above = &lattice_[static_cast<std::size_t>(cell) * cells_across_];
  for (std::size_t i = 0; i < cells_across_; ++i) {
    row_cells_[i] = upper * above[i] + lower * above[i + cells_across_];
  }
  for (std::size_t i = 0; i + 1 < first_pixel_.size(); ++i) {
    const float left = row_cells_[i], right = row_cells_[i + 1];
    for (std::size_t x = first_pixel_[i]; x < first_pixel_[i + 1]; ++x) {
      row_[x] = left_[x] * left + right_[x] * right;
    }
  }
  return row_;
}

DepthNoise::DepthNoise(const DepthNoisySpec& spec)
    : spec_(spec),
      holes_(spec.hole_size_px),
      errors_(spec.noise_size_px),
      covered_below_(normal_limit(spec.half_occlusion_ratio)) {}

/// Fattened edges first, then holes and errors in patches and dropped pixels; row by row, what is
/// hidden goes and the rest is moved and rounded.
void DepthNoise::apply(const NoisyDepthView& view, const SeenSurfaces& seen, RandomStream& random,
                       std::span<float> depth_m) {
  AB_CHECK(depth_m.size() == view.width_px * view.height_px, depth_m.size());
  AB_CHECK(seen.surface.size() == depth_m.size(), seen.surface.size());
  const auto at_1m = static_cast<float>(view.disparity_at_1m_px);
  find_textures(seen.opacity);
  disparity_.resize(depth_m.size());
  // Infinite depth is disparity 0.
  for (std::size_t i = 0; i < depth_m.size(); ++i) disparity_[i] = at_1m / depth_m[i];
  fatten(view.width_px, view.height_px);
  holes_.draw(view.width_px, view.height_px, random);
  errors_.draw(view.width_px, view.height_px, random);
  drop_pixels(random);
  for (std::size_t y = 0; y < view.height_px; ++y) finish_row(view, y, seen.surface, depth_m);
}

/// A block matcher gives pixels beside a step the nearer side's disparity; slopes stay as they are.
void DepthNoise::fatten(std::size_t width, std::size_t height) {
  const auto reach = static_cast<std::size_t>(spec_.fattening_px);
  if (reach == 0) return;
  rows_max_.resize(disparity_.size());
  max_.resize(width);
  // The greatest of a square: of its rows first, then of those.
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
  float leftmost = kInfinity;  // column in the right image of all that lies further right
  auto position = static_cast<float>(patches.size());
  // From the right: a pixel is covered where one to its right has come at least as far to the left
  // in the right image.
  for (std::size_t x = patches.size(); x-- > 0;) {
    position -= 1.0F;
    const float exact = disparity[x];
    const float column = position - exact;
    const bool is_covered = (column >= leftmost) & (patches[x] < covered_below_);
    const float here = exact < 0.0F ? kInfinity : column;  // a dropped pixel covers nothing
    leftmost = here < leftmost ? here : leftmost;
    const bool is_hidden = is_covered | (column <= -0.5F);
    // Bitwise on purpose: without branches the loop runs at one speed on any image.
    disparity[x] = is_hidden ? -1.0F : exact;
  }
}

DepthNoise::Texture DepthNoise::texture_of(float opacity) const {
  // Fitted, see results/README.md and docs/sensors.md: errors rise late, when little texture is
  // left.
  const auto lack = static_cast<double>((1.0F - opacity) * (1.0F - opacity));
  const auto between = [lack](double textured, double bland) {
    return textured + (bland - textured) * lack;
  };
  Texture texture;
  texture.opacity = opacity;
  texture.hole_below = normal_limit(between(spec_.hole_ratio, spec_.bland_hole_ratio));
  texture.outlier_above = -normal_limit(between(spec_.outlier_ratio, spec_.bland_outlier_ratio));
  texture.sigma_px =
      static_cast<float>(between(spec_.disparity_sigma_px, spec_.bland_disparity_sigma_px));
  return texture;
}

/// What follows from the surfaces' opacities. Kept where they are as in the last image.
void DepthNoise::find_textures(std::span<const float> opacity) {
  const std::size_t known = textures_.size();
  // One more, for pixels that show no surface.
  textures_.resize(opacity.size() + 1);
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const float wanted = i < opacity.size() ? opacity[i] : 0.0F;
    if (i + 1 < known && textures_[i].opacity == wanted) continue;
    const bool as_before = i > 0 && textures_[i - 1].opacity == wanted;
    textures_[i] = as_before ? textures_[i - 1] : texture_of(wanted);
  }
  textures_.back().outlier_above = kInfinity;  // the sky may be invalid but is not near
  textures_.back().sigma_px = static_cast<float>(spec_.disparity_sigma_px);
}

namespace {

/// What all pixels of an image share.
struct Measuring {
  float steps_a_px, step_px;  ///< 0: disparity is not rounded
  float outlier_sigma_px, at_1m_px, nearest_m, farthest_m;
};

/// Depth of a run of pixels on one texture. Written so that compilers take four at a time.
template <class Texture>
void measure(const Measuring& measuring, const Texture& texture, std::size_t count,
             const float* disparity, const float* patches, const float* errors, float* depth_m) {
  const Measuring m = measuring;  // so that writes to depth_m can't change them
  const float hole_below = texture.hole_below, outlier_above = texture.outlier_above;
  const float usual_sigma = texture.sigma_px;
  for (std::size_t i = 0; i < count; ++i) {
    const float sigma = patches[i] > outlier_above ? m.outlier_sigma_px : usual_sigma;
    const float moved = disparity[i] + sigma * errors[i];
    const float noisy = moved > 0.0F ? moved : 0.0F;
    const float half_up = noisy * m.steps_a_px + 0.5F;
    const auto whole = static_cast<float>(static_cast<std::int32_t>(half_up));
    const float measured = m.steps_a_px > 0.0F ? whole * m.step_px : noisy;
    const float depth = m.at_1m_px / measured;
    float seen = depth > m.farthest_m ? kInfinity : depth;
    seen = depth < m.nearest_m ? kNaN : seen;
    seen = patches[i] < hole_below ? kNaN : seen;
    depth_m[i] = disparity[i] < 0.0F ? kNaN : seen;
  }
}

}  // namespace

/// Single pixels, at distances that follow the geometric distribution.
void DepthNoise::drop_pixels(RandomStream& random) {
  if (spec_.dropout_ratio <= 0.0) return;
  // A ratio of 1 has a logarithm then, too.
  const double log_kept = math::log(std::max(1.0 - spec_.dropout_ratio, 1e-300));
  const auto count = static_cast<double>(disparity_.size());
  for (double at = -1.0;;) {
    // A draw for each dropped pixel instead of one for each pixel.
    at += 1.0 + std::floor(math::log(1.0 - random.uniform()) / log_kept);
    if (!(at < count)) return;
    disparity_[static_cast<std::size_t>(at)] = -1.0F;
  }
}

void DepthNoise::finish_row(const NoisyDepthView& view, std::size_t y,
                            std::span<const std::uint32_t> surfaces, std::span<float> depth_m) {
  const std::size_t width = view.width_px;
  const std::vector<float>& patches = holes_.row(y);
  float* disparity = &disparity_[y * width];
  occlude_row(patches, disparity);
  const std::vector<float>& errors = errors_.row(y);
  const Measuring measuring{.steps_a_px = spec_.disparity_step_px > 0.0
                                              ? static_cast<float>(1.0 / spec_.disparity_step_px)
                                              : 0.0F,
                            .step_px = static_cast<float>(spec_.disparity_step_px),
                            .outlier_sigma_px = static_cast<float>(spec_.outlier_sigma_px),
                            .at_1m_px = static_cast<float>(view.disparity_at_1m_px),
                            .nearest_m = static_cast<float>(view.min_range_m),
                            .farthest_m = static_cast<float>(view.max_range_m)};
  const std::uint32_t* row = &surfaces[y * width];
  for (std::size_t from = 0; from < width;) {  // in runs of one surface
    std::size_t to = from + 1;
    while (to < width && row[to] == row[from]) ++to;
    const Texture& texture = textures_[std::min<std::size_t>(row[from], textures_.size() - 1)];
    measure(measuring, texture, to - from, disparity + from, patches.data() + from,
            errors.data() + from, &depth_m[y * width + from]);
    from = to;
  }
}

}  // namespace avoidbench
