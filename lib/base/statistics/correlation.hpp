#pragma once

#include <cstddef>
#include <span>

#include "statistics/interval.hpp"

namespace avoidbench {

/// Pearson's correlation; pairs with a NaN are left out. NaN for fewer than 2 pairs or where one
/// side is constant or infinite.
double pearson_correlation(std::span<const double> x, std::span<const double> y);

/// Spearman's rank correlation, ties with their average rank; pairs with a NaN are left out. NaN
/// for fewer than 2 pairs or where one side is constant.
double spearman_correlation(std::span<const double> x, std::span<const double> y);

/// Kendall's rank correlation τ_b (1945): agreeing less disagreeing pairs of pairs, over all that
/// are tied in neither; pairs with a NaN are left out. NaN for fewer than 2 pairs or where one side
/// is constant.
double kendall_correlation(std::span<const double> x, std::span<const double> y);

/// Interval of a correlation `r` of `count` independent pairs, by Fisher's z: variance 1/(n - 3),
/// for Spearman's (1 + r²/2)/(n - 3) (Bonett and Wright 2000). NaN for fewer than 4 pairs and where
/// |r| is 1, of which Fisher's z can say nothing.
Interval correlation_interval(double r, std::size_t count, bool is_spearman,
                              double confidence = 0.95);

}  // namespace avoidbench
