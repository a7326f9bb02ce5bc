#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace avoidbench {

/// A colour image, sRGB 8-bit; `rgb` is height × width × 3, row-major.
struct Picture {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;
};

/// A black picture of this size.
Picture make_picture(int width_px, int height_px);

/// A depth image in colours: red at `nearest_m` to dark blue at `farthest_m` (Turbo, Mikhailov
/// 2019), black where there is no return (+inf), grey where the depth is invalid (NaN). `depth_m`
/// is height × width, row-major.
Picture depth_picture(std::span<const float> depth_m, int width_px, int height_px, double nearest_m,
                      double farthest_m);

/// Draws the colour scale of depth_picture along the picture's lower edge, with its ends in metres.
void add_depth_scale(Picture& picture, double nearest_m, double farthest_m);

/// Writes `text` (ASCII) in white on a dark band along the picture's upper edge.
void add_caption(Picture& picture, const std::string& text);

/// Throws InputError where the file can't be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace avoidbench
