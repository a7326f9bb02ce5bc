#include "base/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "base/digest.hpp"

namespace avoidbench {
namespace {

TEST(RandomStream, FirstDrawsArePinned) {
  RandomStream draws(0);
  EXPECT_EQ(draws.bits(), 11091344671253066420ULL);  // xoshiro256** seeded by SplitMix64 from 0
  EXPECT_EQ(draws.bits(), 13793997310169335082ULL);
}

/// A digest says only that they are others; the tests below say whether they are right.
TEST(RandomStream, DrawsOfEveryKindArePinned) {
  RandomStream draws(0);
  Digest digest;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    digest.add(draws.uniform());
    digest.add(draws.uniform(-2.0, 3.0));
    digest.add(draws.normal());
    digest.add(draws.below(7 + i));
  }
  std::vector<float> coarse(1003);
  draws.coarse_normals(coarse);
  digest.add_array(std::span<const float>(coarse));
  EXPECT_EQ(digest.hex(), "dd0bc53168555ad9f65288bbfec97e68a81bc8a2e199514bad21920377bf5eaf");
}

TEST(RandomStream, UniformHasItsMeanAndVariance) {
  RandomStream draws(3);
  double sum = 0.0, squares = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double x = draws.uniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 3.0, 0.003);
}

TEST(RandomStream, NormalHasItsMoments) {
  RandomStream draws(4);
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  constexpr int kCount = 400000;
  for (int i = 0; i < kCount; ++i) {
    const double x = draws.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 0.01);
  EXPECT_NEAR(fourths / kCount, 3.0, 0.1);
}

TEST(RandomStream, CoarseNormalsAreStandardNormals) {
  RandomStream draws(4);
  std::vector<float> values(1'000'003);
  draws.coarse_normals(values);
  double sum = 0.0, squares = 0.0, fourths = 0.0, neighbours = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto x = static_cast<double>(values[i]);
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    if (i > 0) neighbours += x * static_cast<double>(values[i - 1]);
    ASSERT_LT(std::abs(x), 3.8);
  }
  const auto count = static_cast<double>(values.size());
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1.0, 0.006);
  EXPECT_NEAR(fourths / count, 3.0, 0.03);
  EXPECT_NEAR(neighbours / count, 0.0, 0.005);
  // Values do not depend on how many are asked for at once, in whole fives.
  RandomStream first(7), second(7);
  std::vector<float> together(25), apart(25);
  first.coarse_normals(together);
  for (std::size_t i = 0; i < 25; i += 5) second.coarse_normals({&apart[i], 5});
  EXPECT_EQ(together, apart);
}

TEST(RandomStream, BelowIsUnbiasedAndInRange) {
  RandomStream draws(5);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts.at(draws.below(7));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 450);
}

TEST(StreamSeed, NamesSeedsAndIndicesAllMatter) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    seeds.insert(stream_seed(seed, "map"));
    seeds.insert(stream_seed(seed, "planner"));
    for (std::uint64_t index = 0; index < 50; ++index) seeds.insert(stream_seed(seed, index));
  }
  EXPECT_EQ(seeds.size(), 50U * 52U);
}

}  // namespace
}  // namespace avoidbench
