#include "metrics/find_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

/// 3 × parameter, off by up to ±0.6 by seed.
double rising(double parameter, std::uint64_t seed) {
  return 3.0 * parameter + 0.3 * (static_cast<double>(seed % 5) - 2.0);
}

TEST(FindMaps, KeepsTheSeedsWithinTheTolerance) {
  int calls = 0;
  std::set<std::pair<double, std::uint64_t>> asked;
  const MapTarget target{.measure =
                             [&](double parameter, std::uint64_t seed) {
                               ++calls;
                               EXPECT_TRUE(asked.insert({parameter, seed}).second);  // never twice
                               return rising(parameter, seed);
                             },
                         .wanted = 12.0,
                         .within = 0.4,
                         .lowest = 1.0,
                         .highest = 9.0,
                         .count = 4};
  const MapsFound found = find_maps(target);
  ASSERT_EQ(found.seeds.size(), 4U);
  for (const std::uint64_t seed : found.seeds) {
    EXPECT_NEAR(rising(found.parameter, seed), 12.0, 0.4);
  }
  // No earlier seed was passed over.
  for (std::uint64_t seed = 1; seed < found.seeds.back(); ++seed) {
    const bool is_kept = std::count(found.seeds.begin(), found.seeds.end(), seed) > 0;
    EXPECT_EQ(is_kept, std::abs(rising(found.parameter, seed) - 12.0) <= 0.4) << seed;
  }
  EXPECT_EQ(calls, static_cast<int>(found.tried.size()));
  // Both ends and halves between them, until one is nearer than a fifth of the tolerance.
  std::set<double> parameters;
  for (const MapTried& tried : found.tried) parameters.insert(tried.parameter);
  EXPECT_EQ(parameters, (std::set<double>{1.0, 9.0, 5.0, 3.0, 4.0}));
  EXPECT_EQ(std::count_if(found.tried.begin(), found.tried.end(),
                          [](const MapTried& tried) { return tried.is_accepted; }),
            4);
}

TEST(FindMaps, FollowsAMeasureThatFalls) {
  const MapTarget target{
      .measure = [](double parameter, std::uint64_t) { return 10.0 / parameter; },
      .wanted = 2.5,
      .within = 0.05,
      .lowest = 1.0,
      .highest = 20.0,
      .count = 2};
  const MapsFound found = find_maps(target);
  EXPECT_NEAR(found.parameter, 4.0, 0.08);
  EXPECT_EQ(found.seeds, (std::vector<std::uint64_t>{1, 2}));
}

TEST(FindMaps, SaysWhatThereIsWhereNoneFits) {
  const MapTarget target{
      .measure = rising, .wanted = 99.0, .within = 1.0, .lowest = 1.0, .highest = 9.0};
  try {
    find_maps(target);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the measure is 3 at 1 and 27 at 9"),
              std::string::npos)
        << error.what();
  }
}

TEST(FindMaps, GivesUpAfterTheLastSeed) {
  MapTarget target{
      .measure = rising, .wanted = 12.0, .within = 0.01, .lowest = 1.0, .highest = 9.0};
  target.count = 50;
  target.most_seeds = 20;
  const MapsFound found = find_maps(target);
  EXPECT_LT(found.seeds.size(), 50U);
  EXPECT_EQ(found.tried.back().map_seed, 20U);
}

}  // namespace
}  // namespace avoidbench
