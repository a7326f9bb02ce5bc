#include "statistics/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace avoidbench {
namespace {

TEST(Correlation, SpearmanSeesOnlyOrder) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  const std::vector<double> cubes{1, 8, 27, 64, 125};
  EXPECT_NEAR(spearman_correlation(x, cubes), 1.0, 1e-15);
  const std::vector<double> falling{5, 4, 3, 2, 1};
  EXPECT_NEAR(spearman_correlation(x, falling), -1.0, 1e-15);
  // 1 - 6 Σd²/(n(n²-1)) without ties: d = 1 1 1 1 0.
  const std::vector<double> swapped{2, 1, 4, 3, 5};
  EXPECT_NEAR(spearman_correlation(x, swapped), 0.8, 1e-15);
  // Ties have average ranks: 1.5 1.5 3 against 1 2 3.
  const std::vector<double> tied{7, 7, 9}, other{1, 2, 3};
  EXPECT_NEAR(spearman_correlation(tied, other), 1.5 / std::sqrt(1.5 * 2.0), 1e-15);
  const std::vector<double> constant{4, 4, 4};
  EXPECT_TRUE(std::isnan(spearman_correlation(constant, other)));
}

}  // namespace
}  // namespace avoidbench
