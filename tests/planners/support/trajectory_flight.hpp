#pragma once

#include "planners/support/kinematic_flight.hpp"

/// As kinematic::fly, for planners that command trajectories: the vehicle is where the command says
/// it ought to be, one plan period late.
namespace avoidbench::kinematic {

/// What the commands of a flight asked for at most.
struct Demands {
  double speed_mps = 0.0, acceleration_mps2 = 0.0, yaw_rate_radps = 0.0;
  double body_rate_radps = 0.0;               ///< that turns the thrust as the acceleration does
  double jump_m = 0.0, speed_jump_mps = 0.0;  ///< between what a command and the next one ask for
  double end_speed_mps = 0.0;                 ///< at the last point of a command
};

struct TrajectoryResult {
  Result flight;
  Demands demands;
};

/// Flies until the goal is within 0.8 m, a surface within 0.3 m of the body's centre, or
/// `time_limit_s`.
TrajectoryResult fly_trajectories(PlannerInstance& planner, const Course& course,
                                  double time_limit_s = 60.0, std::uint64_t seed = 1);

/// Expects that all that was commanded keeps the vehicle's limits and this speed, and that one
/// command goes on where the other is.
void expect_flyable(const Demands& demands, double speed_mps);

/// Flights of the forests with the seeds 0 … count - 1 that reach the goal; expects that no flight
/// fails otherwise than by collision or time, and that all keep the limits.
int reached_count(PlannerInstance& planner, double poisson_radius_m, std::uint64_t count,
                  double speed_mps);

/// Expects that instances in several threads fly as one alone does.
void expect_same_in_threads(const std::string& file);

/// Expects no plan, and no failure, for goals that are nowhere: NaN, infinite, beyond all numbers.
void expect_no_plan_to_nowhere(PlannerInstance& planner);

/// Expects that this process is no larger after `count` short missions than after the first ten.
void expect_no_growth(PlannerInstance& planner, int count);

}  // namespace avoidbench::kinematic
