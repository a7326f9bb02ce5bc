#include "drawing/picture.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/output_file.hpp"

namespace avoidbench {
/// Text and scales have fixed sizes in pixels: bands of 22 px hold one line of text of 0.45 times
/// OpenCV's plain font, and helpers that draw into a band leave pictures alone that are too small
/// for it.
namespace {

std::size_t byte_count(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3;
}

/// The picture's own pixels as OpenCV sees them.
cv::Mat pixels(Picture& picture) {
  return {picture.height_px, picture.width_px, CV_8UC3, picture.rgb.data()};
}

/// The colours of the scale, from near to far.
cv::Mat scale_colors() {
  cv::Mat levels(1, 256, CV_8UC1), colors;
  // OpenCV's Turbo goes from blue to red; near is red here.
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(255 - i);
  cv::applyColorMap(levels, colors, cv::COLORMAP_TURBO);
  // applyColorMap() gives BGR; pictures are RGB.
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  return colors;
}

/// Viridis, from low to high.
cv::Mat height_colors() {
  cv::Mat levels(1, 256, CV_8UC1), colors;
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(levels, colors, cv::COLORMAP_VIRIDIS);
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  return colors;
}

// Sixteenths of a pixel: finer than LINE_AA can show.
constexpr int kFractionBits = 4;  ///< of coordinates that OpenCV draws at

/// OpenCV takes whole numbers with fraction bits, so that lines lie between pixels where they
/// should.
int fixed_point(double pixels) {
  return static_cast<int>(std::lround(std::ldexp(pixels, kFractionBits)));
}

cv::Scalar scalar(const Color& color) {
  return {static_cast<double>(color[0]), static_cast<double>(color[1]),
          static_cast<double>(color[2])};
}

/// A cv::Mat is a view, though it is passed by value: the picture's own pixels change.
void darken(cv::Mat image) { image.convertTo(image, -1, 0.35); }

void write_text(cv::Mat image, const std::string& text, cv::Point corner) {
  cv::putText(image, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar(255, 255, 255), 1,
              cv::LINE_AA);
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", value);
  return text;
}

}  // namespace

Picture make_picture(int width_px, int height_px) {
  AB_CHECK(width_px > 0 && height_px > 0, width_px, height_px);
  return {width_px, height_px, std::vector<std::uint8_t>(byte_count(width_px, height_px))};
}

Picture depth_picture(std::span<const float> depth_m, int width_px, int height_px, double nearest_m,
                      double farthest_m) {
  Picture picture = make_picture(width_px, height_px);
  AB_CHECK(depth_m.size() * 3 == picture.rgb.size(), depth_m.size(), width_px, height_px);
  AB_CHECK(nearest_m < farthest_m, nearest_m, farthest_m);
  // Grey is in no colour of the scale; black means that there is no return.
  constexpr std::uint8_t kInvalid = 96;
  const cv::Mat colors = scale_colors();
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const double depth = static_cast<double>(depth_m[i]);
    std::uint8_t* rgb = &picture.rgb[3 * i];
    if (std::isnan(depth)) {
      std::fill_n(rgb, 3, kInvalid);
    } else if (std::isfinite(depth)) {
      const double ratio = std::clamp((depth - nearest_m) / (farthest_m - nearest_m), 0.0, 1.0);
      const auto& color = colors.at<cv::Vec3b>(0, static_cast<int>(std::lround(255.0 * ratio)));
      std::copy_n(&color[0], 3, rgb);
    }
  }
  return picture;
}

void add_depth_scale(Picture& picture, double nearest_m, double farthest_m) {
  // At either end a margin for the text of a distance: "12.5 m".
  constexpr int kBand = 22, kMargin = 64;
  const int width = picture.width_px - 2 * kMargin;
  if (picture.height_px < 2 * kBand || width < kMargin) return;
  cv::Mat image = pixels(picture);
  const int top = picture.height_px - kBand;
  darken(image.rowRange(top, picture.height_px));
  // The 256 colours, stretched to the bar.
  cv::Mat bar;
  cv::resize(scale_colors(), bar, cv::Size(width, kBand - 12), 0, 0, cv::INTER_LINEAR);
  bar.copyTo(image(cv::Rect(kMargin, top + 6, bar.cols, bar.rows)));
  write_text(image, metres(nearest_m), {6, top + 16});
  write_text(image, metres(farthest_m), {picture.width_px - kMargin + 6, top + 16});
}

Color height_color(double ratio) {
  static const cv::Mat colors = height_colors();
  // In whole levels, as the table has them; interpolated colours would not be Viridis'.
  const int level = static_cast<int>(std::lround(255.0 * std::clamp(ratio, 0.0, 1.0)));
  const auto& color = colors.at<cv::Vec3b>(0, level);
  return {color[0], color[1], color[2]};
}

Color turbo_color(double ratio) {
  static const cv::Mat colors = scale_colors();  // from near, red, to far
  // scale_colors() begins with the near end, red; here 0 is blue, as usual for Turbo.
  const int level = static_cast<int>(std::lround(255.0 * (1.0 - std::clamp(ratio, 0.0, 1.0))));
  const auto& color = colors.at<cv::Vec3b>(0, level);
  return {color[0], color[1], color[2]};
}

void add_height_scale(Picture& picture, double highest_m) {
  constexpr int kBand = 22, kWidth = 120, kTextWidth = 60;
  const int left = picture.width_px - kWidth - kTextWidth;
  if (picture.height_px < 2 * kBand || left < 3 * kTextWidth) return;
  cv::Mat image = pixels(picture);
  const int top = picture.height_px - kBand;
  darken(image(cv::Rect(left - kTextWidth - 40, top, kWidth + 2 * kTextWidth + 40, kBand)));
  cv::Mat bar;
  cv::resize(height_colors(), bar, cv::Size(kWidth, kBand - 12), 0, 0, cv::INTER_LINEAR);
  bar.copyTo(image(cv::Rect(left, top + 6, bar.cols, bar.rows)));
  write_text(image, "height 0 m", {left - kTextWidth - 30, top + 16});
  write_text(image, metres(highest_m), {left + kWidth + 6, top + 16});
}

void add_scale_bar(Picture& picture, double pixels_per_m) {
  constexpr int kBand = 22;
  if (picture.height_px < 2 * kBand) return;
  double length_m = 1.0;  // 1, 2 or 5 times a power of ten: the longest within a quarter
  double power = 1e-3;
  // From a millimetre to hundreds of kilometres.
  for (int decade = 0; decade < 9; ++decade, power *= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step * power * pixels_per_m <= 0.25 * picture.width_px) length_m = step * power;
    }
  }
  cv::Mat image = pixels(picture);
  const int top = picture.height_px - kBand;
  const int length_px = static_cast<int>(std::lround(length_m * pixels_per_m));
  darken(image(cv::Rect(0, top, std::min(picture.width_px, length_px + 74), kBand)));
  cv::rectangle(image, cv::Rect(8, top + 8, length_px, 6), cv::Scalar(255, 255, 255), cv::FILLED);
  write_text(image, metres(length_m), {length_px + 16, top + 16});
}

void draw_line(Picture& picture, const std::vector<Eigen::Vector2d>& points, const Color& color,
               int width_px) {
  std::vector<cv::Point> fixed;
  fixed.reserve(points.size());
  for (const Eigen::Vector2d& point : points) {
    fixed.emplace_back(fixed_point(point.x()), fixed_point(point.y()));
  }
  cv::polylines(pixels(picture), fixed, false, scalar(color), width_px, cv::LINE_AA, kFractionBits);
}

void draw_disc(Picture& picture, const Eigen::Vector2d& center, double radius_px,
               const Color& color) {
  draw_circle(picture, center, radius_px, color, cv::FILLED);
}

void draw_circle(Picture& picture, const Eigen::Vector2d& center, double radius_px,
                 const Color& color, int width_px) {
  cv::circle(pixels(picture), {fixed_point(center.x()), fixed_point(center.y())},
             fixed_point(radius_px), scalar(color), width_px, cv::LINE_AA, kFractionBits);
}

void draw_text(Picture& picture, const std::string& text, int x_px, int y_px, const Color& color) {
  cv::putText(pixels(picture), text, {x_px, y_px}, cv::FONT_HERSHEY_SIMPLEX, 0.45, scalar(color), 1,
              cv::LINE_AA);
}

int text_width_px(const std::string& text) {
  int below_px = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &below_px).width;
}

void draw_label(Picture& picture, const std::string& text, int x_px, int y_px, const Color& color) {
  // What letters of this font take above and below their base line.
  constexpr int kMargin_px = 4, kAbove_px = 11, kBelow_px = 4;
  const int width = text_width_px(text);
  const int x = std::clamp(x_px, kMargin_px, std::max(kMargin_px, picture.width_px - width - 4));
  const int y = std::clamp(y_px, kAbove_px, std::max(kAbove_px, picture.height_px - kBelow_px));
  tint(picture, x - kMargin_px, y - kAbove_px - 2, width + 2 * kMargin_px,
       kAbove_px + kBelow_px + 4, {255, 255, 255}, 0.8);
  draw_text(picture, text, x, y, color);
}

Color mixed(const Color& color, const Color& other, double share) {
  Color result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::lround((1.0 - share) * color[i] + share * other[i]));
  }
  return result;
}

void tint(Picture& picture, int left_px, int top_px, int width_px, int height_px,
          const Color& color, double share) {
  const int right = std::min(picture.width_px, left_px + width_px);
  // Cut at the picture's edges: labels may lie across them.
  const int bottom = std::min(picture.height_px, top_px + height_px);
  for (int row = std::max(0, top_px); row < bottom; ++row) {
    for (int column = std::max(0, left_px); column < right; ++column) {
      std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(row) *
                                                static_cast<std::size_t>(picture.width_px) +
                                            static_cast<std::size_t>(column))];
      const Color now = mixed({rgb[0], rgb[1], rgb[2]}, color, share);
      std::copy(now.begin(), now.end(), rgb);
    }
  }
}

void add_caption(Picture& picture, const std::string& text) {
  constexpr int kBand = 22;
  if (picture.height_px < 2 * kBand) return;
  cv::Mat image = pixels(picture);
  darken(image.rowRange(0, kBand));
  write_text(image, text, {6, 16});
}

void paste(const Picture& part, int left_px, int top_px, Picture& picture) {
  const int from_x = std::max(0, -left_px);
  const int columns = std::min(part.width_px, picture.width_px - left_px) - from_x;
  // Nothing of it lies in the picture.
  if (columns <= 0) return;
  for (int y = std::max(0, -top_px); y < part.height_px && y + top_px < picture.height_px; ++y) {
    const auto from = part.rgb.begin() + 3 * (std::ptrdiff_t{y} * part.width_px + from_x);
    const std::ptrdiff_t to = std::ptrdiff_t{y + top_px} * picture.width_px + left_px + from_x;
    std::copy_n(from, 3 * columns, picture.rgb.begin() + 3 * to);
  }
}

Picture resized(const Picture& picture, int width_px, int height_px) {
  Picture result = make_picture(width_px, height_px);
  cv::Mat pixels_of_result = pixels(result);
  // A copy, since OpenCV takes no view of const pixels.
  Picture given = picture;
  // Nearest: a pixel of a depth image stays one colour, and none is invented at edges.
  cv::resize(pixels(given), pixels_of_result, pixels_of_result.size(), 0, 0, cv::INTER_NEAREST);
  return result;
}

Picture enlarged(const Picture& picture, int factor) {
  return resized(picture, picture.width_px * factor, picture.height_px * factor);
}

void write_png(const Picture& picture, const std::filesystem::path& file) {
  check_output_file(file);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width_px);
  image.height = static_cast<png_uint_32>(picture.height_px);
  image.format = PNG_FORMAT_RGB;
  AB_CHECK(picture.rgb.size() == byte_count(picture.width_px, picture.height_px));
  // libpng's simplified interface; it writes rows without padding for a stride of 0.
  if (png_image_write_to_file(&image, file.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0) {
    const std::string reason = image.message;
    png_image_free(&image);
    throw InputError(InputProblem{file.string(), 0, 0, "can't be written: " + reason});
  }
}

}  // namespace avoidbench
