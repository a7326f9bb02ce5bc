#include "env/actions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "control/trajectory.hpp"
#include "plugin/command_check.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// At (1, 2, 3), 2 m/s along world y, the nose along world y and a little down.
PlannerView view_ahead() {
  PlannerView view;
  view.position_world = {1, 2, 3};
  view.velocity_world = {0, 2, 0};
  view.rates_body.setZero();
  view.q_world_body = Eigen::AngleAxisd(0.5 * math::kPi, Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(0.2, Vector3d::UnitY());
  return view;
}

Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

TEST(Actions, VelocitiesTurnWithTheHeadingAlone) {
  const std::vector<double> action{3, 1, 0.5, 0.2};
  const PlanResult result = plan_result({.kind = ActionKind::velocity}, action, view_ahead(), 0.0);
  EXPECT_EQ(result.status, PlanStatus::command);
  EXPECT_EQ(result.command.kind, AB_COMMAND_VELOCITY);
  EXPECT_LT((vector(result.command.velocity_world_mps) - Vector3d(-1, 3, 0.5)).norm(), 1e-12);
  EXPECT_EQ(result.command.flags, AB_YAW_IS_RATE);
  EXPECT_EQ(result.command.yaw_rate_radps, 0.2);
  EXPECT_TRUE(std::isnan(result.cpu_time_s)) << "nobody measured it";
}

TEST(Actions, OfTheWorldFrameAreTakenAsTheyAre) {
  const std::vector<double> action{3, 1, 0.5, 0.2};
  const ActionSpec spec{.kind = ActionKind::acceleration, .frame = ActionFrame::world};
  const PlanResult result = plan_result(spec, action, view_ahead(), 0.0);
  EXPECT_EQ(result.command.kind, AB_COMMAND_ACCELERATION);
  EXPECT_EQ(vector(result.command.acceleration_world_mps2), Vector3d(3, 1, 0.5));
}

TEST(Actions, RatesAndThrustAreOfTheBody) {
  const std::vector<double> action{0.1, -0.2, 0.3, 11};
  const PlanResult result =
      plan_result({.kind = ActionKind::rates_thrust}, action, view_ahead(), 0.0);
  EXPECT_EQ(result.command.kind, AB_COMMAND_RATES);
  EXPECT_EQ(vector(result.command.rates_body_radps), Vector3d(0.1, -0.2, 0.3));
  EXPECT_EQ(result.command.thrust_mps2, 11);
}

/// Points ahead on the line that a steady flight would take.
std::vector<double> steady_points(const ActionSpec& spec, double speed_mps) {
  std::vector<double> action;
  for (int i = 1; i <= spec.points; ++i) {
    const double time_s = spec.horizon_s * i / static_cast<double>(spec.points);
    action.insert(action.end(), {speed_mps * time_s, 0.0, 0.0, 0.1 * time_s});
  }
  return action;
}

/// What the vehicle's controller makes of it.
std::vector<TrajectoryPoint> flown(const PlanResult& result) {
  ab_command command = result.command;
  command.points = result.points.data();
  EXPECT_EQ(command_problem(command, AB_COMMAND_TRAJECTORY), "");
  return vehicle_command(result, 0).trajectory;
}

TEST(Actions, APointedTrajectoryOfSteadyFlightIsSteadyFlight) {
  const ActionSpec spec{.kind = ActionKind::trajectory, .points = 5, .horizon_s = 1.0};
  for (const double latency_s : {0.0, 0.033, 0.2, 0.45}) {
    const auto points = flown(plan_result(spec, steady_points(spec, 2.0), view_ahead(), latency_s));
    std::size_t piece = 0;
    for (double time_s = 0.0; time_s <= 1.0 - latency_s; time_s += 0.07) {
      const Reference at = sample_trajectory(points, time_s, piece);
      EXPECT_LT((at.position_world - Vector3d(1, 2 + 2 * (time_s + latency_s), 3)).norm(), 1e-9);
      EXPECT_LT((at.velocity_world - Vector3d(0, 2, 0)).norm(), 1e-9);
      EXPECT_LT(at.acceleration_world.norm(), 1e-9);
      EXPECT_NEAR(at.yaw_rad, 0.5 * math::kPi + 0.1 * (time_s + latency_s), 1e-9);
    }
  }
}

TEST(Actions, ACurvedTrajectoryPassesItsPointsAndIsTheSameCurveWhenItActsLate) {
  const ActionSpec spec{.kind = ActionKind::trajectory, .points = 4, .horizon_s = 2.0};
  const std::vector<double> action{1, 0.2, 0, 0, 2, 0.8, 0.1, 0, 2.8, 1.8, 0.3, 0, 3, 3, 0.6, 0};
  const auto at_once = flown(plan_result(spec, action, view_ahead(), 0.0));
  ASSERT_EQ(at_once.size(), 5U);
  EXPECT_LT((at_once[2].position_world - Vector3d(1 - 0.8, 2 + 2, 3.1)).norm(), 1e-9);
  EXPECT_EQ(at_once[0].velocity_world, Vector3d(0, 2, 0));
  EXPECT_LT(at_once[4].acceleration_world.norm(), 1e-12);
  const auto late = flown(plan_result(spec, action, view_ahead(), 0.6));
  ASSERT_EQ(late.size(), 4U);
  std::size_t piece = 0, late_piece = 0;
  for (double time_s = 0.6; time_s <= 2.0; time_s += 0.05) {
    const Reference a = sample_trajectory(at_once, time_s, piece);
    const Reference b = sample_trajectory(late, time_s - 0.6, late_piece);
    EXPECT_LT((a.position_world - b.position_world).norm(), 1e-9) << time_s;
    EXPECT_LT((a.velocity_world - b.velocity_world).norm(), 1e-9) << time_s;
    EXPECT_LT((a.acceleration_world - b.acceleration_world).norm(), 1e-8) << time_s;
  }
  EXPECT_EQ(flown(plan_result(spec, action, view_ahead(), 5.0)).size(), 2U)
      << "it acts after its end: what is left is the end";
}

TEST(Actions, LimitsAreTheVehicles) {
  const VehicleSpec vehicle = hummingbird_spec();
  const ActionLimits velocity = action_limits({.kind = ActionKind::velocity}, vehicle);
  EXPECT_THAT(velocity.highest, testing::ElementsAre(8, 8, 8, 2.5));
  EXPECT_THAT(velocity.lowest, testing::ElementsAre(-8, -8, -8, -2.5));
  const ActionLimits rates = action_limits({.kind = ActionKind::rates_thrust}, vehicle);
  EXPECT_EQ(rates.lowest[3], 0.0);
  // Four rotors at their greatest speed, over the mass.
  EXPECT_NEAR(rates.highest[3], 4 * 8.54858e-6 * 838.0 * 838.0 / vehicle.mass_kg, 1e-9);
  const ActionSpec trajectory{.kind = ActionKind::trajectory, .points = 3, .horizon_s = 0.5};
  EXPECT_EQ(action_width(trajectory), 12U);
  EXPECT_EQ(action_limits(trajectory, vehicle).highest[0], 4.0);
}

TEST(Actions, ThatAreNoNumbersAreNamed) {
  const auto problem = [](ActionKind kind, const std::vector<double>& action) {
    return action_problem({.kind = kind}, action);
  };
  EXPECT_EQ(problem(ActionKind::velocity, {0, 1e6, -1e6, 9e4}), "");
  EXPECT_EQ(problem(ActionKind::velocity, {0, math::kNaN}), "number 1 of the action is not finite");
  EXPECT_THAT(problem(ActionKind::velocity, {2e6}), testing::HasSubstr("2e+06, beyond ±1e+06"));
  EXPECT_EQ(problem(ActionKind::rates_thrust, {0, 0, 0, 1e6}), "");
  for (const ActionKind kind : {ActionKind::acceleration, ActionKind::trajectory}) {
    EXPECT_THAT(problem(kind, {0, 0, 0, -1e5}), testing::HasSubstr("beyond ±9e+04"));
  }
}

TEST(Actions, TrajectoriesShorterThanTheLatencyKeepTheirEnd) {
  for (const std::int64_t points : {1, 10, 1000}) {
    const ActionSpec spec{.kind = ActionKind::trajectory, .points = points, .horizon_s = 0.01};
    const std::vector<double> action(action_width(spec), 1.0);
    const std::vector<TrajectoryPoint> left = flown(plan_result(spec, action, view_ahead(), 0.033));
    ASSERT_GE(left.size(), 2U) << points;
    EXPECT_LT((left.back().position_world - Vector3d(0, 3, 4)).norm(), 1e-9) << points;
  }
}

TEST(Actions, AHeadingIsThereStraightUpToo) {
  for (const double pitch_rad : {0.0, 0.7, 0.5 * math::kPi, -0.5 * math::kPi}) {
    const Eigen::Matrix3d R =
        rotation_world_heading(Eigen::Quaterniond(Eigen::AngleAxisd(pitch_rad, Vector3d::UnitY())));
    EXPECT_LT((R - Eigen::Matrix3d::Identity()).norm(), 1e-6) << pitch_rad;
  }
}

}  // namespace
}  // namespace avoidbench
