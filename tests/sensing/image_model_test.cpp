#include "sensing/image_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace avoidbench {
namespace {

constexpr std::size_t kPixelCount = 200'000;

/// The linear light that an 8-bit sRGB value stands for.
double linear(std::uint8_t value) {
  const double encoded = value / 255.0;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

struct Moments {
  double mean = 0.0, sigma = 0.0;
};

Moments developed(const ImageSpec& image, float level) {
  const std::vector<float> light(kPixelCount, level), shares(kPixelCount, 1.0F);
  std::vector<std::uint8_t> pixels(kPixelCount);
  RandomStream random(3);
  develop(image, light, shares, 1.0, random, pixels);
  double sum = 0.0, squares = 0.0;
  for (const std::uint8_t pixel : pixels) {
    sum += linear(pixel);
    squares += linear(pixel) * linear(pixel);
  }
  const double mean = sum / kPixelCount;
  return {mean, std::sqrt(squares / kPixelCount - mean * mean)};
}

TEST(ImageModel, NoiseHasTheVarianceOfItsElectrons) {
  for (const double full_well_e : {500.0, 2000.0}) {
    for (const double read_noise_e : {0.0, 20.0}) {
      for (const float level : {0.2F, 0.5F}) {
        ImageSpec image;
        image.full_well_e = full_well_e;
        image.read_noise_e = read_noise_e;
        const Moments seen = developed(image, level);
        const double electrons = static_cast<double>(level) * full_well_e;
        const double expected = std::sqrt(electrons + read_noise_e * read_noise_e) / full_well_e;
        EXPECT_NEAR(seen.mean, static_cast<double>(level), 0.002);
        EXPECT_NEAR(seen.sigma, expected, 0.02 * expected) << full_well_e << " " << read_noise_e;
      }
    }
  }
}

TEST(ImageModel, WithoutNoiseItIsTheSrgbCurve) {
  ImageSpec image;
  image.full_well_e = 0.0;
  std::vector<float> light;
  for (int i = 0; i <= 1000; ++i) light.push_back(static_cast<float>(i) / 1000.0F);
  const std::vector<float> shares(light.size(), 1.0F);
  std::vector<std::uint8_t> pixels(light.size());
  RandomStream random(1);
  develop(image, light, shares, 1.0, random, pixels);
  EXPECT_EQ(pixels.front(), 0);
  EXPECT_EQ(pixels.back(), 255);
  for (std::size_t i = 1; i < light.size(); ++i) EXPECT_GE(pixels[i], pixels[i - 1]);
  for (std::size_t i = 20; i < light.size(); ++i) {
    EXPECT_NEAR(linear(pixels[i]), static_cast<double>(light[i]), 0.006);
  }
}

TEST(ImageModel, BrighterThanWhiteIsWhiteAndDarkerThanBlackIsBlack) {
  ImageSpec image;
  image.full_well_e = 100.0;
  const std::vector<float> light{50.0F, 0.0F}, shares(2, 1.0F);
  std::vector<std::uint8_t> pixels(2);
  RandomStream random(1);
  for (int i = 0; i < 100; ++i) {
    develop(image, light, shares, 1.0, random, pixels);
    EXPECT_EQ(pixels[0], 255);
  }
}

TEST(ImageModel, VignettingFollowsTheFourthPowerOfTheCosine) {
  const Pinhole camera = make_pinhole(201, 101, math::kPi / 2.0, 10.0);
  ImageSpec image;
  image.vignetting = 1.0;
  const std::vector<float> full = vignette(image, camera);
  EXPECT_EQ(full[50 * 201 + 100], 1.0F);  // on the axis
  const double u = 100.0 / camera.fx_px;
  const double cosine = 1.0 / std::sqrt(1.0 + u * u);
  EXPECT_NEAR(full[50 * 201 + 200], std::pow(cosine, 4.0), 1e-6);
  image.vignetting = 0.25;
  EXPECT_NEAR(vignette(image, camera)[50 * 201 + 200], 1.0 - 0.25 * (1.0 - std::pow(cosine, 4.0)),
              1e-6);
  image.vignetting = 0.0;
  for (const float share : vignette(image, camera)) EXPECT_EQ(share, 1.0F);
}

TEST(ImageModel, ExposureBringsTheMeanToItsAim) {
  ImageSpec image;
  image.brightness = 0.3;
  EXPECT_NEAR(0.1 * exposure_gain(image, 0.1), 0.3, 1e-12);
  EXPECT_EQ(exposure_gain(image, 0.0), 16.0);
  EXPECT_EQ(exposure_gain(image, 1e9), 1.0 / 16.0);
  image.brightness = 0.0;
  EXPECT_EQ(exposure_gain(image, 0.1), 1.0);
}

}  // namespace
}  // namespace avoidbench
