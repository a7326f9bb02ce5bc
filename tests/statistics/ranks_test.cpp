#include "statistics/ranks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(Ranks, WilcoxonSeesShiftsOnly) {
  std::vector<double> shifted, symmetric;
  for (int i = 1; i <= 20; ++i) {
    shifted.push_back(i);
    symmetric.push_back(i % 2 == 0 ? i : -i);
  }
  // All 20 positive: W = 210, mean 105, variance 20·21·41/24 = 717.5.
  EXPECT_NEAR(wilcoxon_signed_rank(shifted).z, 104.5 / std::sqrt(717.5), 1e-12);
  EXPECT_LT(std::abs(wilcoxon_signed_rank(symmetric).z), 0.5);
  for (double& value : shifted) value = -value;
  EXPECT_NEAR(wilcoxon_signed_rank(shifted).z, -104.5 / std::sqrt(717.5), 1e-12);
  // One of 2^20 choices of signs, and its mirror.
  EXPECT_EQ(wilcoxon_signed_rank(shifted).p, 2.0 / 1048576.0);
}

}  // namespace
}  // namespace avoidbench
