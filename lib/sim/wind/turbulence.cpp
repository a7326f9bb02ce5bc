#include "wind/turbulence.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

/// ∫ x^n e^(-2x) dx from 0 to d, for n of 0, 1, 2: the covariances of what white noise leaves in
/// the lateral filter's states.
double moment(int n, double d) {
  constexpr double kSeriesUpTo = 1.0;  // above, the closed forms don't cancel
  if (d > kSeriesUpTo) {
    const double decay = math::exp(-2.0 * d);
    if (n == 0) return 0.5 * (1.0 - decay);
    if (n == 1) return 0.25 - decay * (0.5 * d + 0.25);
    return 0.25 - decay * (0.5 * d * d + 0.5 * d + 0.25);
  }
  double power = d, sum = 0.0;  // (-2)^k d^(n+k+1) / k!
  for (int i = 0; i < n; ++i) power *= d;
  // At d = 1 the last term is below 1e-20.
  constexpr int kTerms = 28;
  for (int k = 0; k < kTerms; ++k) {
    sum += power / (n + k + 1);
    power *= -2.0 * d / (k + 1);
  }
  return sum;
}

/// After a step of `d` time constants; from nothing to the stationary state where it is infinite.
LateralFilter lateral_filter(double d) {
  LateralFilter filter;
  // Two states a and b of one white noise: a' = -a + w, b' = -b + a, with time in constants T. Over
  // a step, a keeps e^-d of itself and gives b d e^-d.
  filter.keep = math::exp(-d);
  filter.feed = d * filter.keep;
  filter.noise_11 = std::sqrt(moment(0, d));
  filter.noise_21 = moment(1, d) / filter.noise_11;
  // The Cholesky factor of the two states' covariance; its last entry is positive, except for
  // rounding in very short steps.
  filter.noise_22 = std::sqrt(std::max(0.0, moment(2, d) - filter.noise_21 * filter.noise_21));
  return filter;
}

}  // namespace

TurbulenceScales turbulence_scales(const TurbulenceSpec& turbulence) {
  switch (turbulence.model) {
    case TurbulenceModel::none:
      return {};
    case TurbulenceModel::given:
      return {turbulence.sigma_mps, turbulence.length_m};
    case TurbulenceModel::mil_f_8785c:
      break;
  }
  constexpr double kFootM = 0.3048;
  // Only f takes the height in feet; lengths stay in metres.
  const double height_ft = turbulence.height_m / kFootM;
  // MIL-F-8785C, 3.7.3: the low-altitude model.
  const double f = 0.177 + 0.000823 * height_ft;
  const double sigma_w = 0.1 * turbulence.wind_6m_mps;
  const double sigma_u = sigma_w / math::pow(f, 0.4);
  const double length_u_m = turbulence.height_m / math::pow(f, 1.2);
  return {{sigma_u, sigma_u, sigma_w}, {length_u_m, length_u_m, turbulence.height_m}};
}

DrydenFilter make_dryden(const std::array<double, 3>& length_m, double airspeed_mps, double dt_s) {
  const auto time_constants = [&](std::size_t axis) {
    return dt_s * airspeed_mps / length_m[axis];
  };
  DrydenFilter filter;
  // First order: dt V / L time constants a step; the noise keeps its variance at 1.
  filter.keep_u = math::exp(-time_constants(0));
  filter.noise_u = std::sqrt(2.0 * moment(0, time_constants(0)));
  filter.lateral = {lateral_filter(time_constants(1)), lateral_filter(time_constants(2))};
  return filter;
}

DrydenState stationary(RandomStream& random) {
  // exp(-100) is nothing beside 1: the stationary state.
  constexpr double kLongAgo = 100.0;  // time constants
  const LateralFilter from_nothing = lateral_filter(kLongAgo);
  DrydenState state;
  advance(state, {0.0, 1.0, {from_nothing, from_nothing}}, random);
  return state;
}

void advance(DrydenState& state, const DrydenFilter& filter, RandomStream& random) {
  state.u = filter.keep_u * state.u + filter.noise_u * random.normal();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const LateralFilter& step = filter.lateral[axis];
    auto& [a, b] = state.lateral[axis];
    // b before a: it takes a's old value.
    const double first = random.normal();
    const double second = random.normal();
    b = step.keep * b + step.feed * a + step.noise_21 * first + step.noise_22 * second;
    a = step.keep * a + step.noise_11 * first;
  }
}

Eigen::Vector3d unit_velocity(const DrydenState& state) {
  // (1 + √3 T s) / (1 + T s)² = √3 / (1 + T s) + (1 - √3) / (1 + T s)²
  const double root3 = std::sqrt(3.0);
  const auto value = [root3](const std::array<double, 2>& lateral) {
    return root3 * lateral[0] + (1.0 - root3) * lateral[1];
  };
  return {state.u, value(state.lateral[0]), value(state.lateral[1])};
}

}  // namespace avoidbench
