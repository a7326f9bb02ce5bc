#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "planning/path_search.hpp"
#include "planning/rolling_grid.hpp"

namespace ego {

/// What is known of the space around the vehicle, and the heights that may be flown.
struct Surroundings {
  planning::RollingGrid grid;
  planning::PathSearch search;
  double lowest_m = 0.5, highest_m = 5.0;
  Eigen::Vector3d body_size_m;

  /// Whether the vehicle's centre should not be here: near an occupied cell, too low or too high.
  bool is_blocked(const Eigen::Vector3d& position_world) const;

  /// Whether a body here would touch an occupied cell.
  bool is_touching(const Eigen::Vector3d& position_world) const;
};

/// When a curve is first blocked, between two of its times. A curve that begins where it is blocked
/// may leave: it is not, up to its first free place, while that is within `kLeaving_m` and nothing
/// is touched.
inline constexpr double kLeaving_m = 1.2;
std::optional<double> first_blocked_s(const Surroundings& surroundings,
                                      const std::function<Eigen::Vector3d(double)>& position_at,
                                      double from_s, double to_s, double step_s);

/// How a free place is to be reached: by whatever way there is, or straight without a touch.
enum class Reach { any, straight };

/// The free place nearest to a blocked one.
std::optional<Eigen::Vector3d> nearest_free(const Surroundings& surroundings,
                                            const Eigen::Vector3d& position_world, double within_m,
                                            Reach reach);

}  // namespace ego
