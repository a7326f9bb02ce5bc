#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/bspline.hpp"
#include "planning/polynomial.hpp"
#include "planning/random.hpp"
#include "settings.hpp"

namespace ego {

/// Way points one knot apart, to begin an optimisation with.
struct InitialCurve {
  std::vector<Eigen::Vector3d> way_points;
  double interval_s = 0.0;
};

/// Time between knots: a control point's spacing at full speed, and a fifth more.
double knot_interval_s(const Settings& settings);

/// The least-jerk polynomial from start to target.
InitialCurve polynomial_curve(const Settings& settings, const planning::Motion& start,
                              const planning::Motion& target);

/// The same by way of a random point, up to 0.4 of the distance aside and 0.2 up or down, the
/// farther the more tries failed.
InitialCurve random_curve(const Settings& settings, const planning::Motion& start,
                          const planning::Motion& target, int failures, planning::Random& random);

/// What is left of a trajectory at `from_s`, with a polynomial on to the target; points evenly
/// spaced. Empty where it would be too long.
InitialCurve inherited_curve(const Settings& settings, const planning::Bspline& previous,
                             double from_s, const planning::Motion& target);

}  // namespace ego
