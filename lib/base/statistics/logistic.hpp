#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "statistics/interval.hpp"

namespace avoidbench {

/// A curve of success over difficulty: P(success) = 1 / (1 + exp(-(intercept + slope x))).
struct LogisticFit {
  double intercept = std::numeric_limits<double>::quiet_NaN();
  double slope = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> covariance{};  ///< variance of the intercept, covariance, of the slope
  /// Some x has all failures on one side and all successes on the other, so that no finite slope is
  /// likeliest; all equal, too.
  bool is_separated = false;
  bool is_converged = false;  ///< the numbers are there; else they are NaN

  double midpoint() const;  ///< the x of probability 1/2; NaN where there is none
};

/// The likeliest curve of `successes[i]` of `trials[i]` at `x[i]`, by iteratively reweighted least
/// squares with halved steps; its covariance is the inverse of Fisher's information. Not converged
/// where separated, where all x are equal and without trials. Points without trials or with a NaN x
/// are left out.
LogisticFit logistic_fit(std::span<const double> x, std::span<const std::int64_t> successes,
                         std::span<const std::int64_t> trials);

/// Interval of the x of probability 1/2 (Fieller 1954): all x where intercept + slope x does not
/// differ from 0. It is {-inf, +inf} where the slope itself does not differ from 0: the midpoint
/// may then be anywhere (or on either side of a gap, which is not told). NaN where the fit did not
/// converge.
Interval logistic_midpoint_interval(const LogisticFit& fit, double confidence = 0.95);

}  // namespace avoidbench
