#pragma once

#include <optional>
#include <vector>

#include "initial_curve.hpp"
#include "surroundings.hpp"

namespace ego {

/// What the next trajectory is to go on from, and to.
struct Request {
  planning::Motion start, target;
  const planning::Bspline* previous = nullptr;  ///< trajectory to inherit from, or null
  double previous_s = 0.0;                      ///< its time now
  int failures = 0;                             ///< tries that failed since the last success
  int random_tries = 3;
};

/// A trajectory from start toward the target: the previous one extended, else a polynomial, else
/// ones by way of random points; each pushed out of obstacles, slowed down to the limits and
/// refined. Nothing where all fail. `candidates`, where given, gets the curves it began with.
std::optional<planning::Bspline> plan_trajectory(
    Surroundings& surroundings, const Settings& settings, const Request& request,
    planning::Random& random, std::vector<planning::Bspline>* candidates = nullptr);

/// The curve with its middle flown `ratio` times slower, its ends kept, as a uniform spline again.
planning::Bspline slowed(const planning::Bspline& curve, double ratio,
                         const planning::Motion& start, const planning::Motion& target);

/// Where to fly to next: a free place on the line from start to goal, a horizon away, and the
/// velocity there; nearer than that the goal, or a free place beside it.
planning::Motion local_target(const Surroundings& surroundings, const Settings& settings,
                              const Eigen::Vector3d& line_start, const Eigen::Vector3d& goal,
                              const Eigen::Vector3d& position);

}  // namespace ego
