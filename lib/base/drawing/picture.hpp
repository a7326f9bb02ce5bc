#pragma once

#include <Eigen/Core>
#include <array>
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

using Color = std::array<std::uint8_t, 3>;  ///< sRGB
inline constexpr Color kWhite{255, 255, 255};

/// A black picture of this size.
Picture make_picture(int width_px, int height_px);

/// A depth image in colours: red at `nearest_m` to dark blue at `farthest_m` (Turbo, Mikhailov
/// 2019), black where there is no return (+inf), grey where the depth is invalid (NaN). `depth_m`
/// is height × width, row-major.
Picture depth_picture(std::span<const float> depth_m, int width_px, int height_px, double nearest_m,
                      double farthest_m);

/// Draws the colour scale of depth_picture along the picture's lower edge, with its ends in metres.
void add_depth_scale(Picture& picture, double nearest_m, double farthest_m);

/// Colour of a height, 0: lowest to 1: highest (Viridis, Smith and van der Walt 2015).
Color height_color(double ratio);

/// Colour of a share, 0: blue to 1: red (Turbo).
Color turbo_color(double ratio);

/// Draws the scale of height_color() at the right of the picture's lower edge, 0 to `highest_m`.
void add_height_scale(Picture& picture, double highest_m);

/// Draws a bar of a round length at the left of the picture's lower edge.
void add_scale_bar(Picture& picture, double pixels_per_m);

/// Draws a polyline, anti-aliased; points in pixels, x to the right, y down.
void draw_line(Picture& picture, const std::vector<Eigen::Vector2d>& points, const Color& color,
               int width_px);

/// Draws a disc, or a circle of `width_px`, the same way.
void draw_disc(Picture& picture, const Eigen::Vector2d& center, double radius_px,
               const Color& color);
void draw_circle(Picture& picture, const Eigen::Vector2d& center, double radius_px,
                 const Color& color, int width_px);

/// Writes `text` (ASCII) with the left end of its base line at (x_px, y_px).
void draw_text(Picture& picture, const std::string& text, int x_px, int y_px, const Color& color);

/// Width of `text` as draw_text() writes it.
int text_width_px(const std::string& text);

/// The same on a pale ground of its own, moved into the picture where it would leave it.
void draw_label(Picture& picture, const std::string& text, int x_px, int y_px, const Color& color);

/// Mixes a rectangle, cut to the picture, with this share of a colour.
void tint(Picture& picture, int left_px, int top_px, int width_px, int height_px,
          const Color& color, double share);

/// `color` with this share of `other`.
Color mixed(const Color& color, const Color& other, double share);

/// Writes `text` (ASCII) in white on a dark band along the picture's upper edge.
void add_caption(Picture& picture, const std::string& text);

/// Copies `part` into `picture` with its upper left corner at (left_px, top_px); what lies outside
/// is cut off.
void paste(const Picture& part, int left_px, int top_px, Picture& picture);

/// Each pixel as a square of factor × factor.
Picture enlarged(const Picture& picture, int factor);

/// The picture at another size, each pixel that of the nearest.
Picture resized(const Picture& picture, int width_px, int height_px);

/// Throws InputError where the file can't be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace avoidbench
