#include "base/number_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>

#include "base/random.hpp"

namespace avoidbench {
namespace {

std::string printed(const char* format, int digits, double value) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, digits, value);
  return text.data();
}

/// Stored texts made by printf before keep their bytes.
TEST(NumberText, IsAsPrintfsInItsOwnLocale) {
  RandomStream random = stream(1, "numbers");
  for (int i = 0; i < 20000; ++i) {
    const double value = (random.uniform() - 0.5) * std::pow(10.0, random.uniform() * 40.0 - 20.0);
    for (const int digits : {1, 2, 3, 6, 12, 17}) {
      ASSERT_EQ(fixed_digits(value, digits), printed("%.*f", digits, value));
      ASSERT_EQ(significant_digits(value, digits), printed("%.*g", digits, value));
    }
    ASSERT_EQ(std::stod(shortest(value)), value);
  }
  for (const double value : {0.0, -0.0, 0.005, 0.015, 2.5, -0.001, 1e300, 1e-300, 100000.0, 1e6}) {
    EXPECT_EQ(fixed_digits(value, 2), printed("%.*f", 2, value));
    EXPECT_EQ(fixed_digits(value, 0), printed("%.*f", 0, value));
    EXPECT_EQ(significant_digits(value, 6), printed("%.*g", 6, value));
  }
  const double most = std::numeric_limits<double>::max();
  EXPECT_EQ(fixed_digits(-most, 60), printed("%.*f", 60, -most));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fixed_digits(infinity, 2), "inf");
  EXPECT_EQ(significant_digits(-infinity, 2), "-inf");
  EXPECT_EQ(fixed_digits(-std::nan(""), 2), "nan");
}

/// Commas and groups of three, as std::locale::global(std::locale("de_DE")) sets them.
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(NumberText, KnowsNoLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new German));
  std::ostringstream stream;
  stream << 1234567.5;
  const std::string by_stream = stream.str(), fixed = fixed_digits(1234567.5, 1);
  const std::string digits = significant_digits(1234567.5, 9), all = shortest(1234567.5);
  std::locale::global(before);
  EXPECT_NE(by_stream.find(','), std::string::npos);
  EXPECT_EQ(fixed, "1234567.5");
  EXPECT_EQ(digits, "1234567.5");
  EXPECT_EQ(all, "1234567.5");
}

}  // namespace
}  // namespace avoidbench
