#pragma once

#include <Eigen/Core>
#include <vector>

#include "primitive.hpp"

namespace mbplanner {

/// Where the vehicle has been, for the way back.
class FlownPath {
 public:
  void forget() { places_.clear(); }

  /// Adds a place that is a step away from the last; a loop back to an older place is cut off.
  void visit(const Eigen::Vector3d& position);

  /// Knots from rest at `from` back along the last `length_m` to rest there; empty where nothing
  /// was flown.
  std::vector<Motion> back(const Eigen::Vector3d& from, double length_m,
                           const Limits& limits) const;

  const std::vector<Eigen::Vector3d>& places() const { return places_; }

 private:
  std::vector<Eigen::Vector3d> places_;
};

}  // namespace mbplanner
