#include "optimizer.hpp"

#include <gtest/gtest.h>

#include "anchors.hpp"
#include "local_planner.hpp"
#include "seen_course.hpp"

namespace ego {
namespace {

using avoidbench::kinematic::Course;
using Eigen::Index;
using Eigen::Vector3d;
using planning::Bspline;
using planning::Motion;

const Vector3d kEye(0.0, 0.0, 2.0);

Motion rest(double x, double y) {
  return {Vector3d(x, y, 2.0), Vector3d::Zero(), Vector3d::Zero()};
}

/// One thick tree ahead, a little to the left of the way.
Course tree() {
  Course course;
  course.cylinders.push_back({{-0.1, 3.5}, 0.4});
  return course;
}

Bspline straight_curve(const Settings& settings) {
  const InitialCurve line = polynomial_curve(settings, rest(0, 0), rest(0, 7));
  return fitted(line.way_points, line.interval_s, rest(0, 0), rest(0, 7));
}

TEST(Anchors, OfATreePointOutOfItAndLieOnItsSurface) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  const Bspline curve = straight_curve(settings);
  const std::vector<Segment> segments = blocked_segments(surroundings, curve.points);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_FALSE(surroundings.is_blocked(curve.points.col(segments[0].in)));
  EXPECT_FALSE(surroundings.is_blocked(curve.points.col(segments[0].out)));
  Anchors anchors(static_cast<std::size_t>(curve.points.cols()));
  ASSERT_TRUE(anchor_segment(surroundings, curve.points, segments[0], anchors));
  int count = 0;
  for (Index i = 0; i < curve.points.cols(); ++i) {
    for (const Anchor& anchor : anchors[static_cast<std::size_t>(i)]) {
      ++count;
      EXPECT_GT(i, segments[0].in);
      EXPECT_LT(i, segments[0].out);
      EXPECT_NEAR(anchor.direction.norm(), 1.0, 1e-9);
      // Free there, blocked a cell before.
      EXPECT_FALSE(surroundings.is_blocked(anchor.point));
      EXPECT_NEAR(anchor.direction.x(), 1.0, 0.35) << "the shorter way around is the right one";
    }
  }
  EXPECT_GE(count, 2);
}

TEST(Anchors, KnowWhatTheyPushOutOf) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  const Bspline curve = straight_curve(settings);
  const Segment segment = blocked_segments(surroundings, curve.points).front();
  Anchors anchors(static_cast<std::size_t>(curve.points.cols()));
  EXPECT_TRUE(is_new(surroundings, curve.points, segment, anchors));
  ASSERT_TRUE(anchor_segment(surroundings, curve.points, segment, anchors));
  EXPECT_FALSE(is_new(surroundings, curve.points, segment, anchors));
}

TEST(Rebound, PushesACurveOutOfATreeAndKeepsItsEnds) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  const Bspline before = straight_curve(settings);
  ASSERT_TRUE(first_blocked_s(surroundings, settings, before));
  const auto after = rebounded(surroundings, settings, before);
  ASSERT_TRUE(after);
  EXPECT_FALSE(first_blocked_s(surroundings, settings, *after));
  EXPECT_EQ(after->points.leftCols(3), before.points.leftCols(3));
  EXPECT_EQ(after->points.rightCols(3), before.points.rightCols(3));
  for (int i = 0; i <= 100; ++i) {  // inflation and half a cell
    const Vector3d place = position_at(*after, after->duration_s() * i / 100);
    EXPECT_GT((place.head<2>() - Eigen::Vector2d(-0.1, 3.5)).norm(), 0.4 + 0.3);
  }
}

TEST(Rebound, LeavesAFreeCurveSmoothOnly) {
  const Settings settings;
  Surroundings surroundings = seen({}, kEye);
  const Bspline before = straight_curve(settings);
  const auto after = rebounded(surroundings, settings, before);
  ASSERT_TRUE(after);
  for (int i = 0; i <= 50; ++i) {
    const Vector3d place = position_at(*after, after->duration_s() * i / 50);
    EXPECT_NEAR(place.x(), 0.0, 1e-6);
    EXPECT_NEAR(place.z(), 2.0, 1e-6);
  }
}

TEST(Rebound, GivesUpBeforeAWallWithoutAWayAround) {
  const Settings settings;
  Course course;
  for (int i = -40; i <= 40; ++i) course.cylinders.push_back({{0.2 * i, 3.5}, 0.2});
  Surroundings surroundings = seen(course, kEye);
  EXPECT_FALSE(rebounded(surroundings, settings, straight_curve(settings)));
}

/// Greatest speed and acceleration along it.
std::pair<double, double> demands(const Bspline& curve) {
  double speed = 0.0, pull = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double time_s = curve.duration_s() * i / 400;
    speed = std::max(speed, velocity_at(curve, time_s).norm());
    pull = std::max(pull, acceleration_at(curve, time_s).norm());
  }
  return {speed, pull};
}

TEST(PlanTrajectory, KeepsTheLimitsAroundATree) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  Request request;
  request.start = {Vector3d(0, 0, 2), Vector3d(0, 2.5, 0), Vector3d::Zero()};
  request.target = rest(0, 7);
  planning::Random random(1);
  const auto curve = plan_trajectory(surroundings, settings, request, random);
  ASSERT_TRUE(curve);
  const auto [speed, pull] = demands(*curve);
  EXPECT_LE(speed, 1.1 * settings.max_speed_mps);
  EXPECT_LE(pull, settings.vehicle_acceleration_mps2);
  EXPECT_TRUE(position_at(*curve, 0.0).isApprox(request.start.position, 1e-9));
  EXPECT_TRUE(velocity_at(*curve, 0.0).isApprox(request.start.velocity, 1e-9));
  EXPECT_NEAR(velocity_at(*curve, curve->duration_s()).norm(), 0.0, 1e-9);
}

TEST(PlanTrajectory, GoesOnWithThePreviousOne) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  Request request;
  request.start = rest(0, 0);
  request.target = rest(0, 7);
  planning::Random random(1);
  const auto first = plan_trajectory(surroundings, settings, request, random);
  ASSERT_TRUE(first);
  request.previous = &*first;
  request.previous_s = 0.6;
  request.start = {position_at(*first, 0.6), velocity_at(*first, 0.6),
                   acceleration_at(*first, 0.6)};
  const auto second = plan_trajectory(surroundings, settings, request, random);
  ASSERT_TRUE(second);
  // On the same side of the tree.
  for (const Bspline* curve : {&*first, &*second}) {
    double beside = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const Vector3d place = position_at(*curve, curve->duration_s() * i / 100);
      if (std::abs(place.y() - 3.5) < 0.1) beside = place.x();
    }
    EXPECT_GT(beside, 0.5);
  }
}

TEST(Slowed, IsSlowerOnTheSameWayWithTheSameEnds) {
  const Settings settings;
  const Motion start{Vector3d(0, 0, 2), Vector3d(1, 2, 0), Vector3d(0.5, 0, 0)};
  const InitialCurve initial = polynomial_curve(settings, start, rest(2, 7));
  const Bspline curve = fitted(initial.way_points, initial.interval_s, start, rest(2, 7));
  const Bspline slow = slowed(curve, 1.5, start, rest(2, 7));
  EXPECT_LT(demands(slow).first, demands(curve).first / 1.3);
  EXPECT_GT(slow.duration_s(), 1.3 * curve.duration_s());
  EXPECT_TRUE(velocity_at(slow, 0.0).isApprox(start.velocity, 1e-9));
  EXPECT_TRUE(acceleration_at(slow, 0.0).isApprox(start.acceleration, 1e-9));
  for (int i = 0; i <= 50; ++i) {  // each place is near one of the other's
    const Vector3d place = position_at(slow, slow.duration_s() * i / 50);
    double nearest = 1e9;
    for (int k = 0; k <= 500; ++k) {
      nearest =
          std::min(nearest, (position_at(curve, curve.duration_s() * k / 500) - place).norm());
    }
    EXPECT_LT(nearest, 0.1);
  }
}

TEST(LocalTarget, IsAHorizonAwayOnTheLineAndFree) {
  const Settings settings;
  Surroundings surroundings = seen({}, kEye);
  const Vector3d start(0, 0, 2), goal(0, 30, 2);
  const Motion ahead = local_target(surroundings, settings, start, goal, Vector3d(2, 5, 2));
  EXPECT_NEAR((ahead.position - Vector3d(2, 5, 2)).norm(), settings.horizon_m, 1e-9);
  EXPECT_NEAR(ahead.position.x(), 0.0, 1e-9);
  EXPECT_NEAR(ahead.velocity.y(), settings.max_speed_mps, 1e-9);
  const Motion last = local_target(surroundings, settings, start, goal, Vector3d(0, 25, 2));
  EXPECT_EQ(last.position, goal);
  EXPECT_EQ(last.velocity.norm(), 0.0);
  Course course;
  course.cylinders.push_back({{0.0, 7.0}, 0.4});
  Surroundings with_tree = seen(course, kEye);
  const Motion beside = local_target(with_tree, settings, start, goal, Vector3d(0, -0.5, 2));
  EXPECT_FALSE(with_tree.is_blocked(beside.position));
}

TEST(LocalTarget, IsBesideAGoalThatSeemsBlocked) {
  const Settings settings;
  Surroundings surroundings = seen(tree(), kEye);
  const Vector3d start(0, 0, 2), goal(-0.1, 3.5 - 0.4 - 0.3, 2.0);
  ASSERT_TRUE(surroundings.is_blocked(goal));
  const Motion target = local_target(surroundings, settings, start, goal, start);
  EXPECT_FALSE(surroundings.is_blocked(target.position));
  EXPECT_LT((target.position - goal).norm(), 0.5);
  EXPECT_EQ(target.velocity.norm(), 0.0);
}

TEST(FirstBlocked, LetsACurveLeaveWhereItIsBlocked) {
  Surroundings surroundings = seen(tree(), kEye);
  const Vector3d near(-0.1, 3.5 - 0.4 - 0.3, 2.0);
  ASSERT_TRUE(surroundings.is_blocked(near));
  const auto back = [&](double t) { return Vector3d(near - Vector3d(0, t, 0)); };
  const auto on = [&](double t) { return Vector3d(near + Vector3d(0, t, 0)); };
  EXPECT_FALSE(first_blocked_s(surroundings, back, 0.0, 2.0, 0.02));
  const auto hit = first_blocked_s(surroundings, on, 0.0, 2.0, 0.02);
  ASSERT_TRUE(hit);
  EXPECT_LT(*hit, 0.4);
  const auto place = nearest_free(surroundings, near, 1.0, Reach::straight);
  ASSERT_TRUE(place);
  EXPECT_FALSE(surroundings.is_blocked(*place));
  EXPECT_LT((*place - near).norm(), 0.5);
}

}  // namespace
}  // namespace ego
