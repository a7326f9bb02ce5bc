#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidbench/planner.h"
#include "plugin/planner_instance.hpp"

namespace avoidbench {

/// The host's end of AB_WORLD_EXTENSION: passes the planner's questions on. Stays at its address.
class WorldDoor {
 public:
  explicit WorldDoor(bool is_open);
  WorldDoor(const WorldDoor&) = delete;
  WorldDoor& operator=(const WorldDoor&) = delete;

  /// Null where the planner has not declared that it wants the world.
  const ab_world* table() const { return is_open_ ? &table_ : nullptr; }
  PlannerWorld world;  ///< of the trial; its functions are empty before the first

 private:
  ab_status answer_path(double radius_m);

  bool is_open_;
  ab_world table_{};
  std::vector<double> path_world_m_;  ///< that shortest_path() gave last
};

}  // namespace avoidbench
