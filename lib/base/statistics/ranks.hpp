#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace avoidbench {

/// What a two-sided rank test says.
struct RankTest {
  double p = 1.0;  ///< of a rank sum as far from its mean as the one seen, if nothing differs
  double z = 0.0;  ///< the same by the normal approximation, with its sign; never NaN
  std::int64_t count = 0;  ///< values that counted
  bool is_exact = false;   ///< p is counted out, not approximated
};

/// Ranks from 1, ties with their average; without NaN.
std::vector<double> average_ranks(std::span<const double> values);

/// Wilcoxon's signed-rank test that paired differences are symmetric about 0; z is positive where
/// differences tend to be. Zeros and NaN are left out. For up to 50 differences p is exact, with
/// ties too (all signs of the average ranks are equally likely: Streitberg and Röhmel 1986);
/// beyond, normal with corrections for ties and continuity.
RankTest wilcoxon_signed_rank(std::span<const double> differences);

/// Mann and Whitney's test that x and y are of one distribution; z is positive where x tends to be
/// greater. NaN is left out. For up to 50 values in all p is exact, with ties too (all splits of
/// the average ranks are equally likely): twice the smaller tail. Beyond, normal with corrections
/// for ties and continuity.
RankTest mann_whitney(std::span<const double> x, std::span<const double> y);

/// Holm's (1979) adjusted p, in the order given: those below alpha are rejected so that the chance
/// of any false rejection among them stays below alpha. NaN stays NaN and does not count.
std::vector<double> holm_adjusted(std::span<const double> p);

}  // namespace avoidbench
