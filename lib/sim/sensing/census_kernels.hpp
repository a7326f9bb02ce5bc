#pragma once

#include <cstddef>
#include <cstdint>

// Inside the room only. The census matcher's loops exist twice: for every x86-64 machine (SSE2) and
// for those with AVX2; both give the same bytes. This header is compiled into both, so it holds
// nothing that the compiler could emit: a function compiled for AVX2 must not reach other machines.
namespace avoidbench::census {

inline constexpr int kMostPairs = 31;      ///< of pixels in a window: the bits of a census
inline constexpr int kAlignment = 64;      ///< of every buffer, bytes
inline constexpr int kSlack = 64;          ///< what whole vectors may reach beyond a row, bytes
inline constexpr int kMarginX_px = 4;      ///< of the largest census window, 9 × 7
inline constexpr int kMarginY_px = 3;      ///< of the largest census window, 9 × 7
inline constexpr int kDisparityStep = 32;  ///< disparities are padded to whole vectors
inline constexpr int kChunk = 64;          ///< disparities that six bits of a key tell apart
inline constexpr int kNoWinner = -16;      ///< of a left pixel whose least sum is not unique
inline constexpr int kMostSums = 1024;     ///< more than any sum of paths
inline constexpr int kGuard = 32;          ///< bytes of 255 between the slots of a path

/// One frame's sizes and buffers. `stride`s are in elements.
struct Frame {
  int width_px, height_px;
  int disparities;  ///< as asked for
  int padded;       ///< disparities, up to whole vectors
  int paths;        ///< 4 or 8
  std::uint8_t small_penalty, large_penalty;
  bool subpixel;
  bool is_unique;  ///< winners are checked for rivals

  /// A census by byte: row y's plane k starts at (planes · y + k) · plane_stride; four planes hold
  /// the 31 bits of a window of 9 × 7, two the 12 bits of one of 5 × 5. The right image's rows
  /// are mirrored, so that disparities ascend with addresses: x is at width − 1 − x, and the column
  /// of x = 0 goes on for `padded` more.
  int planes;
  const std::uint8_t *left_planes, *right_planes;
  std::ptrdiff_t plane_stride;

  /// Of the paths from the left and from above: pixel by pixel, the sums of two paths a byte (all
  /// values are at most 127); `padded` bytes with 4 paths, twice that with 8.
  std::uint8_t* volume;

  /// The row before along the three paths from there: width slots each of a guard and `padded`
  /// bytes, and the least value of every slot. The last guard stands behind the last slot.
  std::uint8_t* slots[3];
  std::uint8_t* least[3];

  std::uint16_t* keys;        ///< `padded`: one pixel's keys
  std::uint16_t* window;      ///< `padded`, see keep_right_winners()
  std::uint16_t* right_keys;  ///< a row for every chunk, width elements, `right_keys_stride` apart
  std::ptrdiff_t right_keys_stride;

  /// Of winners that have to be unique, by their sum: what any but its neighbours' must reach.
  std::uint16_t* rival_bounds;
  /// −1, 0 and 1 are all ones; `padded` zeros stand before and behind.
  const std::uint16_t* three_words;

  /// Winners, 1/16 px in the left image (or kNoWinner) and whole pixels in the right one. Columns
  /// −1 and width exist and are the caller's.
  std::int16_t *left_disparity, *right_disparity;
  std::ptrdiff_t disparity_stride;
};

/// A grey image with a margin of zeros; `pixels` is at (0, 0).
struct PaddedImage {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride;
  int width_px, height_px;
  bool mirrored;               ///< left and right are swapped
  int reach_x_px, reach_y_px;  ///< of the census window to each side: (4, 3) or (2, 2)
};

struct Kernels {
  /// Census of every pixel. Writes up to kSlack more than the width.
  void (*transform)(const PaddedImage& image, std::uint8_t* planes, std::ptrdiff_t plane_stride);
  /// Adds up the paths from the left and from above into the volume.
  void (*sweep_down)(const Frame& frame);
  /// Goes back over the other paths and picks the winners.
  void (*sweep_up)(const Frame& frame);
  /// 3 × 3 median of three rows, which exist from −1 to width_px; all may be read and `out` written
  /// up to kSlack bytes beyond.
  void (*median_row)(const std::int16_t* above, const std::int16_t* at, const std::int16_t* below,
                     int width_px, std::int16_t* out);
};

extern const Kernels kPortableKernels;
extern const Kernels kAvx2Kernels;  ///< only where the processor has AVX2

}  // namespace avoidbench::census
