#include "base/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace avoidbench {
namespace {

TEST(RandomStream, FirstDrawsArePinned) {
  RandomStream draws(0);
  EXPECT_EQ(draws.bits(), 11091344671253066420ULL);  // xoshiro256** seeded by SplitMix64 from 0
  EXPECT_EQ(draws.bits(), 13793997310169335082ULL);
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
