#include "sensing/census_matcher.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "base/check.hpp"
#include "render/ray_tracing_isa.hpp"
#include "sensing/census_internals.hpp"

namespace avoidbench {
namespace census {
namespace {

constexpr std::ptrdiff_t round_up(std::ptrdiff_t value, std::ptrdiff_t step) {
  return (value + step - 1) / step * step;
}

/// Hands out the workspace's memory piece by piece, each aligned; without memory it only counts.
class Carver {
 public:
  explicit Carver(std::uint8_t* memory) : memory_(memory) {}

  /// Room for `count` elements; points at the one after `before` of them.
  template <class Element>
  Element* take(std::ptrdiff_t count, std::ptrdiff_t before = 0) {
    const std::ptrdiff_t start =
        used_bytes_ + before * static_cast<std::ptrdiff_t>(sizeof(Element));
    used_bytes_ += round_up(count * static_cast<std::ptrdiff_t>(sizeof(Element)), kAlignment);
    return memory_ == nullptr ? nullptr : reinterpret_cast<Element*>(memory_ + start);
  }
  std::ptrdiff_t used_bytes() const { return used_bytes_; }

 private:
  std::uint8_t* memory_;
  std::ptrdiff_t used_bytes_ = 0;
};

/// A frame's buffers as they lie in the workspace.
struct Buffers {
  Frame frame{};
  std::uint8_t* padded_image = nullptr;  ///< at its margin's corner
  std::ptrdiff_t padded_stride = 0;
  std::uint8_t *left_planes = nullptr, *right_planes = nullptr;
  std::uint16_t* three_words = nullptr;
  std::int16_t *left_median = nullptr, *right_median = nullptr;  ///< a row each
};

/// All buffers of a frame, in one order; `carver` counts them or hands them out.
Buffers carve(const CensusSettings& settings, int width_px, int height_px, Carver& carver) {
  Buffers buffers;
  Frame& frame = buffers.frame;
  frame.width_px = width_px;
  frame.height_px = height_px;
  frame.disparities = settings.disparities;
  frame.padded = static_cast<int>(round_up(settings.disparities, kDisparityStep));
  frame.paths = settings.paths;
  frame.small_penalty = static_cast<std::uint8_t>(settings.small_penalty);
  frame.large_penalty = static_cast<std::uint8_t>(settings.large_penalty);
  frame.subpixel = settings.subpixel;
  frame.is_unique = settings.uniqueness_percent > 0;
  frame.planes = settings.window == CensusWindow::nine_by_seven ? 4 : 2;

  const std::ptrdiff_t width = width_px;
  const std::ptrdiff_t height = height_px;
  buffers.padded_stride = round_up(width + 2 * kMarginX_px + kSlack, kAlignment);
  buffers.padded_image =
      carver.take<std::uint8_t>((height + 2 * kMarginY_px) * buffers.padded_stride);
  frame.plane_stride = round_up(width + frame.padded + kSlack, kAlignment);
  frame.left_planes = buffers.left_planes =
      carver.take<std::uint8_t>(height * frame.planes * frame.plane_stride);
  frame.right_planes = buffers.right_planes =
      carver.take<std::uint8_t>(height * frame.planes * frame.plane_stride);
  frame.volume = carver.take<std::uint8_t>(width * height * frame.padded * (settings.paths / 4));
  for (int path = 0; path < 3; ++path) {
    // The first guard ends where a slot may start.
    // Guards of 255 stand before the first slot and behind each: a step from beyond the disparities
    // never wins.
    frame.slots[path] = carver.take<std::uint8_t>(kGuard + width * (frame.padded + kGuard), kGuard);
    frame.least[path] = carver.take<std::uint8_t>(width);
  }
  frame.keys = carver.take<std::uint16_t>(frame.padded);
  frame.window = carver.take<std::uint16_t>(frame.padded);
  frame.rival_bounds = carver.take<std::uint16_t>(kMostSums);
  buffers.three_words = carver.take<std::uint16_t>(2 * frame.padded + kSlack, frame.padded);
  frame.three_words = buffers.three_words;
  frame.right_keys_stride = width;
  frame.right_keys = carver.take<std::uint16_t>(round_up(frame.padded, kChunk) / kChunk * width);
  frame.disparity_stride = width + 2;
  const std::ptrdiff_t pixels = height * frame.disparity_stride + kSlack;
  frame.left_disparity = carver.take<std::int16_t>(pixels, 1);
  frame.right_disparity = carver.take<std::int16_t>(pixels, 1);
  buffers.left_median = carver.take<std::int16_t>(width + kSlack);
  buffers.right_median = carver.take<std::int16_t>(width + kSlack);
  return buffers;
}

Buffers prepare(const CensusSettings& settings, int width_px, int height_px,
                CensusWorkspace& workspace) {
  // The same code counts and hands out, so that the two can't disagree.
  Carver counter(nullptr);
  carve(settings, width_px, height_px, counter);
  const auto needed = static_cast<std::size_t>(counter.used_bytes() + kAlignment);
  if (workspace.bytes.size() < needed) {
    workspace.bytes.clear();  // nothing to copy
    workspace.bytes.resize(needed);
  }
  void* start = workspace.bytes.data();
  std::size_t space = workspace.bytes.size();
  Carver carver(static_cast<std::uint8_t*>(
      std::align(kAlignment, needed - static_cast<std::size_t>(kAlignment), start, space)));
  return carve(settings, width_px, height_px, carver);
}

/// What says whether a winner is unique, as OpenCV has it: no other sum, but those beside it, with
/// sum · (100 − percent) < least · 100.
void prepare_rivals(const Buffers& buffers, int uniqueness_percent) {
  const int kept = 100 - uniqueness_percent;
  for (int least = 0; least < kMostSums; ++least) {
    const int bound = (100 * least + kept - 1) / kept;
    buffers.frame.rival_bounds[least] = static_cast<std::uint16_t>(std::min(bound, 0xFFFF));
  }
  const int padded = buffers.frame.padded;
  std::fill(buffers.three_words - padded, buffers.three_words + padded + kSlack, std::uint16_t{0});
  std::fill(buffers.three_words - 1, buffers.three_words + 2, std::uint16_t{0xFFFF});
}

/// Census of an image; the margin, where pixels count as 0, is `buffers.padded_image`'s.
void transform(const Kernels& kernels, const Buffers& buffers, std::span<const std::uint8_t> image,
               bool mirrored, std::uint8_t* planes) {
  const Frame& frame = buffers.frame;
  std::uint8_t* pixels = buffers.padded_image + kMarginY_px * buffers.padded_stride + kMarginX_px;
  for (int y = 0; y < frame.height_px; ++y) {
    const std::uint8_t* from = image.data() + static_cast<std::ptrdiff_t>(y) * frame.width_px;
    std::uint8_t* to = pixels + y * buffers.padded_stride;
    if (mirrored) {
      std::reverse_copy(from, from + frame.width_px, to);
    } else {
      std::copy_n(from, frame.width_px, to);
    }
  }
  const bool is_large = frame.planes == 4;
  kernels.transform(PaddedImage{.pixels = pixels,
                                .stride = buffers.padded_stride,
                                .width_px = frame.width_px,
                                .height_px = frame.height_px,
                                .mirrored = mirrored,
                                .reach_x_px = is_large ? 4 : 2,
                                .reach_y_px = is_large ? 3 : 2},
                    planes, frame.plane_stride);
}

void transform_both(const Kernels& kernels, const Buffers& buffers,
                    std::span<const std::uint8_t> left, std::span<const std::uint8_t> right) {
  const Frame& frame = buffers.frame;
  std::fill_n(buffers.padded_image, (frame.height_px + 2 * kMarginY_px) * buffers.padded_stride,
              std::uint8_t{0});
  transform(kernels, buffers, left, false, buffers.left_planes);
  transform(kernels, buffers, right, true, buffers.right_planes);
  for (std::ptrdiff_t row = 0; row < static_cast<std::ptrdiff_t>(frame.height_px) * frame.planes;
       ++row) {
    std::uint8_t* end = buffers.right_planes + row * frame.plane_stride + frame.width_px;
    // Beyond the right image's border its last column goes on.
    std::fill_n(end, frame.padded, end[-1]);
  }
}

/// For the medians, which look one column beyond either border.
void repeat_border_columns(const Frame& frame, std::int16_t* disparity) {
  for (int y = 0; y < frame.height_px; ++y) {
    std::int16_t* row = disparity + y * frame.disparity_stride;
    row[-1] = row[0];
    row[frame.width_px] = row[frame.width_px - 1];
  }
}

/// Of 3 × 3 pixels; the first and the last row stand for those beyond.
void median_row(const Kernels& kernels, const Frame& frame, const std::int16_t* disparity, int y,
                std::int16_t* out) {
  const auto row = [&](int at) {
    return disparity + std::clamp(at, 0, frame.height_px - 1) * frame.disparity_stride;
  };
  kernels.median_row(row(y - 1), row(y), row(y + 1), frame.width_px, out);
}

static_assert(kNoWinner == kInvalidDisparity);  // so it may stay what it is

/// Medians of both images and the check of one against the other.
void finish(const Kernels& kernels, const Buffers& buffers, int tolerance_px,
            std::span<std::int16_t> disparity) {
  const Frame& frame = buffers.frame;
  repeat_border_columns(frame, frame.left_disparity);
  repeat_border_columns(frame, frame.right_disparity);
  for (int y = 0; y < frame.height_px; ++y) {
    median_row(kernels, frame, frame.left_disparity, y, buffers.left_median);
    std::int16_t* out = disparity.data() + static_cast<std::ptrdiff_t>(y) * frame.width_px;
    if (tolerance_px < 0) {
      std::copy_n(buffers.left_median, frame.width_px, out);
      continue;
    }
    median_row(kernels, frame, frame.right_disparity, y, buffers.right_median);
    for (int x = 0; x < frame.width_px; ++x) {
      // 1/16 px to the nearest whole one, as the right image's are.
      const int d = (buffers.left_median[x] + 8) >> 4;
      // The right image has to say the same at the partner, x - d.
      const bool valid = d >= 0 && d <= x &&
                         std::abs(d - buffers.right_median[x - std::min(d, x)]) <= tolerance_px;
      out[x] = valid ? buffers.left_median[x] : kInvalidDisparity;
    }
  }
}

void check(const CensusSettings& settings) {
  AB_CHECK(
      // Eight times kDisparityStep: sweep_padded() has one loop for each.
      settings.disparities >= 16 && settings.disparities <= 256 && settings.disparities % 16 == 0,
      settings.disparities);
  AB_CHECK(settings.paths == 4 || settings.paths == 8, settings.paths);
  AB_CHECK(settings.small_penalty >= 0 && settings.small_penalty <= settings.large_penalty &&
               // A path's value is at most a cost of 31 plus this, 127: two fit a byte, and eight
               // times 64 (of pick_winner's keys) fit 16 bits.
               settings.large_penalty <= 96,
           settings.small_penalty, settings.large_penalty);
  AB_CHECK(settings.uniqueness_percent >= 0 && settings.uniqueness_percent < 100,
           settings.uniqueness_percent);
  AB_CHECK(settings.left_right_tolerance_px >= -1, settings.left_right_tolerance_px);
}

}  // namespace

void match(const Kernels& kernels, const CensusSettings& settings,
           std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int width_px,
           int height_px, CensusWorkspace& workspace, std::span<std::int16_t> disparity) {
  check(settings);
  AB_CHECK(width_px > 0 && height_px > 0, width_px, height_px);
  const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  AB_CHECK(left.size() == pixels && right.size() == pixels && disparity.size() == pixels,
           left.size(), right.size(), disparity.size(), pixels);
  const Buffers buffers = prepare(settings, width_px, height_px, workspace);
  const Frame& frame = buffers.frame;
  if (frame.is_unique) prepare_rivals(buffers, settings.uniqueness_percent);
  transform_both(kernels, buffers, left, right);
  kernels.sweep_down(frame);
  // Where a right pixel never meets a chunk's disparities, its key stays this one.
  std::fill_n(frame.right_keys, round_up(frame.padded, kChunk) / kChunk * frame.right_keys_stride,
              std::uint16_t{0xFFFF});
  kernels.sweep_up(frame);
  finish(kernels, buffers, settings.left_right_tolerance_px, disparity);
}

}  // namespace census

void match_census(const CensusSettings& settings, std::span<const std::uint8_t> left,
                  std::span<const std::uint8_t> right, int width_px, int height_px,
                  CensusWorkspace& workspace, std::span<std::int16_t> disparity) {
  static const census::Kernels& kernels =
      has_avx2() ? census::kAvx2Kernels : census::kPortableKernels;
  census::match(kernels, settings, left, right, width_px, height_px, workspace, disparity);
}

}  // namespace avoidbench
