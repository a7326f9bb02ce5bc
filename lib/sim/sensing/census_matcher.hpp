#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace avoidbench {

/// Pixels of a census. The larger tells more apart, the smaller blurs edges less.
enum class CensusWindow { nine_by_seven, five_by_five };

/// Semi-global matching (Hirschmüller 2008) of rectified stereo pairs over a census cost, by
/// default as the original AvoidBench does it: a centre-symmetric census of 9 × 7 pixels (31 bits),
/// costs by Hamming distance, and where a match would lie left of the image its first column is
/// taken. Paths end at the border; the original's diagonals wrap around to the other border's
/// column.
struct CensusSettings {
  CensusWindow window = CensusWindow::nine_by_seven;
  int disparities = 128;       ///< 0 … disparities − 1 px; a multiple of 16, 16 … 256
  int paths = 8;               ///< 8, or 4: along the axes only
  int small_penalty = 6;       ///< for a step of one pixel; 0 … large_penalty
  int large_penalty = 96;      ///< for any other step; at most 96, so that sums of costs are bytes
  bool subpixel = false;       ///< lines of equal slopes through the summed costs, to 1/16 px
  int uniqueness_percent = 0;  ///< a winner's sum is less by this than all not beside it; below 100
  int left_right_tolerance_px = 1;  ///< −1: no check, nothing is invalid
};

/// Disparities are in sixteenths of a pixel, as OpenCV's StereoSGBM gives them, and where there is
/// no match so is this value. 0 is a match infinitely far away (in the original 0 means both).
inline constexpr std::int16_t kInvalidDisparity = -16;

/// Memory of match_census(), kept by its caller from frame to frame; it grows when a frame needs
/// more, and what is in it between calls does not matter. About 2 · width · height · disparities
/// bytes with 8 paths, half of that with 4.
struct CensusWorkspace {
  std::vector<std::uint8_t> bytes;
};

/// Disparity of every pixel of the left image: `left`, `right` and `disparity` are height × width,
/// row-major; a point at (x, y) in the left image is at (x − disparity / 16, y) in the right one.
/// - Of equal sums over the paths the least disparity wins.
/// - Both images' disparities pass a 3 × 3 median (border pixels repeated).
/// - Invalid (kInvalidDisparity) is where the winner is not unique (this goes into the median as
///   such), where the match lies outside of the right image, or has a disparity of its own, by the
///   least sum there, that differs by more than the tolerance. Subpixel disparities are rounded for
///   this.
/// Aborts where sizes don't agree or settings are out of range; the image has at least 1 × 1
/// pixels. The same bytes on every x86-64 machine; with AVX2 where the processor has it.
void match_census(const CensusSettings& settings, std::span<const std::uint8_t> left,
                  std::span<const std::uint8_t> right, int width_px, int height_px,
                  CensusWorkspace& workspace, std::span<std::int16_t> disparity);

}  // namespace avoidbench
