#include "statistics/stop_rule.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

TEST(StopRule, ReadsAndWritesItself) {
  const StopRule rule = parse_stop_rule(" success_rate  ci < 0.05");
  EXPECT_EQ(rule.half_width, 0.05);
  EXPECT_EQ(rule.text(), "success_rate ci<0.05");
  EXPECT_EQ(parse_stop_rule(rule.text()).half_width, rule.half_width);
  EXPECT_EQ(StopRule{}.text(), "");
  for (const char* text :
       {"", "success_rate", "success_rate ci<", "success_rate ci<0", "success_rate ci<0.5",
        "success_rate ci<0.05 x", "success_rate ci>0.05", "path_optimality_pct ci<1", "ci<0.05"}) {
    EXPECT_THROW(parse_stop_rule(text), InputError) << text;
  }
}

TEST(StopRule, IsMetByANarrowInterval) {
  const StopRule rule{.half_width = 0.05};
  EXPECT_FALSE(is_enough(rule, 0, 0));
  EXPECT_FALSE(is_enough(rule, 190, 380));  // 1.96 sqrt(0.25 / 380) is 0.0503, Wilson's 0.0500
  EXPECT_TRUE(is_enough(rule, 200, 400));
  EXPECT_FALSE(is_enough(rule, 10, 10));  // sure of nothing yet: [0.72, 1]
  EXPECT_TRUE(is_enough(rule, 50, 50));
  EXPECT_FALSE(is_enough({}, 1000000, 1000000));
}

TEST(StopRule, LooksAtEachTenth) {
  EXPECT_EQ(looks(30), (std::vector<std::int64_t>{3, 6, 9, 12, 15, 18, 21, 24, 27, 30}));
  EXPECT_EQ(looks(3), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(looks(1), (std::vector<std::int64_t>{1}));
  EXPECT_EQ(looks(15).back(), 15);
}

}  // namespace
}  // namespace avoidbench
