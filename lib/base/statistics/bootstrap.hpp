#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "base/random.hpp"
#include "statistics/interval.hpp"

namespace avoidbench {

/// The `ratio` quantile, linear between the values' order statistics; NaN without values.
double quantile(std::span<const double> values, double ratio);

/// CF = (d_2 ln SR_1) / (d_1 ln SR_2), AvoidBench (arXiv 2301.07430) eq. (10): failures per metre
/// of 1 over those of 2. NaN where a rate is 0 or 1.
double contrast_factor(double success_rate_1, double reference_length_1_m, double success_rate_2,
                       double reference_length_2_m);

/// Efron's BCa interval (1987) of a statistic of `cluster_count` clusters (maps): `statistic` gets
/// indices of clusters, with repeats, and is asked for at least `replicate_count` draws with
/// replacement, for all clusters, and for all but each one (whose skewness is the acceleration).
/// Its levels are widened as Hesterberg (2015) does for percentile intervals, sqrt(n / (n - 1)) t(n
/// - 1) in place of the normal quantile, since the spread of a bootstrap of few clusters is too
/// small. Draws where the statistic is NaN are left out. Without a bias or an acceleration (all
/// draws on one side, the statistic undefined for all clusters or without one of them) it is the
/// widened percentile interval.
///
/// Skewed clusters move an end far out: more draws are taken, up to 200,000, until ten lie beyond
/// it. An end is NaN (unknown) where those are too few, and where it would be rarer than any draw,
/// 1 / n^n: then it would only be the greatest or least cluster. So fewer than 5 clusters have no
/// end at 95 % unless all draws are equal. Both are NaN for fewer than 2 clusters and where no draw
/// is left.
///
/// What 95 % covers, for means and contrast factors in 2,000 synthetic sweeps: 93.5 to 95 % for 15
/// and 30 maps (91 to 93 % at 15 without the widening), 93 to 95 % for 5 and 8, where an unknown
/// end claims nothing; for means of heavy tails (skewness 2.3) 92 % for 15 and 94 % for 60. Drawing
/// trials instead of maps it covers 55 % of means and 80 to 90 % of contrast factors.
Interval bca_interval(std::size_t cluster_count,
                      const std::function<double(std::span<const std::size_t>)>& statistic,
                      RandomStream random, std::size_t replicate_count = 2000,
                      double confidence = 0.95);

}  // namespace avoidbench
