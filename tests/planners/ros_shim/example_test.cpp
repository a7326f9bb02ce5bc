#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "geometry/pose.hpp"
#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

TEST(RosExample, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

/// A flight along y over level ground with nothing in the way; the vehicle is where it was told to
/// be, and stays there until it is told something.
class RosExampleFlight : public testing::Test {
 protected:
  RosExampleFlight() {
    PlannerMission mission;
    mission.start_world = position_ = {0.0, 0.0, 2.0};
    mission.goal_world = {0.0, 10.0, 2.0};
    mission.start_yaw_rad = 0.5 * math::kPi;
    mission.goal_radius_m = 0.8;
    mission.time_limit_s = 60.0;
    EXPECT_EQ(planner_.reset(mission), "");
  }

  /// One call, 1/30 s after the last.
  PlanResult step() {
    PlannerView view;
    view.time_s = view.call_time_s = time_s_;
    view.position_world = position_;
    view.velocity_world = velocity_;
    view.rates_body = Vector3d::Zero();
    view.q_world_body = yaw_rotation(0.5 * math::kPi);
    DepthView depth;
    depth.time_s = time_s_;
    depth.T_world_camera = make_pose(position_, view.q_world_body) * camera_.T_body_camera;
    const std::vector<float> pixels =
        kinematic::depth_image(kinematic::meadow(), camera_, depth.T_world_camera);
    depth.depth_m = pixels;
    view.depth.push_back(depth);
    PlanResult plan = planner_.plan(view);
    time_s_ += kPeriod_s;
    if (plan.status != PlanStatus::command || plan.points.size() < 2) return plan;
    const ab_point &from = plan.points[0], &to = plan.points[1];
    const double share = kPeriod_s / to.time_s;
    const auto between = [share](const double(&a)[3], const double(&b)[3]) {
      return Vector3d((1.0 - share) * Vector3d::Map(a) + share * Vector3d::Map(b));
    };
    position_ = between(from.position_world_m, to.position_world_m);
    velocity_ = between(from.velocity_world_mps, to.velocity_world_mps);
    return plan;
  }

  static constexpr double kPeriod_s = 1.0 / 30.0;
  CameraSetup camera_ = kinematic::vehicle_setup().cameras.front();
  PlannerInstance planner_ = kinematic::instance_of(PLANNER_FILE);
  Vector3d position_, velocity_ = Vector3d::Zero();
  double time_s_ = 0.0;
};

/// At the 1.5 m/s of its parameter, after the second that its planner sleeps at its start.
TEST_F(RosExampleFlight, IsStraightToTheGoalAndStopsThere) {
  double fastest_mps = 0.0, farthest_aside_m = 0.0, arrived_s = 0.0;
  while (time_s_ < 25.0) {
    const PlanResult plan = step();
    ASSERT_TRUE(plan.status == PlanStatus::command || plan.status == PlanStatus::no_plan)
        << plan.reason;
    fastest_mps = std::max(fastest_mps, velocity_.norm());
    farthest_aside_m = std::max(farthest_aside_m, std::hypot(position_.x(), position_.z() - 2.0));
    if (arrived_s == 0.0 && position_.y() > 9.2) arrived_s = time_s_;
  }
  EXPECT_NEAR(position_.y(), 10.0, 0.3);
  EXPECT_LT(velocity_.norm(), 0.05);
  EXPECT_LT(farthest_aside_m, 0.1);
  EXPECT_GT(fastest_mps, 1.3);
  EXPECT_LT(fastest_mps, 1.05 * 1.5);
  EXPECT_GT(arrived_s, 1.0 + 9.2 / 1.5);
  EXPECT_LT(arrived_s, 1.0 + 9.2 / 1.5 + 3.0);
}

/// Two plan periods of its server's last set point.
TEST_F(RosExampleFlight, IsByTrajectoriesOfTwoPlanPeriods) {
  PlanResult plan;
  while (time_s_ < 2.0) plan = step();
  ASSERT_EQ(plan.status, PlanStatus::command) << plan.reason;
  ASSERT_EQ(plan.command.kind, std::uint32_t{AB_COMMAND_TRAJECTORY});
  ASSERT_EQ(plan.points.size(), 2U);
  EXPECT_NEAR(plan.points[1].time_s, 2.0 * kPeriod_s, 1e-9);
}

}  // namespace
}  // namespace avoidbench
