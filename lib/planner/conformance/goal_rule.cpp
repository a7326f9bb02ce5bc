#include "conformance/goal_rule.hpp"

#include <algorithm>

#include "conformance/conformance_flight.hpp"
#include "conformance/own_process.hpp"

namespace avoidbench {
namespace {

/// wall_flight() with two goals, the second one `aside_m` to the left, whose turn comes early.
ConformanceFlight two_goals(double aside_m) {
  constexpr std::size_t kCallsToFirst = 5;
  ConformanceFlight flight = wall_flight();
  flight.mission.goal_world = flight.mission.start_world + Eigen::Vector3d(2.0, 0.0, 0.0);
  const Eigen::Vector3d second = flight.mission.goal_world + Eigen::Vector3d(0.0, aside_m, 0.0);
  flight.mission.goals_world = {flight.mission.goal_world, second};
  for (std::size_t i = kCallsToFirst; i < flight.frames.size(); ++i) {
    flight.frames[i].goal = GoalView{.index = 1, .place_world = second};
  }
  return flight;
}

}  // namespace

std::string flies_to_the_next_goal(const PlannerLibrary& library) {
  if ((library.description().needs & AB_INPUT_GOALS) == 0) return "";
  constexpr double kAside_m = 4.0;
  std::vector<std::vector<Reply>> flights;
  for (const double aside_m : {kAside_m, -kAside_m}) {
    flights.push_back(replies_in_own_process(library, [&] {
      Probe probe(library.table(), resolve_parameters(library.description(), {}));
      return probe.is_created() ? probe.fly(two_goals(aside_m)) : std::vector<Reply>{};
    }));
    for (std::size_t i = 0; i < flights.back().size(); ++i) {
      const Reply& reply = flights.back()[i];
      std::string problem = reply_problem(reply, library.table());
      if (problem.empty() && reply.status == AB_ERROR) problem = "AB_ERROR: " + reply.error;
      if (!problem.empty()) return "two goals, " + reply_place(i) + ": " + problem;
    }
  }
  if (!std::equal(flights[0].begin(), flights[0].end(), flights[1].begin(), flights[1].end(),
                  equal)) {
    return "";
  }
  return "it declares AB_INPUT_GOALS, and its commands are the same with the next goal to the left "
         "and to the right: fly to ab_observation.goal_world_m";
}

}  // namespace avoidbench
