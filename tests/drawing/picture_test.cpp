#include "drawing/picture.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

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
