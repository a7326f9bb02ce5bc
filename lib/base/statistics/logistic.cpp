#include "statistics/logistic.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/normal_quantile.hpp"

namespace avoidbench {
namespace {

using math::kNaN;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Point {
  double x = 0.0, successes = 0.0, trials = 0.0;
};

struct Range {
  double least = kInfinity, greatest = -kInfinity;
  void add(double x) {
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
};

struct Information {
  double intercept = 0.0, both = 0.0, slope = 0.0;
  double determinant() const { return intercept * slope - both * both; }
};

/// The logistic function, without overflow on either side.
double probability_of(double logit) {
  const double e = math::exp(-std::abs(logit));
  return logit < 0.0 ? e / (1.0 + e) : 1.0 / (1.0 + e);
}

double log_likelihood(std::span<const Point> points, double intercept, double slope) {
  double sum = 0.0;
  for (const Point& point : points) {
    const double logit = intercept + slope * point.x;
    // log(1 + exp(logit)) without overflow
    const double log_sum = std::max(logit, 0.0) + math::log(1.0 + math::exp(-std::abs(logit)));
    sum += point.successes * logit - point.trials * log_sum;
  }
  return sum;
}

/// A step of Newton's method, halved until the likelihood does not fall. False at the end.
bool step(std::span<const Point> points, double& intercept, double& slope,
          Information& information) {
  information = {};
  double gradient_intercept = 0.0, gradient_slope = 0.0;
  for (const Point& point : points) {
    const double rate = probability_of(intercept + slope * point.x);
    const double residual = point.successes - point.trials * rate;
    const double weight = point.trials * rate * (1.0 - rate);
    gradient_intercept += residual;
    gradient_slope += residual * point.x;
    information.intercept += weight;
    information.both += weight * point.x;
    information.slope += weight * point.x * point.x;
  }
  // The 2 × 2 system solved by Cramer's rule.
  const double determinant = information.determinant();
  const double to_intercept =
      (information.slope * gradient_intercept - information.both * gradient_slope) / determinant;
  const double to_slope =
      (information.intercept * gradient_slope - information.both * gradient_intercept) /
      determinant;
  const double before = log_likelihood(points, intercept, slope);
  double length = 1.0;
  // Newton's step can overshoot far from the maximum; the likelihood is concave, so that some part
  // of the step never lowers it. 1e-13: its own rounding.
  while (length > 1e-6 &&
         !(log_likelihood(points, intercept + length * to_intercept, slope + length * to_slope) >=
           before - 1e-13 * std::abs(before))) {
    length *= 0.5;
  }
  intercept += length * to_intercept;
  slope += length * to_slope;
  const double moved = std::max(std::abs(to_intercept), std::abs(to_slope));
  // A step that only rounding could make is the end.
  return moved > 1e-13 * (1.0 + std::abs(intercept) + std::abs(slope));
}

}  // namespace

double LogisticFit::midpoint() const {
  return is_converged && slope != 0.0 ? -intercept / slope : kNaN;
}

LogisticFit logistic_fit(std::span<const double> x, std::span<const std::int64_t> successes,
                         std::span<const std::int64_t> trials) {
  AB_CHECK(x.size() == successes.size() && x.size() == trials.size(), x.size(), successes.size(),
           trials.size());
  std::vector<Point> points;
  Range all, with_success, with_failure;
  for (std::size_t i = 0; i < x.size(); ++i) {
    AB_CHECK(successes[i] >= 0 && successes[i] <= trials[i], successes[i], trials[i]);
    if (trials[i] == 0 || x[i] != x[i]) continue;
    points.push_back({x[i], static_cast<double>(successes[i]), static_cast<double>(trials[i])});
    all.add(x[i]);
    if (successes[i] > 0) with_success.add(x[i]);
    if (successes[i] < trials[i]) with_failure.add(x[i]);
  }
  LogisticFit fit;
  if (points.empty()) return fit;
  // No success at all, or no failure.
  const bool is_one_kind =
      with_success.least > with_success.greatest || with_failure.least > with_failure.greatest;
  if (!is_one_kind && !(all.least < all.greatest)) return fit;
  // The likelihood then grows for ever with the slope: there is no finite maximum to converge to.
  // All successes on one side of all failures.
  fit.is_separated = is_one_kind || with_success.greatest <= with_failure.least ||
                     with_failure.greatest <= with_success.least;
  if (fit.is_separated) return fit;

  // In units in which x goes from -1 to 1.
  // The equations are then well conditioned whatever the unit of x.
  const double centre = 0.5 * (all.least + all.greatest);
  const double scale = 0.5 * (all.greatest - all.least);
  for (Point& point : points) point.x = (point.x - centre) / scale;
  double intercept = 0.0, slope = 0.0;
  Information information;
  constexpr int kMostSteps = 100;
  for (int i = 0; i < kMostSteps && !fit.is_converged; ++i) {
    fit.is_converged = !step(points, intercept, slope, information);
  }
  const double determinant = information.determinant();
  fit.is_converged = fit.is_converged && determinant > 0.0 && std::isfinite(slope);
  if (!fit.is_converged) return fit;
  // Back to x's own unit, and with it the covariance.
  const double ratio = centre / scale;
  const double variance_intercept = information.slope / determinant;
  const double both = -information.both / determinant;
  const double variance_slope = information.intercept / determinant;
  fit.slope = slope / scale;
  fit.intercept = intercept - slope * ratio;
  fit.covariance = {variance_intercept - 2.0 * ratio * both + ratio * ratio * variance_slope,
                    (both - ratio * variance_slope) / scale, variance_slope / (scale * scale)};
  return fit;
}

Interval logistic_midpoint_interval(const LogisticFit& fit, double confidence) {
  if (!fit.is_converged) return {kNaN, kNaN};
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  // (intercept + slope x)² <= z² (its variance): a x² + 2 b x + c <= 0.
  const double a = fit.slope * fit.slope - z * z * fit.covariance[2];
  const double b = fit.intercept * fit.slope - z * z * fit.covariance[1];
  const double c = fit.intercept * fit.intercept - z * z * fit.covariance[0];
  // The slope does not differ from 0: Fieller's set has no bounds.
  if (!(a > 0.0)) return {-kInfinity, kInfinity};
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return {(-b - root) / a, (-b + root) / a};
}

}  // namespace avoidbench
