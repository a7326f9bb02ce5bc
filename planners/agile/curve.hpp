#pragma once

#include <Eigen/Core>
#include <array>

#include "planning/polynomial.hpp"
#include "situation.hpp"

namespace agile {

/// A mode as the net gives it: points at T/10, 2T/10, … T after the start, from the start, in the
/// image's frame, over the reach.
using ModePoints = std::array<std::array<float, 3>, kPoints>;

/// The polynomial of degree 5 that begins with the start's motion and is nearest to the points in
/// the least-squares sense: a mode as it is flown. In the world, over kHorizon_s.
planning::Quintic projected(const Situation& situation, const ModePoints& points);

/// The points of a curve that begins at the start's position: the inverse, for labels.
ModePoints points_of(const Situation& situation, const planning::Quintic& curve);

/// What a curve asks for at most.
struct Demand {
  double speed_mps = 0.0, acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
};
Demand demand_of(const planning::Quintic& curve);

}  // namespace agile
