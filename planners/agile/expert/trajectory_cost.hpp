#pragma once

#include "clearance_field.hpp"
#include "planning/polynomial.hpp"
#include "situation.hpp"

namespace agile {

/// What a curve costs somebody who knows the map: what the expert makes least, the net learns to
/// predict, and training descends (train/cost.py has the same terms and figures).
struct TrajectoryCost {
  double collision = 0.0;  ///< mean over the way of a penalty for surfaces within 0.8 m
  double progress = 0.0;   ///< share of the reach that it does not come nearer to the goal
  double effort = 0.0;     ///< of acceleration and jerk
  double limits = 0.0;     ///< beyond the desired speed and 6 m/s²
  double view = 0.0;       ///< to where the camera does not look
  double height = 0.0;     ///< above or below the line to the goal

  double total() const { return 2.0 * collision + progress + effort + limits + view + height; }
};

/// `curve` begins at the situation's start and lasts kHorizon_s.
TrajectoryCost trajectory_cost(const ClearanceField& field, const Situation& situation,
                               const planning::Quintic& curve);

}  // namespace agile
