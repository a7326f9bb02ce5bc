#include "statistics/sample_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(SampleSize, TrialsNeeded) {
  EXPECT_EQ(std::round(two_rates_trials(0.90, 0.80)), 199);
  EXPECT_EQ(std::round(two_rates_trials(0.60, 0.50)), 387);
  EXPECT_EQ(std::ceil(hoeffding_trials(0.05, 0.99)), 1060);
}

}  // namespace
}  // namespace avoidbench
