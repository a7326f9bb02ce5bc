#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "statistics/interval.hpp"

namespace avoidbench {

/// A flight over so long a way (its exposure) on one map, of which `x` says how hard it is.
struct ExposedTrial {
  std::size_t map = 0;
  double x = 0.0;
  double exposure = 0.0;  ///< > 0: metres, say
  bool has_failed = false;
};

/// One of the curves that the trials leave possible: failures per unit of exposure are exp(log_rate
/// + slope (x - centre) / scale + u), with u normal about 0 from map to map.
struct FailureRateDraw {
  double log_rate = 0.0;
  double slope = 0.0;
  double spread = 0.0;  ///< standard deviation of u
};

/// P(failure) = 1 - exp(-exposure · rate): a complementary log-log regression with offset
/// log(exposure), maps as random effect; ln(-ln SR) = ln(d / λ) + g of AvoidBench (arXiv
/// 2301.07430), eq. (9).
struct FailureRateFit {
  double centre = 0.0, scale = 1.0;    ///< mean and standard deviation of the maps' x
  std::vector<FailureRateDraw> draws;  ///< all as likely as each other; empty without trials
  /// Draws that as good an average of independent ones would take, as a share of those made: small
  /// where the posterior is far from Student's t, from which they are made.
  double effective_share = 0.0;
};

inline constexpr std::size_t kFailureDraws = 2000;

/// The posterior by importance sampling about its mode. Priors, weak beside a dozen failures:
/// log_rate normal about one failure in 100 units of exposure, with a standard deviation of 3;
/// slope normal about 0 with 1.5; spread half normal with 1. So there is an answer where no flight
/// has failed, and where all have. Trials with a NaN x are left out.
FailureRateFit fit_failure_rate(std::span<const ExposedTrial> trials,
                                std::size_t draw_count = kFailureDraws);

/// Of missions on one more map, which is not among those fitted.
struct SuccessPrediction {
  std::vector<double> probabilities;  ///< of success, one a mission
  double rate = 0.0;                  ///< their mean
  Interval share;                  ///< of the missions that succeed, on `confidence` of such maps
  Interval failures_per_exposure;  ///< of such maps' rates, likewise
  double median_failures_per_exposure = 0.0;
};

SuccessPrediction predict_success(const FailureRateFit& fit, double x,
                                  std::span<const double> exposures, double confidence,
                                  RandomStream random);

/// By how much ln(failures per exposure) changes with one unit of x: mean and interval.
struct SlopeEstimate {
  double mean = 0.0;
  Interval interval;
};
SlopeEstimate failure_slope(const FailureRateFit& fit, double confidence);

}  // namespace avoidbench
