#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/interval.hpp"

namespace avoidbench {

/// What one flight was worth: its goal velocity where the goal was reached, 0 where not.
struct SpeedTrial {
  std::size_t map = 0;
  double speed_mps = 0.0;
};

/// A step of S(v), the share of flights that reached the goal with at least this goal velocity.
struct SpeedStep {
  double speed_mps = 0.0;
  double share = 0.0;  ///< S at this speed, and down to the step before
  Interval interval;   ///< 95 %, as rate_interval() has it
};

/// S(v): one step for each distinct speed, in rising order, the first at 0 (where S is 1). Empty
/// without trials.
std::vector<SpeedStep> speed_curve(std::span<const SpeedTrial> trials, double confidence = 0.95);

/// The share of v90.
inline constexpr double kReachedShare = 0.9;

/// v_share (v90 for 0.9): the greatest v with S(v) >= share; 0 where fewer reached the goal; NaN
/// for an empty curve.
double reached_speed(std::span<const SpeedStep> curve, double share);

/// Its interval by inversion (Woodruff 1952): from the least to the greatest v for which `share`
/// lies in the interval of S(v); up to the fastest flight at most. NaN for an empty curve.
Interval reached_speed_interval(std::span<const SpeedStep> curve, double share);

/// Flights from which on v_share says something, 29 for 0.9: a planner that fails one time in ten
/// completes 28 flights in a row with a probability above 5 % (0.9^28 = 5.2 %).
std::int64_t least_trials_for(double share);

inline constexpr std::size_t kSpeedDraws = 2000;

/// v_share of as many draws of maps with replacement; the same maps for all that have this seed
/// and number of maps, so that two planners' draws on the same maps are pairs. NaN for a draw
/// without trials. `trials` are of maps below `map_count`. Another
/// `stream_index` draws other maps.
std::vector<double> reached_speed_draws(std::span<const SpeedTrial> trials, std::size_t map_count,
                                        double share, std::size_t draw_count = kSpeedDraws,
                                        std::uint64_t stream_index = 0);

/// Of two planners' v_share on the same maps.
struct SpeedDifference {
  double difference_mps = 0.0;  ///< first - second
  Interval interval;            ///< paired bootstrap over maps; NaN for fewer than kLeastMaps
  double spread_mps =
      0.0;  ///< standard deviation of the difference over draws; NaN as the interval
  /// Of no difference: it over this spread as Student's t of the maps, at least 2^(1 - maps); NaN
  /// as the interval.
  double p = 1.0;
};
SpeedDifference speed_difference(double first_mps, double second_mps,
                                 std::span<const double> first_draws,
                                 std::span<const double> second_draws, std::size_t map_count,
                                 double confidence = 0.95);

}  // namespace avoidbench
