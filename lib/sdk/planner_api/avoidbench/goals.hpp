/* The goals of a mission, for planners that declare AB_INPUT_GOALS; a part of planner.hpp, which
 * includes it.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_GOALS_HPP
#define AVOIDBENCH_GOALS_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "avoidbench/canvas.hpp"
#include "avoidbench/planner.h"

namespace avoidbench {

/// All goals in order, each at its place at the start.
inline std::vector<Vec3> goals_of(const ab_mission& mission) {
  // Older hosts know of one goal.
  const bool has_goals =
      mission.struct_size >= offsetof(ab_mission, goals_world_m) + sizeof(double*) &&
      mission.goal_count > 0;
  const double* numbers = has_goals ? mission.goals_world_m : mission.goal_world_m;
  std::vector<Vec3> goals(has_goals ? mission.goal_count : 1);
  for (Vec3& goal : goals) {
    std::copy_n(numbers, 3, goal.begin());
    numbers += 3;
  }
  return goals;
}

/// The goal to fly to now. Keep one, reset() it with the planner and update() it in each plan().
class CurrentGoal {
 public:
  void reset(const ab_mission& mission) {
    index_ = 0;
    std::copy(std::begin(mission.goal_world_m), std::end(mission.goal_world_m), place_.begin());
  }

  /// Whether anything changed: the next goal is current, or the goal has moved.
  bool update(const ab_observation& seen) {
    // Older hosts show none: the mission's stays.
    if (seen.struct_size < offsetof(ab_observation, goal_world_m) + sizeof seen.goal_world_m) {
      return false;
    }
    Vec3 place{};
    std::copy(std::begin(seen.goal_world_m), std::end(seen.goal_world_m), place.begin());
    is_next_ = seen.goal_index != index_;
    const bool has_changed = is_next_ || place != place_;
    index_ = seen.goal_index;
    place_ = place;
    return has_changed;
  }

  /// Whether the last update() brought another goal, rather than one that has moved.
  bool is_next() const { return is_next_; }
  const Vec3& place_world_m() const { return place_; }

 private:
  std::uint32_t index_ = 0;
  bool is_next_ = false;
  Vec3 place_{};
};

}  // namespace avoidbench

#endif
