#include "statistics/distributions.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

constexpr int kMostTerms = 100000;  ///< of a continued fraction

/// The continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by the
/// modified Lentz algorithm; converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  // Each turn takes an even and an odd term of the fraction.
  for (int term = 1; term < kMostTerms; ++term) {
    const double m = term;
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / away_from_zero(1.0 + even * d);
    c = away_from_zero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / away_from_zero(1.0 + odd * d);
    c = away_from_zero(1.0 + odd / c);
    const double factor = d * c;
    fraction *= factor;
    // A factor that no longer changes the last bit.
    if (std::abs(factor - 1.0) < 1e-16) break;
  }
  return fraction;
}

/// The continued fraction of the upper incomplete gamma function (Abramowitz and Stegun 6.5.31) by
/// the same algorithm; converges fast for x > a + 1.
double gamma_fraction(double x, double a) {
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double fraction = d;
  for (int term = 1; term < kMostTerms; ++term) {
    const double k = term;
    const double numerator = -k * (k - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    const double factor = d * c;
    fraction *= factor;
    if (std::abs(factor - 1.0) < 1e-16) break;
  }
  return fraction;
}

/// Where `is_below` changes, by bisection until no double lies between: the same on every machine,
/// whatever the slope.
template <class IsBelow>
double bisected(double below, double above, IsBelow is_below) {
  while (true) {
    const double middle = 0.5 * (below + above);
    if (middle <= below || middle >= above) return middle;
    (is_below(middle) ? below : above) = middle;
  }
}

}  // namespace

double normal_cdf(double z) {
  if (z != z) return kNaN;
  const double size = std::abs(z);
  const double density = math::exp(-0.5 * z * z) / std::sqrt(math::kTau);
  // The series converges fast near 0, the fraction far from it.
  if (size < 2.0) {  // Φ = 1/2 + φ Σ z^(2k+1) / (2k+1)!!
    double term = z;
    double sum = z;
    // Fixed numbers of terms, more than enough up to 2 and from 2 on.
    for (int k = 1; k < 60; ++k) {
      term *= z * z / (2.0 * k + 1.0);
      sum += term;
    }
    return 0.5 + density * sum;
  }
  // Laplace's continued fraction of Mills' ratio, from its end.
  double fraction = size;
  for (int k = 200; k >= 1; --k) fraction = size + k / fraction;
  const double tail = density / fraction;
  return z < 0.0 ? tail : 1.0 - tail;
}

double log_gamma(double x) {
  AB_CHECK(x > 0.0, x);
  // Stirling's series from 12 on, reached by Γ(x + 1) = x Γ(x).
  double product = 1.0;
  while (x < 12.0) {
    product *= x;
    x += 1.0;
  }
  const double y = 1.0 / (x * x);
  const double series =
      // Bernoulli's numbers: B_2k / (2k (2k − 1)) x^(1 − 2k).
      (1.0 / 12.0 + y * (-1.0 / 360.0 +
                         y * (1.0 / 1260.0 + y * (-1.0 / 1680.0 +
                                                  y * (1.0 / 1188.0 + y * (-691.0 / 360360.0 +
                                                                           y * (1.0 / 156.0))))))) /
      x;
  return (x - 0.5) * math::log(x) - x + 0.5 * math::log(math::kTau) + series - math::log(product);
}

double log_choose(double n, double k) {
  return log_gamma(n + 1.0) - log_gamma(k + 1.0) - log_gamma(n - k + 1.0);
}

double beta_cdf(double x, double a, double b) {
  AB_CHECK(a > 0.0 && b > 0.0, a, b);
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front = math::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * math::log(x) +
                                 b * math::log(1.0 - x));
  // Where the fraction converges slowly, by symmetry: I_x(a, b) = 1 − I_(1−x)(b, a).
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(x, a, b) / a;
  return 1.0 - front * beta_fraction(1.0 - x, b, a) / b;
}

double gamma_cdf(double x, double a) {
  AB_CHECK(a > 0.0, a);
  if (x <= 0.0) return 0.0;
  const double front = math::exp(a * math::log(x) - x - log_gamma(a));
  if (x < a + 1.0) {
    double k = a, term = 1.0 / a, sum = term;
    while (term > 1e-17 * sum) {
      k += 1.0;
      term *= x / k;
      sum += term;
    }
    return front * sum;
  }
  return 1.0 - front * gamma_fraction(x, a);
}

double beta_quantile(double p, double a, double b) {
  AB_CHECK(p >= 0.0 && p <= 1.0, p);
  return bisected(0.0, 1.0, [&](double x) { return beta_cdf(x, a, b) < p; });
}

double gamma_quantile(double p, double a) {
  AB_CHECK(p >= 0.0 && p < 1.0, p);
  double above = a + 1.0;
  while (gamma_cdf(above, a) < p) above *= 2.0;
  return bisected(0.0, above, [&](double x) { return gamma_cdf(x, a) < p; });
}

double binomial_cdf(double k, double n, double rate) {
  if (k < 0.0) return 0.0;
  if (k >= n) return 1.0;
  // The binomial's sum is an incomplete beta function.
  return beta_cdf(1.0 - rate, n - k, k + 1.0);
}

double student_t_tail(double t, double freedom) {
  AB_CHECK(t >= 0.0 && freedom > 0.0, t, freedom);
  // An infinite t too: its share of the beta variable is 0.
  return 0.5 * beta_cdf(1.0 / (1.0 + t * (t / freedom)), 0.5 * freedom, 0.5);
}

double student_t_quantile(double p, double freedom) {
  AB_CHECK(p > 0.0 && p < 1.0 && freedom > 0.0, p, freedom);
  if (p == 0.5) return 0.0;
  // t²/(freedom + t²) is a beta variable; the smaller side of it is computed.
  const double both_tails = 2.0 * (p < 0.5 ? p : 1.0 - p);
  const double rest = beta_quantile(both_tails, 0.5 * freedom, 0.5);
  const double size = std::sqrt(freedom * (1.0 - rest) / rest);
  return p < 0.5 ? -size : size;
}

}  // namespace avoidbench
