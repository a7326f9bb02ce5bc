#pragma once

#include <optional>
#include <vector>

#include "tree.hpp"

namespace mbplanner {

/// A place that lost time: within the radius the goal counts as farther.
struct Trap {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double weight_m = 0.0, radius_m = 1.0;
};

/// How far a place is from the goal, traps counted in.
struct Potential {
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  std::vector<Trap> traps;

  double at(const Eigen::Vector3d& position) const;
};

/// A way to go, and how to stop at its end: knots after the root.
struct Choice {
  std::vector<Motion> path, safe_path;
  std::vector<Primitive> primitives;  ///< of the path; none of a way straight to the goal
  double gain_m = 0.0;                ///< progress of the stop, less what the path costs
  double progress_m = 0.0;
  double clearance = 0.0;  ///< 0 to 1
};

/// Whether the vehicle can stop after this motion without leaving known free space: by braking
/// straight on, or by an evasive arc and braking then. The knots of that, or nothing.
std::optional<std::vector<Motion>> safe_path(const Motion& from, const Space& space,
                                             const Limits& limits, const Settings& settings);

/// Of hard braking, hard evasive arcs and what is flown at `present`, one that is free in `space`,
/// or the one that stays clear of known obstacles longest as `body` sees them.
std::vector<Motion> least_bad_stop(const Motion& from, const std::vector<Motion>& present,
                                   const Space& space, const Space& body, const Limits& limits,
                                   const Settings& settings);

/// Whether all of these knots are free; checked where half a box has been flown since.
bool are_free(const std::vector<Motion>& knots, const Space& space);

/// Mean over the path of how much room is around the box, 0 to 1.
double clearance_of(const std::vector<Motion>& path, const Space& space);

/// Dynamic time warping: mean distance of two paths' points when each goes with its nearest in
/// order.
double dissimilarity_m(const std::vector<Motion>& a, const std::vector<Motion>& b);

/// The best way through the tree from whose end it can stop, if one makes at least this progress.
/// `flown` is what is left of the present path, or empty.
std::optional<Choice> choose(const Tree& tree, const Task& task, const Potential& potential,
                             const Settings& settings, const std::vector<Motion>& flown,
                             double least_progress_m);

}  // namespace mbplanner
