#include "statistics/ranks.hpp"

#include "reference.hpp"

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

TEST(Ranks, WilcoxonLikeScipy) {
  for (const auto& row : reference("wilcoxon")) {
    SCOPED_TRACE(row.at("p"));
    std::vector<double> differences = numbers(row.at("differences"));
    const RankTest test = wilcoxon_signed_rank(differences);
    EXPECT_EQ(test.is_exact, row.at("is_exact").get<bool>());
    expect_close(test.p, row.at("p"));
    for (double& difference : differences) difference = -difference;
    differences.push_back(0.0);
    differences.push_back(std::nan(""));
    const RankTest mirrored = wilcoxon_signed_rank(differences);
    EXPECT_EQ(mirrored.z, -test.z);
    EXPECT_EQ(mirrored.count, test.count);
    expect_close(mirrored.p, test.p);
  }
}

TEST(Ranks, WilcoxonWithoutDifferencesTellsNothing) {
  const RankTest test = wilcoxon_signed_rank(std::vector<double>{0.0, 0.0, std::nan("")});
  EXPECT_EQ(test.count, 0);
  EXPECT_EQ(test.p, 1.0);
  EXPECT_EQ(test.z, 0.0);
  // Five pairs can never be significant at 5 %, however clear.
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>{1, 2, 3, 4, 5}).p, 2.0 / 32.0);
}

TEST(Ranks, MannWhitneyLikeScipy) {
  for (const auto& row : reference("mann_whitney")) {
    SCOPED_TRACE(row.at("p"));
    std::vector<double> x = numbers(row.at("x"));
    const std::vector<double> y = numbers(row.at("y"));
    x.push_back(std::nan(""));
    const RankTest test = mann_whitney(x, y);
    EXPECT_EQ(test.is_exact, row.at("is_exact").get<bool>());
    EXPECT_EQ(test.count, static_cast<std::int64_t>(x.size() - 1 + y.size()));
    expect_close(test.p, row.at("p"));
    const RankTest swapped = mann_whitney(y, x);
    EXPECT_NEAR(swapped.z, -test.z, 1e-12);
    expect_close(swapped.p, test.p);
  }
}

TEST(Ranks, MannWhitneyOfTwoAndTwoByHand) {
  // One of the six ways to choose two of four, and its mirror.
  const std::vector<double> low{1, 2}, high{3, 4}, same{7, 7, 7};
  EXPECT_NEAR(mann_whitney(low, high).p, 2.0 / 6.0, 1e-15);
  EXPECT_LT(mann_whitney(low, high).z, 0.0);
  EXPECT_EQ(mann_whitney(same, same).p, 1.0);
  EXPECT_EQ(mann_whitney(same, same).z, 0.0);
  EXPECT_EQ(mann_whitney(low, {}).p, 1.0);
}

TEST(Ranks, ExactAndNormalAgreeWhereTheyMeet) {
  std::vector<double> differences;
  for (int i = 1; i <= 50; ++i) differences.push_back(i % 3 == 0 ? -i : i);
  const double exact = wilcoxon_signed_rank(differences).p;
  differences.push_back(0.5);  // one more, of the least rank
  EXPECT_FALSE(wilcoxon_signed_rank(differences).is_exact);
  EXPECT_NEAR(wilcoxon_signed_rank(differences).p, exact, 0.2 * exact);
}

TEST(Ranks, HolmByItsDefinition) {
  for (const auto& row : reference("holm")) {
    const std::vector<double> adjusted = holm_adjusted(numbers(row.at("p")));
    const std::vector<double> expected = numbers(row.at("adjusted"));
    ASSERT_EQ(adjusted.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expect_close(adjusted[i], expected[i], 1e-15);
  }
  const std::vector<double> by_hand = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03});
  EXPECT_NEAR(by_hand[0], 0.03, 1e-15);
  EXPECT_NEAR(by_hand[1], 0.06, 1e-15);
  EXPECT_NEAR(by_hand[2], 0.06, 1e-15);
}

}  // namespace
}  // namespace avoidbench
