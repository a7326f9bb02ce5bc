#pragma once

#include <array>

#include "base/random.hpp"
#include "curve.hpp"
#include "trajectory_cost.hpp"

namespace agile {

/// A trajectory and what it costs.
struct Label {
  planning::Quintic curve;
  double cost = 0.0;
};

/// The three best ways from the situation's start that differ from each other, best first: curves
/// to ends all over the reach are costed, the best of them changed at random as long as that makes
/// them better. Ways that are much worse than the best give way to copies of it.
std::array<Label, kModes> expert_labels(const ClearanceField& field, const Situation& situation,
                                        avoidbench::RandomStream& random);

}  // namespace agile
