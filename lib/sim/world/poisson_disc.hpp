#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/random.hpp"

namespace avoidbench {

/// Points of [0, size_m.x) × [0, size_m.y), no two nearer than `radius_m`, and no room for one
/// more. Bridson's sampler (Fast Poisson disk sampling in arbitrary dimensions, 2007; 30 candidates
/// a point) leaves a few gaps; these are then found and filled by subdividing the squares that no
/// single disc covers (Ebeida et al., A simple algorithm for maximal Poisson-disk sampling in high
/// dimensions, 2012), down to gaps of a billionth of the radius.
std::vector<Eigen::Vector2d> poisson_disc(const Eigen::Vector2d& size_m, double radius_m,
                                          RandomStream& random);

}  // namespace avoidbench
