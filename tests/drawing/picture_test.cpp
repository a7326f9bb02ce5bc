#include "drawing/picture.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

using Rgb = std::array<int, 3>;

Rgb pixel(const Picture& picture, std::size_t index) {
  return {picture.rgb[3 * index], picture.rgb[3 * index + 1], picture.rgb[3 * index + 2]};
}

TEST(Picture, DepthColoursTellNearFarNothingAndInvalid) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> depth{1.0F, 10.0F, inf, std::nanf(""), 0.5F, 50.0F};
  const Picture picture = depth_picture(depth, 3, 2, 1.0, 10.0);
  EXPECT_GT(pixel(picture, 0)[0], 2 * pixel(picture, 0)[2]);  // red
  EXPECT_GT(pixel(picture, 1)[2], pixel(picture, 1)[1]);      // blue
  EXPECT_EQ(pixel(picture, 2), (Rgb{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 3), (Rgb{96, 96, 96}));
  EXPECT_EQ(pixel(picture, 4), pixel(picture, 0));  // clamped
  EXPECT_EQ(pixel(picture, 5), pixel(picture, 1));
}

TEST(Picture, CaptionAndScaleStayInTheirBands) {
  Picture picture = make_picture(400, 100);
  std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{200});
  add_caption(picture, "forest, seed 1");
  add_depth_scale(picture, 0.0, 15.0);
  EXPECT_EQ(pixel(picture, 50 * 400 + 200), (Rgb{200, 200, 200}));
  EXPECT_EQ(pixel(picture, 399), (Rgb{70, 70, 70}));  // the caption's band
  EXPECT_NE(pixel(picture, 90 * 400 + 70), pixel(picture, 90 * 400 + 320));
}

Picture filled(int width_px, int height_px, std::uint8_t level) {
  Picture picture = make_picture(width_px, height_px);
  std::fill(picture.rgb.begin(), picture.rgb.end(), level);
  return picture;
}

/// Of a picture whose pixels are grey, row by row: '.' where 0.
std::string grey_rows(const Picture& picture) {
  std::string rows;
  for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
    if (i > 0 && i % static_cast<std::size_t>(picture.width_px) == 0) rows += '\n';
    const int level = pixel(picture, i)[0];
    rows += level == 0 ? '.' : static_cast<char>('0' + level);
  }
  return rows;
}

TEST(Picture, APartIsCutAtEachEdge) {
  Picture part = make_picture(2, 2);
  for (std::size_t i = 0; i < part.rgb.size(); ++i)
    part.rgb[i] = static_cast<std::uint8_t>(1 + i / 3);
  const auto pasted = [&](int left_px, int top_px) {
    Picture picture = make_picture(3, 2);
    paste(part, left_px, top_px, picture);
    return grey_rows(picture);
  };
  EXPECT_EQ(pasted(0, 0), "12.\n34.");
  EXPECT_EQ(pasted(1, 1), "...\n.12");
  EXPECT_EQ(pasted(2, 0), "..1\n..3");
  EXPECT_EQ(pasted(-1, -1), "4..\n...");
  EXPECT_EQ(pasted(3, 0), "...\n...");
  EXPECT_EQ(pasted(-2, 0), "...\n...");
  EXPECT_EQ(pasted(0, 2), "...\n...");
}

TEST(Picture, ATintIsCutAtEachEdge) {
  const auto tinted = [&](int left_px, int top_px) {
    Picture picture = make_picture(3, 2);
    tint(picture, left_px, top_px, 2, 1, {4, 4, 4}, 0.5);
    return grey_rows(picture);
  };
  EXPECT_EQ(tinted(0, 0), "22.\n...");
  EXPECT_EQ(tinted(1, 1), "...\n.22");
  EXPECT_EQ(tinted(2, 1), "...\n..2");
  EXPECT_EQ(tinted(-1, 0), "2..\n...");
  EXPECT_EQ(tinted(-1, -1), "...\n...");
}

TEST(Picture, EnlargedPixelsAreSquares) {
  Picture picture = make_picture(2, 1);
  std::fill_n(picture.rgb.begin(), 3, std::uint8_t{7});
  EXPECT_EQ(grey_rows(enlarged(picture, 2)), "77..\n77..");
}

/// How many pixels of these columns and rows are not of this level.
int changed(const Picture& picture, int from_x, int to_x, int from_y, int to_y, int level) {
  int count = 0;
  for (int y = from_y; y < to_y; ++y) {
    for (int x = from_x; x < to_x; ++x) {
      const auto i = static_cast<std::size_t>(y * picture.width_px + x);
      count += pixel(picture, i) == Rgb{level, level, level} ? 0 : 1;
    }
  }
  return count;
}

/// The bands that scales stand on are the picture at this share of its brightness.
int darkened(int level) {
  Picture picture = filled(200, 60, static_cast<std::uint8_t>(level));
  add_caption(picture, "");
  return pixel(picture, 0)[0];
}

TEST(Picture, ScalesHaveTextAtBothEnds) {
  const int dark = darkened(200);
  ASSERT_LT(dark, 200);
  Picture depth = filled(400, 44, 200);  // the lowest that has room for it
  add_depth_scale(depth, 0.5, 12.5);
  EXPECT_EQ(changed(depth, 0, 400, 0, 22, 200), 0);
  EXPECT_GT(changed(depth, 4, 60, 22, 44, dark), 20);
  EXPECT_GT(changed(depth, 340, 400, 22, 44, dark), 20);
  const Rgb near_end = pixel(depth, 33 * 400 + 66), far_end = pixel(depth, 33 * 400 + 333);
  EXPECT_GT(near_end[0], near_end[2]);  // red
  EXPECT_GT(far_end[2], far_end[1]);    // blue
  Picture too_low = filled(400, 43, 200);
  add_depth_scale(too_low, 0.5, 12.5);
  add_height_scale(too_low, 9.0);
  add_scale_bar(too_low, 10.0);
  add_caption(too_low, "caption");
  EXPECT_EQ(changed(too_low, 0, 400, 0, 43, 200), 0);
  Picture height = filled(400, 44, 200);
  add_height_scale(height, 9.0);
  EXPECT_GT(changed(height, 130, 215, 22, 44, dark), 60);  // "height 0 m"
  EXPECT_GT(changed(height, 345, 400, 22, 44, dark), 20);  // "9 m"
  const Rgb lowest = pixel(height, 33 * 400 + 222), highest = pixel(height, 33 * 400 + 338);
  EXPECT_NEAR(lowest[2], height_color(0.0)[2], 8);
  EXPECT_NEAR(highest[0], height_color(1.0)[0], 8);
}

TEST(Picture, AScaleBarHasARoundLengthWithinAQuarter) {
  for (const auto& [pixels_per_m, length_px] :
       {std::pair(10.0, 100), std::pair(9.0, 90), std::pair(30.0, 60), std::pair(0.011, 55)}) {
    Picture picture = filled(400, 60, 0);
    add_scale_bar(picture, pixels_per_m);
    int white = 0;
    for (int x = 0; x < 400; ++x) {
      white += pixel(picture, static_cast<std::size_t>(48 * 400 + x)) == Rgb{255, 255, 255};
      if (white > 0 && pixel(picture, static_cast<std::size_t>(48 * 400 + x)) == Rgb{0, 0, 0})
        break;
    }
    EXPECT_EQ(white, length_px) << pixels_per_m;
  }
}

TEST(Picture, ALabelIsMovedIntoThePicture) {
  for (const auto& [x, y] : {std::pair(-50, -50), std::pair(500, 500), std::pair(60, 30)}) {
    Picture picture = make_picture(120, 60);
    draw_label(picture, "label", x, y, {255, 0, 0});
    int red = 0;
    for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
      red += pixel(picture, i)[0] > 150 && pixel(picture, i)[1] < 100;
    }
    EXPECT_GT(red, 40) << x;
  }
  EXPECT_GT(text_width_px("labels"), text_width_px("label"));
}

TEST(Picture, ColoursAreThoseOfTheirScales) {
  EXPECT_EQ(height_color(0.0), (Color{68, 1, 84}));  // Viridis' ends
  EXPECT_EQ(height_color(1.0), (Color{253, 231, 37}));
  EXPECT_EQ(height_color(-3.0), height_color(0.0));
  EXPECT_EQ(height_color(3.0), height_color(1.0));
  EXPECT_GT(turbo_color(0.9)[0], turbo_color(0.9)[2]);
  EXPECT_GT(turbo_color(0.1)[2], turbo_color(0.1)[0]);
  EXPECT_EQ(mixed({0, 100, 200}, {100, 100, 100}, 0.25), (Color{25, 100, 175}));
}

TEST(Picture, PngReadsBackToTheSamePixels) {
  Picture picture = make_picture(7, 5);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>(2 * i);
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("avoidbench_picture_" + std::to_string(::getpid()) + ".png");
  write_png(picture, file);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0);
  image.format = PNG_FORMAT_RGB;
  EXPECT_EQ(image.width, 7U);
  EXPECT_EQ(image.height, 5U);
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, picture.rgb);
  std::filesystem::remove(file);
}

TEST(Picture, AFileThatCantBeWrittenIsAnInputError) {
  EXPECT_THROW(write_png(make_picture(2, 2), "/nowhere/p.png"), InputError);
}

}  // namespace
}  // namespace avoidbench
