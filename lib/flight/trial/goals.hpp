#pragma once

#include <string>
#include <vector>

#include "render/scene.hpp"
#include "trial/mission.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

/// The goals of a flight: where they are and when they were reached.
namespace avoidbench {

/// The way of a goal: a function of time alone.
struct GoalWay {
  GoalMotionSpec motion;
  Eigen::Vector3d place_world;  ///< where it is at time 0
  Eigen::Vector3d ahead_world;  ///< horizontal, of length 1: the course from the goal before it
};

GoalWay goal_way(const MissionSpec& spec, const Eigen::Vector3d& before_world,
                 const Eigen::Vector3d& place_world);
Eigen::Vector3d place_at(const GoalWay& way, double time_s);

/// Whether a goal that moves keeps its free radius and stays in the flight bounds all along.
bool is_way_free(const Scene& scene, const MissionSpec& spec, const GoalWay& way);

/// The way of the last goal of a mission.
GoalWay last_goal_way(const MissionSpec& spec, const Mission& mission);

/// Where goal `index` of goals_of() is.
Eigen::Vector3d goal_place(const MissionSpec& spec, const Mission& mission, std::size_t index,
                           double time_s);

/// Horizontally: a goal is a circle, at any height.
double distance_to_goal_m(const MissionSpec& spec, const Mission& mission, std::size_t index,
                          const Eigen::Vector3d& place_world, double time_s);

/// What of the mission asks for AB_INPUT_GOALS: "several goals", "a goal that moves"; "" for
/// nothing.
std::string goals_demand(const MissionSpec& spec, const Mission& mission);

/// When the goals were reached that were, in order. A flight has a sample at each of these moments.
std::vector<double> goal_times_s(const MissionSpec& spec, const Mission& mission,
                                 const TrialRecord& record);

}  // namespace avoidbench
