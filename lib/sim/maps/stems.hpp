#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/random.hpp"
#include "world/solids.hpp"

namespace avoidbench {

/// A trunk, bough or twig from its root to its tip.
using Stem = std::vector<TubeRing>;

/// Twigs that follow each other by this turn never stand above each other: π (3 - √5), 137.5°.
inline constexpr double kGoldenAngle_rad = 2.39996322972865332;

/// How a stem grows from its root.
struct StemGrowth {
  Eigen::Vector3d root = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double length_m = 1.0;
  double root_radius_m = 0.05;
  int segments = 4;
  double rise = 0.0;    ///< how far it turns up over its length (negative: hangs); 1 is about 45°
  double wander = 0.0;  ///< how far each joint turns at random
};

/// A stem that tapers to a point.
Stem grow_stem(const StemGrowth& growth, RandomStream& random);

/// Along the stem; `ratio` runs over its rings from 0 at the root to 1 at the tip.
Eigen::Vector3d stem_point(const Stem& stem, double ratio);
double stem_radius_m(const Stem& stem, double ratio);
Eigen::Vector3d stem_direction(const Stem& stem, double ratio);

/// A direction at `angle_rad` from `axis`, turned about it by `turn_rad`.
Eigen::Vector3d turned_from(const Eigen::Vector3d& axis, double angle_rad, double turn_rad);

/// `middle` × (1 ± ratio), uniform.
double varied(double middle, double ratio, RandomStream& random);

}  // namespace avoidbench
