#include "pilot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "avoidbench/planner_eigen.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPeriod_s = 1.0 / 30.0;

/// To full speed along the camera's heading and this much aside, as a vehicle can.
Mode ahead(const Situation& situation, float cost, double aside_m = 0.0) {
  const double speed_mps = situation.desired_speed_mps;
  const double now_mps = turned_to_frame(situation.frame, situation.start.velocity).x();
  const Vector3d way(0.5 * (now_mps + speed_mps) * kHorizon_s, aside_m, 0.0);
  const planning::Motion end{situation.start.position + turned_to_world(situation.frame, way),
                             turned_to_world(situation.frame, speed_mps * way.normalized()),
                             Vector3d::Zero()};
  return {cost, points_of(situation, quintic_between(situation.start, end, kHorizon_s))};
}
Modes all(const Mode& mode) { return {mode, mode, mode}; }

/// A flight without dynamics: the vehicle is where it was told to be.
class PilotTest : public testing::Test {
 protected:
  PilotTest() {
    mission_.struct_size = sizeof mission_;
    avoidbench::as_vector(mission_.start_world_m) = Vector3d(0.0, 0.0, 2.0);
    avoidbench::as_vector(mission_.goal_world_m) = Vector3d(30.0, 0.0, 2.0);
    avoidbench::as_vector(mission_.lowest_world_m) = Vector3d(-5.0, -20.0, 0.0);
    avoidbench::as_vector(mission_.highest_world_m) = Vector3d(60.0, 20.0, 6.0);
    mission_.command_latency_s = kPeriod_s;
    image_.struct_size = sizeof image_;
    image_.width_px = image_.height_px = 8;
    image_.fx_px = image_.fy_px = 4.0;
    image_.cx_px = image_.cy_px = 3.5;
    depth_m_.assign(64, std::numeric_limits<float>::infinity());
    image_.depth_m = depth_m_.data();
  }

  Pilot begun(Think think) {
    Pilot pilot(settings_, std::move(think));
    pilot.reset(mission_);
    position_ = avoidbench::as_vector(mission_.start_world_m);
    velocity_.setZero();
    yaw_rad_ = mission_.start_yaw_rad;
    time_s_ = 0.0;
    return pilot;
  }

  void step(Pilot& pilot, bool has_image = true) {
    // RDF axes of a camera that looks where the vehicle does.
    const Eigen::Quaterniond q(Eigen::AngleAxisd(yaw_rad_, Vector3d::UnitZ()).toRotationMatrix() *
                               (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished());
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(wxyz), std::end(wxyz), image_.q_world_camera);
    avoidbench::as_vector(image_.position_world_m) = position_;
    points_ = pilot.plan({.time_s = time_s_,
                          .position_world = position_,
                          .velocity_world = velocity_,
                          .depth = has_image ? &image_ : nullptr});
    for (const ab_point& point : points_) {
      const auto finite = [](const double(&v)[3]) { return avoidbench::as_vector(v).allFinite(); };
      ASSERT_TRUE(finite(point.position_world_m) && finite(point.velocity_world_mps));
      ASSERT_TRUE(std::isfinite(point.yaw_rad));
      fastest_mps_ = std::max(fastest_mps_, avoidbench::as_vector(point.velocity_world_mps).norm());
    }
    ASSERT_GE(points_.size(), 2U);
    // Its effect is at the next call.
    position_ = avoidbench::as_vector(points_[0].position_world_m);
    velocity_ = avoidbench::as_vector(points_[0].velocity_world_mps);
    yaw_rad_ = points_[0].yaw_rad;
    time_s_ += kPeriod_s;
  }
  void fly(Pilot& pilot, double duration_s) {
    const double end_s = time_s_ + duration_s;
    while (time_s_ < end_s && !HasFatalFailure()) step(pilot);
  }

  Settings settings_;
  ab_mission mission_{};
  ab_depth_image image_{};
  std::vector<float> depth_m_;
  Vector3d position_, velocity_;
  double yaw_rad_ = 0.0, time_s_ = 0.0, fastest_mps_ = 0.0;
  std::vector<ab_point> points_;
};

TEST_F(PilotTest, FliesTheCheapestModeAtFullSpeed) {
  Pilot pilot = begun([](const Situation& s, const Image&) {
    return Modes{ahead(s, 0.6F, 2.0), ahead(s, 0.1F), ahead(s, 0.6F, -2.0)};
  });
  fly(pilot, 5.0);
  EXPECT_GT(velocity_.x(), 2.4);
  EXPECT_NEAR(position_.y(), 0.0, 1e-9);
  EXPECT_LE(fastest_mps_, 3.0 * 1.05 + 1e-9);
}

TEST_F(PilotTest, StaysWithItsModeWhileThatIsHardlyWorse) {
  int call = 0;
  Pilot pilot = begun([&](const Situation& s, const Image&) {
    // Which side is cheaper changes with each image.
    const float left = ++call % 2 == 0 ? 0.20F : 0.25F;
    return Modes{ahead(s, left, 2.0), ahead(s, 0.225F, -2.0), ahead(s, 2.0F)};
  });
  fly(pilot, 1.0);
  const double side = position_.y();
  ASSERT_GT(std::abs(side), 0.02);
  fly(pilot, 1.0);
  EXPECT_GT(position_.y() / side, 1.5);
}

TEST_F(PilotTest, BrakesWhereNoModeIsGoodEnoughAndGoesOnWhereOneIs) {
  float cost = 0.1F;
  Pilot pilot = begun([&](const Situation& s, const Image&) { return all(ahead(s, cost)); });
  fly(pilot, 4.0);
  ASSERT_GT(velocity_.x(), 2.2);
  const double before_m = position_.x();
  cost = 1.2F;
  fly(pilot, 2.0);
  EXPECT_LT(velocity_.norm(), 1e-6);
  // 3 m/s at 0.7 × 6 m/s² on the mean, less than the peak.
  EXPECT_LT(position_.x() - before_m, 3.0);
  cost = 0.1F;
  fly(pilot, 3.0);
  EXPECT_GT(velocity_.x(), 1.5);
}

TEST_F(PilotTest, LooksAboutWhileItSeesNoWay) {
  Pilot pilot = begun([](const Situation& s, const Image&) { return all(ahead(s, 1.5F)); });
  double left_rad = 0.0, right_rad = 0.0;
  for (int i = 0; i < 360; ++i) {
    step(pilot);
    left_rad = std::max(left_rad, yaw_rad_);
    right_rad = std::min(right_rad, yaw_rad_);
  }
  EXPECT_GT(left_rad, 0.6);
  EXPECT_LT(right_rad, -0.5);
  EXPECT_LT((position_ - Vector3d(0.0, 0.0, 2.0)).norm(), 1e-9);
}

/// Ever farther to both sides of the goal, left first, and then from the middle on again.
TEST_F(PilotTest, LooksAboutInOrder) {
  settings_.scan_s = 4.0;
  settings_.scan_rad = 0.4;
  Pilot pilot = begun([](const Situation& s, const Image&) { return all(ahead(s, 1.5F)); });
  double end_s = 0.0;
  for (const int steps : {0, 1, -1, 2, -2, 3, -3, 0, 1}) {
    // Nearly to the end of this look, which is long enough to turn.
    end_s += settings_.scan_s;
    fly(pilot, end_s - 2.0 * kPeriod_s - time_s_);
    EXPECT_NEAR(yaw_rad_, settings_.scan_rad * steps, 0.01) << steps;
  }
}

TEST_F(PilotTest, TurnsToAGoalBehindBeforeItFlies) {
  mission_.start_yaw_rad = 3.1;
  Pilot pilot = begun([](const Situation& situation, const Image&) {
    const Vector3d to_goal = turned_to_frame(situation.frame, goal_direction_world(situation));
    return all(ahead(situation, to_goal.x() > 0.9 ? 0.1F : 1.5F));
  });
  fly(pilot, 1.0);
  EXPECT_LT(velocity_.norm(), 1e-9);
  fly(pilot, 5.0);
  EXPECT_GT(velocity_.x(), 2.0);
}

TEST_F(PilotTest, GoesOnWithoutANewImageAndStopsAtTheEndOfWhatItSaw) {
  Pilot pilot = begun([](const Situation& s, const Image&) { return all(ahead(s, 0.1F)); });
  fly(pilot, 3.0);
  const double before_m = position_.x();
  for (int i = 0; i < 150; ++i) step(pilot, false);
  EXPECT_LT(velocity_.norm(), 1e-6);
  EXPECT_GT(position_.x() - before_m, 5.0);
  EXPECT_LT(position_.x() - before_m, 10.0);
}

TEST_F(PilotTest, PlansFromTheOdometryWhereTheVehicleCantFollow) {
  std::vector<Situation> situations;
  Pilot pilot = begun([&](const Situation& situation, const Image&) {
    situations.push_back(situation);
    return all(ahead(situation, 0.1F));
  });
  fly(pilot, 2.0);
  position_ += Vector3d(0.0, 1.5, 0.0);
  velocity_ = Vector3d(0.5, 0.0, 0.0);
  step(pilot);
  EXPECT_NEAR(situations.back().start.position.y(), 1.5, 1e-9);
  EXPECT_NEAR(situations.back().start.velocity.x(), 0.5, 1e-9);
  // Not for an error of centimetres.
  position_ += Vector3d(0.0, 0.05, 0.0);
  step(pilot);
  EXPECT_LT(std::abs(situations.back().start.position.y() - 1.5), 0.04);
}

TEST_F(PilotTest, SlowsDownNearTheGoal) {
  std::vector<double> speeds_mps;
  Pilot pilot = begun([&](const Situation& situation, const Image&) {
    speeds_mps.push_back(situation.desired_speed_mps);
    return all(ahead(situation, 0.1F));
  });
  fly(pilot, 1.0);
  EXPECT_EQ(speeds_mps.back(), 3.0);
  avoidbench::as_vector(mission_.goal_world_m) = Vector3d(0.5, 0.0, 2.0);
  pilot.reset(mission_);
  position_ = Vector3d(0.0, 0.0, 2.0);
  velocity_.setZero();
  time_s_ = 0.0;
  step(pilot);
  EXPECT_NEAR(speeds_mps.back(), 1.0, 1e-12);
}

/// Whatever a net says: a mode beyond the vehicle's limits is flown on a shorter way or not at all.
TEST_F(PilotTest, NeverCommandsMoreThanTheVehicleCan) {
  Pilot pilot = begun([&](const Situation& s, const Image&) {
    Mode wild = ahead(s, 0.0F), broken = wild;
    for (std::size_t i = 0; i < wild.points.size(); ++i) {
      wild.points[i] = {i % 2 == 0 ? 8.0F : -8.0F, 5.0F, -3.0F};
    }
    broken.points[3][1] = std::numeric_limits<float>::quiet_NaN();
    return Modes{wild, broken, ahead(s, std::numeric_limits<float>::quiet_NaN())};
  });
  fly(pilot, 3.0);
  EXPECT_LE(fastest_mps_, 3.0 * 1.05 + 1e-9);
}

TEST_F(PilotTest, HasNoMissionToNowhere) {
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), 1e9}) {
    mission_.goal_world_m[1] = bad;
    Pilot pilot(settings_, [](const Situation& s, const Image&) { return all(ahead(s, 0.1F)); });
    pilot.reset(mission_);
    EXPECT_FALSE(pilot.has_mission());
  }
}

/// A host from before the map's box and the latency were told.
TEST_F(PilotTest, FliesForOlderHosts) {
  mission_.struct_size = offsetof(ab_mission, lowest_world_m);
  mission_.command_latency_s = kNaN;
  std::vector<Situation> situations;
  Pilot pilot = begun([&](const Situation& situation, const Image&) {
    situations.push_back(situation);
    return all(ahead(situation, 0.1F));
  });
  fly(pilot, 2.0);
  EXPECT_GT(position_.x(), 1.0);
  EXPECT_EQ(net_inputs(situations.front())[19], 1.0F);
}

}  // namespace
}  // namespace agile
