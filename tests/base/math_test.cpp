#include "base/math.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/digest.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

/// |value - exact| in units of the last place of `exact`.
double ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double ulp = std::nextafter(std::abs(rounded), HUGE_VAL) - std::abs(rounded);
  return std::abs(static_cast<double>((static_cast<long double>(value) - exact) /
                                      static_cast<long double>(ulp)));
}

struct UnaryCase {
  const char* name;
  double (*ours)(double);
  long double (*exact)(long double);
  double lowest, highest, max_ulps;
};

class UnaryTest : public testing::TestWithParam<UnaryCase> {};

TEST_P(UnaryTest, AgreesWithExtendedPrecision) {
  const UnaryCase& c = GetParam();
  RandomStream draws(7);
  for (int i = 0; i < 200000; ++i) {
    const double x = draws.uniform(c.lowest, c.highest);
    ASSERT_LE(ulps(c.ours(x), c.exact(static_cast<long double>(x))), c.max_ulps)
        << c.name << '(' << x << ')';
  }
}

INSTANTIATE_TEST_SUITE_P(Functions, UnaryTest,
                         testing::Values(UnaryCase{"sin", math::sin, std::sin, -10, 10, 1.5},
                                         UnaryCase{"cos", math::cos, std::cos, -10, 10, 1.5},
                                         UnaryCase{"sin_far", math::sin, std::sin, -9e5, 9e5, 1.5},
                                         UnaryCase{"cos_far", math::cos, std::cos, -9e5, 9e5, 1.5},
                                         UnaryCase{"tan", math::tan, std::tan, -1.5, 1.5, 3.5},
                                         UnaryCase{"atan", math::atan, std::atan, -20, 20, 1.5},
                                         UnaryCase{"asin", math::asin, std::asin, -1, 1, 3.5},
                                         UnaryCase{"acos", math::acos, std::acos, -1, 1, 3.5},
                                         UnaryCase{"exp", math::exp, std::exp, -700, 700, 1.5},
                                         UnaryCase{"log", math::log, std::log, 1e-6, 50, 1.5}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Math, Atan2CoversAllQuadrantsAndAxes) {
  for (int i = 0; i < 3600; ++i) {
    const double angle = math::kTau * (i + 0.5) / 3600.0 - math::kPi;
    EXPECT_NEAR(math::atan2(std::sin(angle), std::cos(angle)), angle, 1e-15);
  }
  EXPECT_EQ(math::atan2(0.0, -1.0), math::kPi);
  EXPECT_EQ(math::atan2(-0.0, -1.0), -math::kPi);
  EXPECT_EQ(math::atan2(1.0, 0.0), math::kPi / 2);
  EXPECT_EQ(math::atan2(-2.0, 0.0), -math::kPi / 2);
}

TEST(Math, SpecialValues) {
  EXPECT_TRUE(std::isnan(math::sin(1e7)));
  EXPECT_TRUE(std::isnan(math::log(-1.0)));
  EXPECT_EQ(math::log(0.0), -HUGE_VAL);
  EXPECT_EQ(math::exp(1000.0), HUGE_VAL);
  EXPECT_EQ(math::exp(-1000.0), 0.0);
  EXPECT_EQ(math::exp(0.0), 1.0);
  EXPECT_EQ(math::log(1.0), 0.0);
}

TEST(Math, WrappedAngleStaysInHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(math::wrapped_angle(3.0 * math::kPi), math::kPi);
  EXPECT_DOUBLE_EQ(math::wrapped_angle(-math::kPi), math::kPi);
  EXPECT_DOUBLE_EQ(math::wrapped_angle(0.25), 0.25);
  EXPECT_NEAR(math::wrapped_angle(7.0), 7.0 - math::kTau, 1e-15);
}

// The bits themselves, over many arguments: the same for every compiler and machine.
TEST(Math, BitsArePinned) {
  RandomStream draws(42);
  Digest digest;
  for (int i = 0; i < 20000; ++i) {
    const double x = draws.uniform(-30.0, 30.0);
    const double y = draws.uniform(-30.0, 30.0);
    digest.add(math::sin(x))
        .add(math::cos(x))
        .add(math::tan(x))
        .add(math::exp(x))
        .add(math::atan2(x, y));
    digest.add(math::log(std::abs(x)));
  }
  EXPECT_EQ(digest.hex(), "8bbebfab6eac0849a1102a77f17fe822311911b53963eb68dd5642a6671eba46");
}

}  // namespace
}  // namespace avoidbench
