#include "statistics/failure_rate.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.hpp"
#include "base/math.hpp"
#include "statistics/bootstrap.hpp"

namespace avoidbench {
namespace {

constexpr double kPriorLogRate = -4.605170185988091;  // one failure in 100
constexpr double kPriorLogRateSpread = 3.0;
constexpr double kPriorSlopeSpread = 1.5;
constexpr double kLeastSpread = -16.0;  // log of it: to no difference between maps
constexpr int kFreedom = 5;             // of the t distribution that draws are made from

/// log rate, slope, and what spread_of() makes the spread of: no bounds.
using Parameters = std::array<double, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

/// log(1 + exp(v)): above 0, and far less skewed than exp(v).
double spread_of(double v) { return std::max(v, 0.0) + math::log(1.0 + math::exp(-std::abs(v))); }

/// What the likelihood needs of one map.
struct MapTrials {
  double x = 0.0;  ///< centred and scaled
  double exposure_of_successes = 0.0;
  std::vector<double> exposures_of_failures;
};

/// log(1 - exp(-m)), m > 0.
double log_one_minus_exp(double m) {
  // Below: 1 - exp(-m) by its series, since the difference loses all digits.
  return m > 1e-5 ? math::log(1.0 - math::exp(-m)) : math::log(m) - 0.5 * m;
}

/// The log-likelihood of a map's flights and of its effect u.
double height_at(const MapTrials& map, double log_rate, double u, double spread) {
  const double rate = math::exp(std::min(log_rate + u, 700.0));
  double height = -rate * map.exposure_of_successes - 0.5 * u * u / (spread * spread);
  for (const double exposure : map.exposures_of_failures) {
    height += log_one_minus_exp(rate * exposure);
  }
  return height;
}

/// Where that peaks over u, and how wide the peak is.
struct EffectPeak {
  double u = 0.0, width = 0.0;
};

EffectPeak peak_over_u(const MapTrials& map, double log_rate, double spread) {
  EffectPeak peak;
  for (int i = 0; i < 50; ++i) {
    const double rate = math::exp(std::min(log_rate + peak.u, 700.0));
    const double of_successes = rate * map.exposure_of_successes;
    double slope = -of_successes - peak.u / (spread * spread);
    double curvature = -of_successes - 1.0 / (spread * spread);
    for (const double exposure : map.exposures_of_failures) {
      const double m = rate * exposure;
      if (m > 700.0) continue;  // sure to fail: nothing changes any more
      const double q = m > 1e-8 ? m / (math::exp(m) - 1.0) : 1.0 - 0.5 * m;
      slope += q;
      curvature += q * (1.0 - m - q);
    }
    peak.width = 1.0 / std::sqrt(-curvature);
    // The log-likelihood is concave: Newton's step, cut where it would overshoot.
    const double step = std::clamp(-slope / curvature, -2.0, 2.0);
    peak.u += step;
    // As near as the sum below needs it.
    if (std::abs(step) < 0.01 * peak.width) break;
  }
  return peak;
}

/// The log of the map's likelihood with its effect integrated out: by the trapezoidal rule over 5.6
/// widths on both sides of the peak, which is all but exact for so smooth a bell.
double log_marginal(const MapTrials& map, double log_rate, double spread) {
  const EffectPeak peak = peak_over_u(map, log_rate, spread);
  const double greatest = height_at(map, log_rate, peak.u, spread);
  constexpr double kStep = 0.8;
  double sum = 0.0;
  for (int i = -7; i <= 7; ++i) {
    const double u = peak.u + kStep * i * peak.width;
    sum += math::exp(height_at(map, log_rate, u, spread) - greatest);
  }
  return greatest + math::log(kStep * peak.width * sum / (spread * std::sqrt(math::kTau)));
}

double log_posterior(std::span<const MapTrials> maps, const Parameters& at) {
  const double spread = spread_of(at[2]);
  const double from_middle = (at[0] - kPriorLogRate) / kPriorLogRateSpread;
  const double slope = at[1] / kPriorSlopeSpread;
  double sum = -0.5 * (from_middle * from_middle + slope * slope + spread * spread);
  // A density over the spread as one over at[2]: times the slope of spread_of().
  sum -= spread_of(-at[2]);
  for (const MapTrials& map : maps) sum += log_marginal(map, at[0] + at[1] * map.x, spread);
  return sum;
}

/// Lower triangle L with L Lᵀ = m, or false where m is not positive definite.
bool cholesky(const Matrix& m, Matrix& lower) {
  lower = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
      if (i == j && !(sum > 0.0)) return false;
      lower[i][j] = i == j ? std::sqrt(sum) : sum / lower[j][j];
    }
  }
  return true;
}

/// Lᵀ y = v.
Parameters solve_transposed(const Matrix& lower, Parameters v) {
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) v[i] -= lower[k][i] * v[k];
    v[i] /= lower[i][i];
  }
  return v;
}

/// L y = v.
Parameters solve(const Matrix& lower, Parameters v) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) v[i] -= lower[i][k] * v[k];
    v[i] /= lower[i][i];
  }
  return v;
}

/// Gradient and minus the Hessian, by central differences.
void derivatives(std::span<const MapTrials> maps, const Parameters& at, Parameters& gradient,
                 Matrix& information) {
  constexpr double kStep = 1e-3;
  const double middle = log_posterior(maps, at);
  const auto moved = [&](std::size_t i, double by_i, std::size_t j, double by_j) {
    Parameters to = at;
    to[i] += by_i * kStep;
    to[j] += by_j * kStep;
    return log_posterior(maps, to);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double above = moved(i, 1.0, i, 0.0), below = moved(i, -1.0, i, 0.0);
    gradient[i] = (above - below) / (2.0 * kStep);
    information[i][i] = -(above - 2.0 * middle + below) / (kStep * kStep);
    for (std::size_t j = 0; j < i; ++j) {
      const double same = moved(i, 1.0, j, 1.0) + moved(i, -1.0, j, -1.0);
      const double opposite = moved(i, 1.0, j, -1.0) + moved(i, -1.0, j, 1.0);
      information[i][j] = information[j][i] = -(same - opposite) / (4.0 * kStep * kStep);
    }
  }
}

/// The posterior's peak, with L Lᵀ = minus its Hessian there.
struct Peak {
  Parameters at{};
  Matrix lower{};
  double value = 0.0;
};

Peak peak_of(std::span<const MapTrials> maps, Parameters at) {
  Peak peak{.at = at, .lower = {}, .value = log_posterior(maps, at)};
  for (int i = 0; i < 100; ++i) {
    Parameters gradient{};
    Matrix information{};
    derivatives(maps, peak.at, gradient, information);
    // Away from the peak the surface may bend upwards: ridges are added until it does not.
    for (double ridge = 0.0; !cholesky(information, peak.lower) && ridge < 1e9;) {
      const double more = ridge == 0.0 ? 1e-3 : 9.0 * ridge;
      for (std::size_t k = 0; k < 3; ++k) information[k][k] += more;
      ridge += more;
    }
    const Parameters step = solve_transposed(peak.lower, solve(peak.lower, gradient));
    double length = 1.0, value = 0.0;
    Parameters to{};
    for (int halvings = 0; halvings < 20; ++halvings, length *= 0.5) {
      for (std::size_t k = 0; k < 3; ++k) to[k] = peak.at[k] + length * step[k];
      value = log_posterior(maps, to);
      if (value >= peak.value) break;
    }
    if (!(value >= peak.value)) break;  // no way up is left
    const bool is_there = value - peak.value < 1e-9;
    peak.at = to;
    peak.value = value;
    if (is_there) break;
  }
  return peak;
}

std::vector<MapTrials> maps_of(std::span<const ExposedTrial> trials, FailureRateFit& fit) {
  std::map<std::size_t, MapTrials> by_map;
  for (const ExposedTrial& trial : trials) {
    if (trial.x != trial.x) continue;
    AB_CHECK(trial.exposure > 0.0, trial.exposure);
    MapTrials& map = by_map[trial.map];
    map.x = trial.x;
    if (trial.has_failed) map.exposures_of_failures.push_back(trial.exposure);
    if (!trial.has_failed) map.exposure_of_successes += trial.exposure;
  }
  std::vector<MapTrials> maps;
  for (auto& [number, map] : by_map) maps.push_back(std::move(map));
  if (maps.empty()) return maps;
  const auto count = static_cast<double>(maps.size());
  fit.centre = 0.0;
  for (const MapTrials& map : maps) fit.centre += map.x / count;
  double variance = 0.0;
  for (const MapTrials& map : maps) {
    variance += (map.x - fit.centre) * (map.x - fit.centre) / count;
  }
  fit.scale = variance > 0.0 ? std::sqrt(variance) : 1.0;
  for (MapTrials& map : maps) map.x = (map.x - fit.centre) / fit.scale;
  return maps;
}

/// Of `weighted`, each as often as its weight says (systematic resampling).
std::vector<FailureRateDraw> resampled(const std::vector<Parameters>& weighted,
                                       const std::vector<double>& weights, double sum,
                                       double offset) {
  std::vector<FailureRateDraw> draws;
  const auto count = static_cast<double>(weighted.size());
  double passed = weights.front();
  std::size_t at = 0;
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    const double place = (static_cast<double>(i) + offset) * sum / count;
    while (passed < place && at + 1 < weighted.size()) passed += weights[++at];
    draws.push_back({weighted[at][0], weighted[at][1], spread_of(weighted[at][2])});
  }
  return draws;
}

Interval middle_of(std::vector<double>& values, double confidence) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5 - 0.5 * confidence), quantile(values, 0.5 + 0.5 * confidence)};
}

}  // namespace

FailureRateFit fit_failure_rate(std::span<const ExposedTrial> trials, std::size_t draw_count) {
  FailureRateFit fit;
  const std::vector<MapTrials> maps = maps_of(trials, fit);
  if (maps.empty() || draw_count == 0) return fit;
  double failures = 0.5, exposure = 0.0;
  for (const MapTrials& map : maps) {
    failures += static_cast<double>(map.exposures_of_failures.size());
    exposure += map.exposure_of_successes;
    for (const double metres : map.exposures_of_failures) exposure += 0.5 * metres;
  }
  const Peak peak = peak_of(maps, {math::log(failures / exposure), 0.0, 0.0});
  RandomStream random = stream(1, "failure_rate");
  std::vector<Parameters> made;
  std::vector<double> logs;
  for (std::size_t i = 0; i < draw_count; ++i) {
    Parameters normal{};
    double squares = 0.0, chi_square = 0.0;
    for (double& value : normal) value = random.normal();
    for (int k = 0; k < kFreedom; ++k) {
      const double value = random.normal();
      chi_square += value * value;
    }
    const double stretch = std::sqrt(kFreedom / chi_square);
    for (double& value : normal) {
      value *= stretch;
      squares += value * value;
    }
    Parameters at = solve_transposed(peak.lower, normal);
    for (std::size_t k = 0; k < 3; ++k) at[k] += peak.at[k];
    at[2] = std::clamp(at[2], kLeastSpread, 20.0);
    made.push_back(at);
    // The posterior over the density that it was drawn from.
    logs.push_back(log_posterior(maps, at) - peak.value +
                   0.5 * (kFreedom + 3) * math::log(1.0 + squares / kFreedom));
  }
  const double greatest = *std::max_element(logs.begin(), logs.end());
  std::vector<double> weights;
  double sum = 0.0, sum_of_squares = 0.0;
  for (const double value : logs) {
    weights.push_back(math::exp(value - greatest));
    sum += weights.back();
    sum_of_squares += weights.back() * weights.back();
  }
  fit.effective_share = sum * sum / sum_of_squares / static_cast<double>(draw_count);
  fit.draws = resampled(made, weights, sum, random.uniform());
  return fit;
}

SuccessPrediction predict_success(const FailureRateFit& fit, double x,
                                  std::span<const double> exposures, double confidence,
                                  RandomStream random) {
  SuccessPrediction prediction;
  prediction.probabilities.assign(exposures.size(), 0.0);
  const auto draw_count = static_cast<double>(fit.draws.size());
  const auto mission_count = static_cast<double>(exposures.size());
  std::vector<double> shares, rates;
  for (const FailureRateDraw& draw : fit.draws) {
    const double effect = draw.spread * random.normal();
    const double log_rate = draw.log_rate + draw.slope * (x - fit.centre) / fit.scale + effect;
    rates.push_back(math::exp(std::min(log_rate, 700.0)));
    double reached = 0.0;
    for (std::size_t i = 0; i < exposures.size(); ++i) {
      const double probability = math::exp(-rates.back() * exposures[i]);
      prediction.probabilities[i] += probability / draw_count;
      reached += random.uniform() < probability ? 1.0 : 0.0;
    }
    shares.push_back(reached / mission_count);
  }
  for (const double probability : prediction.probabilities) {
    prediction.rate += probability / mission_count;
  }
  prediction.share = middle_of(shares, confidence);
  prediction.failures_per_exposure = middle_of(rates, confidence);
  prediction.median_failures_per_exposure = quantile(rates, 0.5);
  return prediction;
}

SlopeEstimate failure_slope(const FailureRateFit& fit, double confidence) {
  SlopeEstimate estimate;
  std::vector<double> slopes;
  for (const FailureRateDraw& draw : fit.draws) {
    slopes.push_back(draw.slope / fit.scale);
    estimate.mean += slopes.back() / static_cast<double>(fit.draws.size());
  }
  estimate.interval = middle_of(slopes, confidence);
  return estimate;
}

}  // namespace avoidbench
