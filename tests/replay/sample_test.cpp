#include "replay/sample.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/option_error.hpp"

namespace avoidbench {
namespace {

TEST(Sample, SharesAreReadAsTheyAreWritten) {
  EXPECT_EQ(share_from("1%"), 0.01);
  EXPECT_EQ(share_from("0.25"), 0.25);
  EXPECT_EQ(share_from("100%"), 1.0);
  EXPECT_EQ(share_from("1"), 1.0);
  for (const char* bad : {"", "0", "0%", "-1%", "1.01", "101%", "1 %", "%", "a", "1%%", "nan"}) {
    EXPECT_THROW(share_from(bad), OptionError) << bad;
  }
}

TEST(Sample, IsOfTheKeysFirstDigits) {
  const std::string rest(56, 'f');
  EXPECT_TRUE(is_sampled("00000000" + rest, 1e-9));
  EXPECT_TRUE(is_sampled("7fffffff" + rest, 0.5));
  EXPECT_FALSE(is_sampled("80000000" + rest, 0.5));
  EXPECT_TRUE(is_sampled("ffffffff" + rest, 1.0));
  EXPECT_FALSE(is_sampled("ffffffff" + rest, 0.999));
  // A quarter of them, and all of those are in a half.
  int quarter = 0;
  for (int i = 0; i < 4096; ++i) {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%03x00000", static_cast<unsigned>(i));
    if (!is_sampled(digits + rest, 0.25)) continue;
    ++quarter;
    EXPECT_TRUE(is_sampled(digits + rest, 0.5));
  }
  EXPECT_EQ(quarter, 1024);
}

}  // namespace
}  // namespace avoidbench
