#pragma once

#include <Eigen/Core>
#include <array>

#include "base/random.hpp"
#include "wind/wind_spec.hpp"

namespace avoidbench {

/// Standard deviations and scale lengths along the mean wind, across it and upwards.
struct TurbulenceScales {
  std::array<double, 3> sigma_mps{0.0, 0.0, 0.0};
  std::array<double, 3> length_m{1.0, 1.0, 1.0};
};

/// Those that the spec gives or, for mil_f_8785c, those of the low-altitude model of MIL-F-8785C
/// (3.7.3.4), with h the height in feet and W₂₀ the wind at 20 ft: σ_w = 0.1 W₂₀,
/// σ_u = σ_v = σ_w / f^0.4, L_w = h, L_u = L_v = h / f^1.2, f = 0.177 + 0.000823 h. All σ are zero
/// for `none`.
TurbulenceScales turbulence_scales(const TurbulenceSpec& turbulence);

/// One step of the second-order filter of the velocities across and upwards: its two states decay
/// by `keep`, the first feeds the second by `feed`, and the noise enters by the lower triangle.
struct LateralFilter {
  double keep = 0.0, feed = 0.0;
  double noise_11 = 0.0, noise_21 = 0.0, noise_22 = 0.0;
};

/// The forming filters of Dryden's spectra at unit variance, sampled exactly: at the sampling times
/// their values have the covariances of the continuous filters driven by white noise,
///
///     H_u = √(2T) / (1 + T s),   H_v, H_w = √T (1 + √3 T s) / (1 + T s)²,   T = length / airspeed,
///
/// so that R_u(τ) = e^(-τ/T) and R_v(τ) = e^(-τ/T) (1 - τ/(2T)) with no error of discretisation.
struct DrydenFilter {
  double keep_u = 0.0, noise_u = 0.0;
  std::array<LateralFilter, 2> lateral;  ///< across, upwards
};

struct DrydenState {
  double u = 0.0;
  std::array<std::array<double, 2>, 2> lateral{};
};

DrydenFilter make_dryden(const std::array<double, 3>& length_m, double airspeed_mps, double dt_s);

/// A state of the stationary process.
DrydenState stationary(RandomStream& random);

/// The state one sampling period later. Five draws.
void advance(DrydenState& state, const DrydenFilter& filter, RandomStream& random);

/// Velocities along, across and upwards, each of variance 1.
Eigen::Vector3d unit_velocity(const DrydenState& state);

}  // namespace avoidbench
