#include "maps/avoidbench_field.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "maps/dotnet_random.hpp"
#include "maps/generators.hpp"
#include "maps/glibc_random.hpp"

namespace avoidbench {
namespace {

/// The first five of the sequence after srand(seed).
std::vector<std::int32_t> glibc(std::uint32_t seed) {
  GlibcRandom random(seed);
  std::vector<std::int32_t> values;
  for (int i = 0; i < 5; ++i) values.push_back(random.next());
  return values;
}

// Printed by glibc 2.36.
TEST(GlibcRandom, DrawsWhatGlibcDoes) {
  using Values = std::vector<std::int32_t>;
  EXPECT_EQ(glibc(1), (Values{1804289383, 846930886, 1681692777, 1714636915, 1957747793}));
  EXPECT_EQ(glibc(0), glibc(1));
  EXPECT_EQ(glibc(42), (Values{71876166, 708592740, 1483128881, 907283241, 442951012}));
  EXPECT_EQ(glibc(4000000000U),
            (Values{1111130805, 1380198982, 1306113867, 1557021840, 1956528986}));
  EXPECT_EQ(glibc(2147483648U), (Values{1336741213, 1210407648, 1447044896, 337392383, 82502902}));
}

TEST(GlibcRandom, KeepsToTheRecurrenceWithoutItsLowestBit) {
  GlibcRandom random(7);
  std::vector<std::uint32_t> values;
  for (int i = 0; i < 2000; ++i) values.push_back(static_cast<std::uint32_t>(random.next()));
  for (std::size_t i = 31; i < values.size(); ++i) {
    const std::uint32_t sum = values[i - 31] + values[i - 3];
    const std::uint32_t carry = (values[i] - sum) & 0x7fffffffU;  // of the two lost bits
    EXPECT_LE(carry, 1U) << i;
  }
}

TEST(DotnetRandom, DrawsWhatDotnetDoes) {
  EXPECT_EQ(DotnetRandom(0).next(), 1559595546);
  EXPECT_EQ(DotnetRandom(42).next(), 1434747710);
  EXPECT_DOUBLE_EQ(DotnetRandom(0).next_double(), 0.7262432699679598);
  EXPECT_EQ(DotnetRandom(-42).next(), 1434747710);  // the seed's sign does not count
  EXPECT_EQ(DotnetRandom(INT32_MIN).next(), DotnetRandom(INT32_MAX).next());
}

TEST(DotnetRandom, WholeNumbersAreTheFractionsScaled) {
  DotnetRandom whole(5), fractions(5);
  for (int i = 0; i < 1000; ++i) {
    const int value = whole.next(-3, 100);
    EXPECT_EQ(value, -3 + static_cast<int>(fractions.next_double() * 103.0));
    EXPECT_GE(value, -3);
    EXPECT_LT(value, 100);
  }
  EXPECT_EQ(DotnetRandom(1).next(7, 7), 7);
}

struct Golden {
  std::uint64_t map;
  const char* line;
};

std::string line(const AvoidbenchField& field) {
  char text[200];
  const auto& p = field.positions_m;
  const auto at = [&](std::size_t i, int axis) { return static_cast<double>(p[i][axis]); };
  std::snprintf(text, sizeof text, "%.4f %d %zu (%.3f,%.3f) (%.3f,%.3f) (%.3f,%.3f)",
                static_cast<double>(field.radius_m), field.map_seed, p.size(), at(0, 0), at(0, 1),
                at(1, 0), at(1, 1), at(2, 0), at(2, 1));
  return text;
}

// Radius, map seed, count and first positions by an independent implementation.
constexpr Golden kOutdoor[] = {
    {1, "3.2680 59 1333 (0.000,1.330) (1.417,5.064) (3.374,1.210)"},
    {2, "4.7720 119 616 (0.000,151.615) (7.098,148.428) (5.248,158.176)"},
    {3, "2.1960 197 2875 (0.000,74.985) (2.316,78.120) (2.884,73.344)"},
    {4, "2.1160 18 3116 (0.000,55.969) (3.236,55.374) (1.768,52.942)"}};
constexpr Golden kIndoor[] = {{1, "3.4600 143 35 (0.000,21.699) (0.644,16.180) (2.450,27.176)"},
                              {2, "4.1800 38 23 (0.000,9.887) (6.040,7.145) (5.016,15.538)"},
                              {3, "2.8450 7 49 (0.000,19.828) (5.393,21.301) (2.671,16.384)"},
                              {4, "3.4000 99 38 (0.000,29.035) (3.086,26.884) (0.301,23.084)"}};

TEST(AvoidbenchField, OutdoorFieldsAreTheOriginals) {
  for (const Golden& golden : kOutdoor) {
    EXPECT_EQ(line(make_avoidbench_field(field_suite(AvoidbenchForestSpec{}), golden.map)),
              golden.line);
  }
}

TEST(AvoidbenchField, IndoorFieldsAreTheOriginals) {
  for (const Golden& golden : kIndoor) {
    EXPECT_EQ(line(make_avoidbench_field(field_suite(AvoidbenchIndoorSpec{}), golden.map)),
              golden.line);
  }
}

TEST(AvoidbenchField, NoTwoPlacesAreNearerThanTheRadius) {
  for (std::uint64_t map = 5; map < 15; ++map) {
    const auto field = make_avoidbench_field(field_suite(AvoidbenchIndoorSpec{}), map);
    const auto& places = field.positions_m;
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_TRUE(places[i].x() >= 0.0F && places[i].x() < 20.0F) << map;
      EXPECT_TRUE(places[i].y() >= 0.0F && places[i].y() < 30.0F) << map;
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((places[i] - places[j]).norm(), field.radius_m * (1.0F - 1e-6F)) << map;
      }
    }
  }
}

}  // namespace
}  // namespace avoidbench
