#pragma once

#include <optional>
#include <vector>

#include "trial/trial_record.hpp"

/// Measures of a flown path, from its samples. Each is 0 for fewer samples than it needs.
namespace avoidbench {

double flown_length_m(const std::vector<Sample>& samples);  ///< Σ‖p_{i+1} − p_i‖

/// The simulated acceleration at kJerkRate_hz from the first sample on; what is left after the last
/// such moment is left out. Nothing where one of these moments has no sample: between samples by
/// proportion would be smoother than the flight, and jerks up to 2 % too small.
std::optional<std::vector<Eigen::Vector3d>> accelerations_world(const std::vector<Sample>& samples);

/// ∫‖jerk‖dt = Σ‖a_{i+1} − a_i‖ of accelerations_world(); NaN without them.
double jerk_integral_mps2(const std::vector<Sample>& samples);

double mean_speed_mps(const std::vector<Sample>& samples);  ///< flown length over time
double max_speed_mps(const std::vector<Sample>& samples);

double min_clearance_m(const std::vector<Sample>& samples);
double mean_clearance_m(const std::vector<Sample>& samples);  ///< over time

/// Σκ_iΔs_i/L with the curvature of the circle through neighbouring points (Menger), on points at
/// least 5 cm apart.
double mean_curvature_1pm(const std::vector<Sample>& samples);

double acceleration_effort(const std::vector<Sample>& samples);  ///< ∫‖a‖²dt/L

/// ∫‖j‖²dt/L = Σ‖a_{i+1} − a_i‖² · kJerkRate_hz/L of accelerations_world(); NaN without them.
double jerk_effort(const std::vector<Sample>& samples);

/// Root mean square distance between commanded and flown position where there is a commanded one;
/// NaN without any.
double tracking_rmse_m(const std::vector<Sample>& samples);

double rotor_energy_j(const std::vector<Sample>& samples);  ///< ∫ rotor power dt

/// Progress along start → goal, 100 at the goal and 0 at the start, less than 0 behind it: eq. (7)
/// of AvoidBench.
double progress_pct(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                    const Eigen::Vector3d& end);

}  // namespace avoidbench
