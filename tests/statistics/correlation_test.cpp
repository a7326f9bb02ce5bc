#include "statistics/correlation.hpp"

#include "reference.hpp"

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

TEST(Correlation, KendallCountsPairsOfPairs) {
  const std::vector<double> x{1, 2, 3, 4, 5}, falling{5, 4, 3, 2, 1}, swapped{2, 1, 4, 3, 5};
  EXPECT_EQ(kendall_correlation(x, x), 1.0);
  EXPECT_EQ(kendall_correlation(x, falling), -1.0);
  EXPECT_EQ(kendall_correlation(x, swapped), 0.6);  // 8 of 10 agree
  // 2 agree; 3 differ in one, 2 in the other.
  const std::vector<double> tied{7, 7, 9}, other{1, 2, 3}, constant{4, 4, 4};
  EXPECT_NEAR(kendall_correlation(tied, other), 2.0 / std::sqrt(6.0), 1e-15);
  EXPECT_TRUE(std::isnan(kendall_correlation(constant, other)));
  EXPECT_EQ(kendall_correlation(std::vector<double>{1, 2, std::nan("")}, other), 1.0);
  // The example of SciPy's kendalltau.
  EXPECT_NEAR(
      kendall_correlation(std::vector<double>{12, 2, 1, 12, 2}, std::vector<double>{1, 4, 7, 1, 0}),
      -0.47140452079103173, 1e-15);
}

TEST(Correlation, LikeScipy) {
  for (const auto& row : reference("correlation")) {
    const std::vector<double> x = numbers(row.at("x"));
    const std::vector<double> y = numbers(row.at("y"));
    const double pearson = pearson_correlation(x, y);
    const double spearman = spearman_correlation(x, y);
    expect_close(pearson, row.at("pearson"));
    expect_close(spearman, row.at("spearman"));
    const auto expect = [&](const Interval& interval, const char* name) {
      const std::vector<double> ends = numbers(row.at(name));
      EXPECT_NEAR(interval.lower, ends[0], 1e-11) << name;
      EXPECT_NEAR(interval.upper, ends[1], 1e-11) << name;
    };
    expect(correlation_interval(pearson, x.size(), false), "pearson_interval");
    expect(correlation_interval(spearman, x.size(), true), "spearman_interval");
  }
}

TEST(Correlation, PearsonIsLinearAndLeavesNanOut) {
  const std::vector<double> x{1, 2, std::nan(""), 4, 5};
  const std::vector<double> y{-2, -4, 7, -8, -10};
  EXPECT_NEAR(pearson_correlation(x, y), -1.0, 1e-15);
  EXPECT_NEAR(spearman_correlation(x, y), -1.0, 1e-15);
  // Three times 0.1 differs from its mean by rounding.
  const std::vector<double> constant{0.1, 0.1, 0.1}, other{1, 2, 4};
  EXPECT_TRUE(std::isnan(pearson_correlation(constant, other)));
  EXPECT_TRUE(std::isnan(pearson_correlation(std::vector<double>{1}, std::vector<double>{2})));
}

TEST(Correlation, IntervalsEndWhereNothingCanBeSaid) {
  EXPECT_TRUE(std::isnan(correlation_interval(0.5, 3, false).lower));
  EXPECT_TRUE(std::isnan(correlation_interval(1.0, 30, true).lower));
  EXPECT_TRUE(std::isnan(correlation_interval(std::nan(""), 30, true).lower));
  // By hand: atanh 0.5 = 0.5493, half 1.95996 / 5 = 0.39199: tanh of 0.15731 and 0.94130.
  EXPECT_NEAR(correlation_interval(0.5, 28, false).lower, std::tanh(0.15731), 1e-5);
  EXPECT_NEAR(correlation_interval(0.5, 28, false).upper, std::tanh(0.94130), 1e-5);
}

/// Rows of a CSV file without quotes.
std::vector<std::vector<std::string>> csv_rows(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> row(1);
    for (const char c : line) {
      if (c == ',') {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

// FlightBench (arXiv 2406.05687) publishes results of planners on eight cases, and how their
// computation times correlate with the cases' difficulty.
TEST(Correlation, AsFlightBenchPublished) {
  const auto rows = csv_rows(AVOIDBENCH_SOURCE_DIR "/tests/statistics/flightbench_published.csv");
  const auto column = [&](const char* name) {
    const auto found = std::find(rows.at(0).begin(), rows.at(0).end(), name);
    EXPECT_NE(found, rows.at(0).end()) << name;
    return static_cast<std::size_t>(found - rows.at(0).begin());
  };
  const auto correlation = [&](const char* planner, const char* difficulty) {
    std::vector<double> x, y;
    for (const auto& row : rows) {
      if (row.at(column("metric")) != "Comp. Time" || row.at(column("planner")) != planner)
        continue;
      x.push_back(std::stod(row.at(column(difficulty))));
      y.push_back(std::stod(row.at(column("mean"))));
    }
    EXPECT_EQ(x.size(), 8U);
    return std::round(100.0 * std::abs(pearson_correlation(x, y)));
  };
  EXPECT_EQ(correlation("TGK", "TO"), 50);
  EXPECT_EQ(correlation("TGK", "VO"), 29);
  EXPECT_EQ(correlation("TGK", "AOL"), 11);
  EXPECT_EQ(correlation("Fast", "TO"), 66);
  EXPECT_EQ(correlation("Fast", "VO"), 53);
  EXPECT_EQ(correlation("Fast", "AOL"), 81);
  EXPECT_EQ(correlation("Agile", "TO"), 15);
  EXPECT_EQ(correlation("Agile", "VO"), 6);
  EXPECT_EQ(correlation("Agile", "AOL"), 26);
}

}  // namespace
}  // namespace avoidbench
