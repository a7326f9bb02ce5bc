#include "sensing/census_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "render/ray_tracing_isa.hpp"
#include "sensing/census_internals.hpp"

namespace avoidbench {
namespace {

using Grey = std::vector<std::uint8_t>;
using Disparity = std::vector<std::int16_t>;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct StereoPair {
  int width_px, height_px;
  Grey left, right;
};

// --- A plain matcher: the definition, pixel by pixel. ---

std::uint32_t census_at(const Grey& image, int width, int height, int x, int y,
                        CensusWindow window) {
  const auto pixel = [&](int px, int py) {
    const bool inside = px >= 0 && px < width && py >= 0 && py < height;
    return inside ? image[index(py * width + px)] : 0;
  };
  std::uint32_t bits = 0;
  const auto [reach_x, reach_y] =
      window == CensusWindow::five_by_five ? std::pair(2, 2) : std::pair(4, 3);
  for (int dy = -reach_y; dy <= 0; ++dy) {
    for (int dx = -reach_x; dx <= reach_x; ++dx) {
      if (dy == 0 && dx >= 0) break;
      bits = 2 * bits + (pixel(x + dx, y + dy) >= pixel(x - dx, y - dy) ? 1 : 0);
    }
  }
  return bits;
}

/// width × height × disparities.
struct Volume {
  int width, height, disparities;
  std::vector<int> values;
  Volume(int w, int h, int d) : width(w), height(h), disparities(d), values(index(w * h * d)) {}
  int& at(int x, int y, int d) { return values[index((y * width + x) * disparities + d)]; }
};

Volume plain_costs(const StereoPair& pair, const CensusSettings& settings) {
  Volume costs(pair.width_px, pair.height_px, settings.disparities);
  const auto census = [&](const Grey& image, int x, int y) {
    return census_at(image, pair.width_px, pair.height_px, x, y, settings.window);
  };
  for (int y = 0; y < pair.height_px; ++y) {
    for (int x = 0; x < pair.width_px; ++x) {
      const std::uint32_t left = census(pair.left, x, y);
      for (int d = 0; d < settings.disparities; ++d) {
        costs.at(x, y, d) = std::popcount(left ^ census(pair.right, std::max(x - d, 0), y));
      }
    }
  }
  return costs;
}

/// Adds the path whose pixels follow each other by (dx, dy).
void add_path(Volume& costs, int dx, int dy, const CensusSettings& settings, Volume& sums) {
  Volume path(costs.width, costs.height, costs.disparities);
  const int last = costs.disparities - 1;
  for (int i = 0; i < costs.height; ++i) {
    for (int j = 0; j < costs.width; ++j) {
      const int y = dy < 0 ? costs.height - 1 - i : i;
      const int x = dx < 0 ? costs.width - 1 - j : j;
      const bool starts =
          x - dx < 0 || x - dx >= costs.width || y - dy < 0 || y - dy >= costs.height;
      int least = 1 << 20;
      for (int d = 0; d <= last && !starts; ++d) {
        least = std::min(least, path.at(x - dx, y - dy, d));
      }
      for (int d = 0; d <= last; ++d) {
        int value = costs.at(x, y, d);
        if (!starts) {
          int before = std::min(path.at(x - dx, y - dy, d), least + settings.large_penalty);
          for (const int beside : {d - 1, d + 1}) {
            if (beside < 0 || beside > last) continue;
            before = std::min(before, path.at(x - dx, y - dy, beside) + settings.small_penalty);
          }
          value += before - least;
        }
        path.at(x, y, d) = value;
        sums.at(x, y, d) += value;
      }
    }
  }
}

Disparity plain_median(const Disparity& image, int width, int height) {
  Disparity out;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::vector<std::int16_t> values;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int px = std::clamp(x + dx, 0, width - 1);
          const int py = std::clamp(y + dy, 0, height - 1);
          values.push_back(image[index(py * width + px)]);
        }
      }
      std::sort(values.begin(), values.end());
      out.push_back(values[4]);
    }
  }
  return out;
}

int plain_winner(Volume& sums, int x, int y, const CensusSettings& settings) {
  int best = 0;
  for (int d = 1; d < sums.disparities; ++d) {
    if (sums.at(x, y, d) < sums.at(x, y, best)) best = d;
  }
  for (int d = 0; d < sums.disparities; ++d) {
    const int kept = sums.at(x, y, d) * (100 - settings.uniqueness_percent);
    if (settings.uniqueness_percent > 0 && std::abs(d - best) > 1 &&
        kept < 100 * sums.at(x, y, best)) {
      return kInvalidDisparity;
    }
  }
  if (!settings.subpixel || best == 0 || best + 1 == sums.disparities) return 16 * best;
  const double before = sums.at(x, y, best - 1);
  const double after = sums.at(x, y, best + 1);
  const double slope = std::max(before, after) - sums.at(x, y, best);
  if (slope == 0.0) return 16 * best;
  const double offset = 16.0 * (before - after) / (2.0 * slope);
  return 16 * best + static_cast<int>(std::floor(offset + 0.5));
}

Disparity plain_match(const StereoPair& pair, const CensusSettings& settings) {
  const int width = pair.width_px;
  const int height = pair.height_px;
  Volume costs = plain_costs(pair, settings);
  Volume sums(width, height, settings.disparities);
  constexpr int kDirections[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                     {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  for (int i = 0; i < settings.paths; ++i) {
    add_path(costs, kDirections[i][0], kDirections[i][1], settings, sums);
  }
  Disparity left;
  Disparity right;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      left.push_back(static_cast<std::int16_t>(plain_winner(sums, x, y, settings)));
      int best = 0;
      for (int d = 1; d < settings.disparities && x + d < width; ++d) {
        if (sums.at(x + d, y, d) < sums.at(x + best, y, best)) best = d;
      }
      right.push_back(static_cast<std::int16_t>(best));
    }
  }
  left = plain_median(left, width, height);
  right = plain_median(right, width, height);
  if (settings.left_right_tolerance_px < 0) return left;
  Disparity out;
  for (int i = 0; i < width * height; ++i) {
    const std::int16_t value = left[index(i)];
    const int d = (value + 8) / 16;
    const bool valid = value >= 0 && i % width >= d &&
                       std::abs(d - right[index(i - d)]) <= settings.left_right_tolerance_px;
    out.push_back(valid ? value : kInvalidDisparity);
  }
  return out;
}

// --- Images. ---

/// Texture, as seen by both cameras with disparities that change in steps, and noise.
StereoPair random_pair(int width_px, int height_px, int most_px, int noise, std::uint64_t seed) {
  RandomStream random(seed);
  const std::size_t pixels = index(width_px * height_px);
  StereoPair pair{width_px, height_px, Grey(pixels), Grey(pixels)};
  for (std::uint8_t& value : pair.right) {
    value = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  }
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const int d = (x / 11 * 5 + y / 7 * 3) % (most_px + 1);
      const int from = y * width_px + std::max(x - d, 0);
      const double value =
          pair.right[index(from)] + random.uniform(-noise, static_cast<double>(noise));
      pair.left[index(y * width_px + x)] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
    }
  }
  return pair;
}

/// The left image is the right one moved to the right by `shift_px`.
StereoPair shifted_pair(int width_px, int height_px, int shift_px) {
  StereoPair pair = random_pair(width_px, height_px, 0, 0, 3);
  RandomStream random(4);
  for (int y = 0; y < height_px; ++y) {
    const std::size_t row = index(y * width_px);
    for (int x = width_px - 1; x >= 0; --x) {
      pair.left[row + index(x)] = x >= shift_px
                                      ? pair.right[row + index(x - shift_px)]
                                      : static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
    }
  }
  return pair;
}

Disparity match(const census::Kernels& kernels, const StereoPair& pair,
                const CensusSettings& settings, CensusWorkspace& workspace) {
  Disparity out(pair.left.size(), 12345);
  census::match(kernels, settings, pair.left, pair.right, pair.width_px, pair.height_px, workspace,
                out);
  return out;
}

Disparity match(const StereoPair& pair, const CensusSettings& settings) {
  CensusWorkspace workspace;
  Disparity out(pair.left.size(), 12345);
  match_census(settings, pair.left, pair.right, pair.width_px, pair.height_px, workspace, out);
  return out;
}

void expect_plain(const StereoPair& pair, const CensusSettings& settings,
                  CensusWorkspace& workspace) {
  SCOPED_TRACE(std::to_string(pair.width_px) + "x" + std::to_string(pair.height_px) + "x" +
               std::to_string(settings.disparities) + " paths " + std::to_string(settings.paths) +
               (settings.window == CensusWindow::five_by_five ? " 5x5" : " 9x7") + " unique by " +
               std::to_string(settings.uniqueness_percent) +
               (settings.subpixel ? " subpixel" : "") + " tolerance " +
               std::to_string(settings.left_right_tolerance_px));
  const Disparity expected = plain_match(pair, settings);
  EXPECT_EQ(match(census::kPortableKernels, pair, settings, workspace), expected);
  if (has_avx2()) {
    EXPECT_EQ(match(census::kAvx2Kernels, pair, settings, workspace), expected);
  }
}

struct Size {
  int width_px, height_px, disparities;
};

/// Small, narrow and odd ones, and every number of vectors a pixel.
constexpr std::array<Size, 17> kSizes{{{37, 29, 16},
                                       {64, 48, 32},
                                       {100, 33, 64},
                                       {1, 1, 16},
                                       {1, 9, 32},
                                       {9, 1, 16},
                                       {2, 3, 48},
                                       {5, 40, 64},
                                       {33, 7, 48},
                                       {65, 6, 80},
                                       {97, 5, 96},
                                       {130, 5, 112},
                                       {150, 4, 128},
                                       {170, 4, 160},
                                       {200, 4, 192},
                                       {260, 4, 224},
                                       {300, 5, 256}}};

// --- Tests. ---

TEST(CensusMatcher, IsThePlainMatcherToTheByte) {
  CensusWorkspace workspace;  // one for all: what is left over from a frame must not matter
  std::uint64_t seed = 1;
  for (const Size& size : kSizes) {
    const StereoPair pair = random_pair(size.width_px, size.height_px, size.disparities, 6, ++seed);
    for (const int paths : {4, 8}) {
      for (const bool subpixel : {false, true}) {
        for (const int tolerance_px : {-1, 1}) {
          expect_plain(pair,
                       {.disparities = size.disparities,
                        .paths = paths,
                        .subpixel = subpixel,
                        .left_right_tolerance_px = tolerance_px},
                       workspace);
        }
      }
    }
  }
}

TEST(CensusMatcher, IsThePlainMatcherWithASmallWindowAndUniqueWinners) {
  CensusWorkspace workspace;
  std::uint64_t seed = 100;
  for (const Size& size : kSizes) {
    // Noise enough for winners that are not unique.
    const StereoPair pair =
        random_pair(size.width_px, size.height_px, size.disparities, 40, ++seed);
    for (const int paths : {4, 8}) {
      for (const int uniqueness_percent : {0, 10, 60}) {
        for (const bool subpixel : {false, true}) {
          for (const int tolerance_px : {-1, 1}) {
            expect_plain(pair,
                         {.window = CensusWindow::five_by_five,
                          .disparities = size.disparities,
                          .paths = paths,
                          .small_penalty = 5,
                          .large_penalty = 32,
                          .subpixel = subpixel,
                          .uniqueness_percent = uniqueness_percent,
                          .left_right_tolerance_px = tolerance_px},
                         workspace);
          }
        }
      }
    }
  }
}

TEST(CensusMatcher, IsThePlainMatcherOnPureNoiseAndWithOtherPenalties) {
  CensusWorkspace workspace;
  StereoPair pair = random_pair(83, 21, 0, 0, 5);
  pair.left = random_pair(83, 21, 0, 0, 6).left;
  constexpr int kPenalties[][2] = {{0, 0}, {0, 96}, {96, 96}, {1, 3}, {20, 50}};
  for (const auto& penalties : kPenalties) {
    for (const int disparities : {32, 80, 144}) {
      expect_plain(pair,
                   {.disparities = disparities,
                    .small_penalty = penalties[0],
                    .large_penalty = penalties[1],
                    .subpixel = true,
                    .left_right_tolerance_px = 0},
                   workspace);
    }
  }
}

/// Extreme values: every comparison of the census and the largest sums.
TEST(CensusMatcher, IsThePlainMatcherOnBlackAndWhite) {
  CensusWorkspace workspace;
  StereoPair pair = random_pair(70, 19, 8, 0, 8);
  for (std::uint8_t& value : pair.left) value = value < 128 ? 0 : 255;
  for (std::uint8_t& value : pair.right) value = value < 128 ? 255 : 0;
  for (const int paths : {4, 8}) {
    expect_plain(pair, {.disparities = 64, .paths = paths}, workspace);
  }
}

TEST(CensusMatcher, VersionsAgreeOnALargeImage) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  const StereoPair pair = random_pair(320, 240, 60, 10, 9);
  CensusWorkspace workspace;
  for (const int paths : {4, 8}) {
    for (const int disparities : {64, 128}) {
      for (const CensusWindow window : {CensusWindow::nine_by_seven, CensusWindow::five_by_five}) {
        const CensusSettings settings{.window = window,
                                      .disparities = disparities,
                                      .paths = paths,
                                      .subpixel = true,
                                      .uniqueness_percent = 10};
        EXPECT_EQ(match(census::kPortableKernels, pair, settings, workspace),
                  match(census::kAvx2Kernels, pair, settings, workspace));
      }
    }
  }
}

TEST(CensusMatcher, FindsAShiftEverywhereButAtTheBorder) {
  for (const int shift_px : {0, 1, 7, 16, 31, 63}) {
    const StereoPair pair = shifted_pair(160, 60, shift_px);
    for (const int paths : {4, 8}) {
      const Disparity found = match(pair, {.disparities = 64, .paths = paths});
      // The census window sees the strip that only the left camera sees.
      for (int y = 4; y < pair.height_px - 4; ++y) {
        for (int x = shift_px + 8; x < pair.width_px - 5; ++x) {
          ASSERT_EQ(found[index(y * pair.width_px + x)], 16 * shift_px)
              << "at " << x << ", " << y << " shifted by " << shift_px << ", paths " << paths;
        }
      }
    }
  }
}

TEST(CensusMatcher, WhatOnlyTheLeftCameraSeesIsInvalid) {
  const int shift_px = 30;
  const StereoPair pair = shifted_pair(160, 60, shift_px);
  const Disparity found = match(pair, {.disparities = 64});
  int invalid = 0;
  for (int y = 0; y < pair.height_px; ++y) {
    for (int x = 0; x < shift_px - 5; ++x) {
      if (found[index(y * pair.width_px + x)] == kInvalidDisparity) ++invalid;
    }
  }
  EXPECT_GT(invalid, pair.height_px * (shift_px - 5) * 9 / 10);
}

TEST(CensusMatcher, ABlandImageIsInfinitelyFarAndNotInvalid) {
  const StereoPair pair{90, 40, Grey(90 * 40, 77), Grey(90 * 40, 77)};
  for (const int paths : {4, 8}) {
    for (const bool subpixel : {false, true}) {
      const Disparity found =
          match(pair, {.disparities = 64, .paths = paths, .subpixel = subpixel});
      EXPECT_EQ(std::count(found.begin(), found.end(), 0), 90 * 40);
    }
  }
}

/// Grey between random values 3 px apart, seen `offset_px` further to the right.
Grey smooth_texture(int width_px, int height_px, double offset_px) {
  RandomStream random(11);
  const int knots = width_px / 3 + 20;
  std::vector<double> values;
  for (int i = 0; i < knots * height_px; ++i) values.push_back(random.uniform(0.0, 255.0));
  Grey image;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double at = (x + offset_px) / 3.0;
      const int knot = static_cast<int>(at);
      const double t = (at - knot) * (at - knot) * (3.0 - 2.0 * (at - knot));
      const std::size_t i = index(y * knots + knot);
      image.push_back(static_cast<std::uint8_t>(values[i] * (1.0 - t) + values[i + 1] * t));
    }
  }
  return image;
}

TEST(CensusMatcher, SubpixelsComeNearerThanWholePixels) {
  const int width = 200;
  const int height = 60;
  int compared = 0;
  for (int sixteenths = 0; sixteenths < 16; sixteenths += 2) {
    const double d_px = 10.0 + sixteenths / 16.0;
    const StereoPair pair{width, height, smooth_texture(width, height, 0.0),
                          smooth_texture(width, height, d_px)};
    const auto mean_error_px = [&](bool subpixel) {
      const Disparity found = match(pair, {.disparities = 32, .subpixel = subpixel});
      double sum = 0.0;
      int count = 0;
      for (int y = 5; y < height - 5; ++y) {
        for (int x = 20; x < width - 20; ++x) {
          const int value = found[index(y * width + x)];
          if (value < 0) continue;
          sum += std::abs(value / 16.0 - d_px);
          ++count;
        }
      }
      EXPECT_GT(count, 9 * (width - 40) * (height - 10) / 10);
      return sum / count;
    };
    const double whole_px = mean_error_px(false);
    const double fine_px = mean_error_px(true);
    EXPECT_LT(fine_px, 0.2) << sixteenths;
    if (whole_px > 0.2) {
      ++compared;
      EXPECT_LT(fine_px, whole_px) << sixteenths;
    }
  }
  EXPECT_GE(compared, 4);
}

TEST(CensusMatcher, AWorkspaceIsAllocatedOnce) {
  CensusWorkspace workspace;
  const StereoPair large = random_pair(96, 40, 20, 5, 12);
  const StereoPair small = random_pair(50, 20, 20, 5, 13);
  const auto& kernels = census::kPortableKernels;
  const Disparity first = match(kernels, large, {.disparities = 64}, workspace);
  const std::uint8_t* memory = workspace.bytes.data();
  match(kernels, small, {.disparities = 32, .paths = 4}, workspace);
  EXPECT_EQ(match(kernels, large, {.disparities = 64}, workspace), first);
  EXPECT_EQ(workspace.bytes.data(), memory);
}

using CensusMatcherDeathTest = ::testing::Test;

TEST(CensusMatcherDeathTest, WrongSizesAndSettingsAbort) {
  const StereoPair pair = random_pair(20, 10, 4, 0, 14);
  StereoPair wrong = pair;
  wrong.right.pop_back();
  EXPECT_DEATH(match(wrong, {}), "right.size");
  wrong = pair;
  wrong.width_px = 21;
  EXPECT_DEATH(match(wrong, {}), "left.size");
  EXPECT_DEATH(match(StereoPair{0, 0, {}, {}}, {}), "width_px > 0");
  EXPECT_DEATH(match(pair, {.disparities = 8}), "disparities");
  EXPECT_DEATH(match(pair, {.disparities = 40}), "disparities");
  EXPECT_DEATH(match(pair, {.disparities = 272}), "disparities");
  EXPECT_DEATH(match(pair, {.paths = 5}), "paths");
  EXPECT_DEATH(match(pair, {.small_penalty = 97, .large_penalty = 97}), "penalty");
  EXPECT_DEATH(match(pair, {.small_penalty = 7, .large_penalty = 6}), "penalty");
  EXPECT_DEATH(match(pair, {.uniqueness_percent = 100}), "uniqueness_percent");
  EXPECT_DEATH(match(pair, {.left_right_tolerance_px = -2}), "tolerance");
}

}  // namespace
}  // namespace avoidbench
