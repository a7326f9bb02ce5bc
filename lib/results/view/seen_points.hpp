#pragma once

#include <vector>

#include "plugin/drawings.hpp"
#include "plugin/planner_instance.hpp"

namespace avoidbench {

/// What a planner's lidars saw last, as drawings beside its own.
class SeenPoints {
 public:
  /// At most `most_points` a lidar, evenly chosen.
  explicit SeenPoints(std::size_t most_points) : most_points_(most_points) {}

  void see(const PlannerView& view);
  const std::vector<Drawing>& drawings() const { return drawings_; }

 private:
  std::size_t most_points_;
  std::vector<Drawing> drawings_;  ///< by lidar
};

}  // namespace avoidbench
