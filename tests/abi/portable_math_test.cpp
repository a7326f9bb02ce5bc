#include "avoidbench/portable_math.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "base/math.hpp"
#include "base/random.hpp"

namespace {

namespace base = avoidbench::math;
namespace portable = avoidbench::portable;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

void expect_equal_functions(double x, double y) {
  EXPECT_TRUE(same_bits(portable::sin(x), base::sin(x))) << x;
  EXPECT_TRUE(same_bits(portable::cos(x), base::cos(x))) << x;
  EXPECT_TRUE(same_bits(portable::tan(x), base::tan(x))) << x;
  EXPECT_TRUE(same_bits(portable::atan(x), base::atan(x))) << x;
  EXPECT_TRUE(same_bits(portable::atan2(y, x), base::atan2(y, x))) << y << ' ' << x;
  EXPECT_TRUE(same_bits(portable::asin(x), base::asin(x))) << x;
  EXPECT_TRUE(same_bits(portable::acos(x), base::acos(x))) << x;
  EXPECT_TRUE(same_bits(portable::exp(x), base::exp(x))) << x;
  EXPECT_TRUE(same_bits(portable::log(x), base::log(x))) << x;
  EXPECT_TRUE(same_bits(portable::pow(std::abs(x), y), base::pow(std::abs(x), y))) << x << ' ' << y;
  EXPECT_TRUE(same_bits(portable::hypot(x, y), base::hypot(x, y))) << x << ' ' << y;
  EXPECT_TRUE(same_bits(portable::wrapped_angle(x), base::wrapped_angle(x))) << x;
}

TEST(PortableMath, IsBaseMathBitForBit) {
  avoidbench::RandomStream random = avoidbench::stream(5, "portable_math");
  for (const double scale : {1.0, 4.0, 50.0, 1e5, 1e-9}) {
    for (int i = 0; i < 20000; ++i) {
      const double x = random.uniform(-scale, scale);
      const double y = random.uniform(-scale, scale);
      expect_equal_functions(x, y);
    }
  }
}

TEST(PortableMath, AgreesAtTheEdges) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double edges[] = {0.0,      -0.0,          1.0,
                          -1.0,     portable::kPi, -portable::kPi,
                          0.4375,   2.4375,        1e7,
                          5e-324,   710.0,         -746.0,
                          infinity, -infinity,     std::numeric_limits<double>::quiet_NaN()};
  for (const double x : edges) {
    for (const double y : edges) expect_equal_functions(x, y);
  }
}

}  // namespace
