#include <gtest/gtest.h>

#include "base/spec_json.hpp"
#include "scripted.hpp"

/// For each cause a world and a planner of which it, and only it, is true.
namespace avoidbench {
namespace {

using namespace scripted;  // NOLINT(google-build-using-namespace): the tests' own words
using Eigen::Vector3d;
using Eigen::Vector3f;

/// All facts, where a test fails.
std::string facts_text(const CauseFound& explanation) {
  return std::string(text(explanation.cause)) + " " + spec_to_json(explanation.facts).dump(1);
}

/// A wall across the way at y = 5.
World wall_world() {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh(Vector3f(16, 0.5F, 8)), {0, 5, 4}, "wall");
  return world;
}

Told into_the_wall(TrialSpec spec, double speed_mps) {
  act = [speed_mps](const ab_observation&) { return velocity(0, speed_mps, 0); };
  return fly_and_explain(spec, wall_world(), test::straight_mission());
}

TEST(Causes, TheTableHasARowForEach) {
  ASSERT_EQ(cause_table().size(), std::size(EnumText<Cause>::entries));
  for (std::size_t i = 0; i < cause_table().size(); ++i) {
    EXPECT_EQ(cause_table()[i].cause, EnumText<Cause>::entries[i].first);
    EXPECT_FALSE(cause_table()[i].doc.empty() || cause_table()[i].rule.empty());
  }
}

/// Of a rig that counts as sight what the planner looked through: here the camera looks back.
TEST(Causes, OutOfViewOfWhatThePlannerSees) {
  const auto rigged = [](TrialSpec spec) {
    spec.sensor.mounting.yaw_deg = 180.0;
    spec.sensor.lidars = {lidar_presets().front()};
    return into_the_wall(spec, 2.0).explanation;
  };
  const CauseFound by_camera = rigged(spec_of<Silent>());
  EXPECT_EQ(by_camera.cause, Cause::out_of_view) << facts_text(by_camera);
  EXPECT_TRUE(std::isnan(by_camera.facts.in_range_s));
  const CauseFound by_lidar = rigged(spec_of<Pointed>());
  EXPECT_EQ(by_lidar.cause, Cause::sensed_not_avoided) << facts_text(by_lidar);
  EXPECT_GT(by_lidar.facts.sensed_image_count, 3.0);
}

TEST(Causes, MovedInto) {
  World world = test::flight_world();
  // A long plate that sweeps over the path and cannot be passed.
  test::add_obstacle(world, test::box_mesh(Vector3f(0.5F, 30, 4)), {6, 0, 2}, "gate");
  world.motions.push_back(
      {.instance = 1, .path = Sway{.amplitude_world = {9, 0, 0}, .period_s = 16.0, .phase = 0.25}});
  act = [](const ab_observation&) { return velocity(0, 2, 0); };
  const Told told = fly_and_explain(spec_of<Silent>(), world, test::straight_mission());
  ASSERT_EQ(told.record.outcome, Outcome::collided) << told.record.reason;
  EXPECT_EQ(told.explanation.cause, Cause::moved_into) << facts_text(told.explanation);
  EXPECT_GT(told.explanation.facts.obstacle_way_m, 0.05);

  // Struck head on it stands in the way, moving or not.
  World ahead = test::flight_world();
  test::add_obstacle(ahead, test::box_mesh(Vector3f(16, 0.5F, 8)), {0, 5, 4}, "wall");
  ahead.motions.push_back(
      {.instance = 1, .path = Sway{.amplitude_world = {1, 0, 0}, .period_s = 4.0}});
  EXPECT_EQ(fly_and_explain(spec_of<Silent>(), ahead, test::straight_mission()).explanation.cause,
            Cause::sensed_not_avoided);
}

TEST(Causes, MovedIntoByAMover) {
  TrialSpec spec = spec_of<Silent>();
  spec.vehicle.max_speed_mps = 2.0;
  spec.movers.count = 1;
  spec.movers.motion = MoverMotion::cross;
  spec.movers.kind = MoverKind::ball;
  spec.movers.speed_mps = {0.8, 0.8};
  spec.rates.plan_hz = 0.5;  // the planner's last word is old
  act = [](const ab_observation&) { return velocity(0, 2, 0); };
  const Told told = fly_and_explain(spec, test::flight_world(), test::straight_mission());
  ASSERT_EQ(told.record.outcome, Outcome::collided) << told.record.reason;
  EXPECT_EQ(told.record.collisions.front().kind, "ball");
  EXPECT_EQ(told.explanation.cause, Cause::moved_into) << facts_text(told.explanation);
  EXPECT_GT(told.explanation.facts.obstacle_way_m, 0.2);
}

/// A gust from the side, and a path along x = 0 that passes a wall by `clearance_m`.
Told carried_off(double clearance_m) {
  World world = test::flight_world();
  const double half_body_m = 0.25, half_wall_m = 0.2;
  test::add_obstacle(world, test::box_mesh(Vector3f(0.4F, 10, 8)),
                     {half_body_m + clearance_m + half_wall_m, 5, 4}, "wall");
  TrialSpec spec = spec_of<Silent>();
  spec.wind.force_world_n = {2.0, 0.0, 0.0};
  static std::vector<ab_point> points;
  act = [](const ab_observation& seen) {
    points.clear();
    // By the clock, whatever the wind does.
    for (int i = 0; i < 60; ++i) {
      const double time_s = seen.state->time_s + 0.033 + 0.05 * i;
      ab_point point{};
      point.time_s = 0.05 * i;
      point.position_world_m[1] = -15.0 + 2.0 * time_s;
      point.position_world_m[2] = 2.0;
      point.velocity_world_mps[1] = 2.0;
      point.yaw_rad = 0.5 * math::kPi;
      points.push_back(point);
    }
    return make_trajectory_command(points);
  };
  return fly_and_explain(spec, world, test::straight_mission());
}

TEST(Causes, TrackingWhereAGustCarriesItOffAClearPath) {
  const Told told = carried_off(0.25);
  ASSERT_EQ(told.record.outcome, Outcome::collided) << told.record.reason;
  EXPECT_EQ(told.explanation.cause, Cause::tracking) << facts_text(told.explanation);
  EXPECT_NEAR(told.explanation.facts.commanded_clearance_m, 0.25, 0.05);
}

TEST(Causes, NotTrackingWhereThePathGrazesIt) {
  const Told told = carried_off(0.035);
  ASSERT_EQ(told.record.outcome, Outcome::collided) << told.record.reason;
  const Facts& facts = told.explanation.facts;
  EXPECT_GT(facts.commanded_clearance_m, 0.02);
  EXPECT_LT(facts.commanded_clearance_m, 0.05);
  EXPECT_GT(facts.tracking_error_m, facts.commanded_clearance_m);
  EXPECT_EQ(told.explanation.cause, Cause::sensed_not_avoided) << facts_text(told.explanation);
}

TEST(Causes, OutOfViewWhereItLooksElsewhere) {
  // Looks along x, flies along y.
  act = [](const ab_observation&) { return velocity(0, 2, 0, 0.0); };
  const Told told = fly_and_explain(spec_of<Silent>(), wall_world(), test::straight_mission());
  ASSERT_EQ(told.record.outcome, Outcome::collided);
  EXPECT_EQ(told.explanation.cause, Cause::out_of_view) << facts_text(told.explanation);
}

TEST(Causes, OccludedWhereAWallStandsBefore) {
  World world = test::flight_world();
  // Behind a wall of 3.4 m stands a box, into which the vehicle comes down from above.
  test::add_obstacle(world, test::box_mesh(Vector3f(30, 0.2F, 3.4F)), {0, 5, 1.7}, "wall");
  test::add_obstacle(world, test::box_mesh(Vector3f(3, 3, 1)), {0, 7.2, 0.5}, "box");
  Mission mission = test::straight_mission();
  mission.start_world.z() = 4.2;
  act = [](const ab_observation& seen) {
    return seen.state->position_world_m[1] < 5.6 ? velocity(0, 2, 0) : velocity(0, 0.3, -2);
  };
  const Told told = fly_and_explain(spec_of<Silent>(), world, mission);
  ASSERT_EQ(told.record.outcome, Outcome::collided);
  ASSERT_EQ(told.record.collisions.back().kind, "box") << told.record.reason;
  EXPECT_EQ(told.explanation.cause, Cause::occluded) << facts_text(told.explanation);
}

TEST(Causes, TooLateForSpeedWhereTheRangeIsShort) {
  TrialSpec spec = spec_of<Silent>();
  spec.sensor.max_range_m = 1.5;
  const Told told = into_the_wall(spec, 5.0);
  EXPECT_EQ(told.explanation.cause, Cause::too_late_for_speed) << facts_text(told.explanation);
  // v t + v²/2a at v = 5 m/s: 5 (1/30 + 0.033) + 25/12 = 2.415 m.
  EXPECT_NEAR(told.explanation.facts.last_chance_need_m, 2.415, 0.1);
  // The same range is enough for 1 m/s: 0.15 m.
  EXPECT_EQ(into_the_wall(spec, 1.0).explanation.cause, Cause::sensed_not_avoided);
}

TEST(Causes, BlindWhereNothingIsLookedAt) {
  const Told told = into_the_wall(spec_of<Blind>(), 2.0);
  EXPECT_EQ(told.explanation.cause, Cause::blind) << facts_text(told.explanation);
  EXPECT_EQ(told.explanation.facts.sight_input_count, 0.0);
  EXPECT_EQ(into_the_wall(spec_of<Silent>(), 2.0).explanation.facts.sight_input_count, 1.0);
  EXPECT_TRUE(std::isnan(told.explanation.facts.sensed_s));
  EXPECT_GT(told.explanation.facts.in_range_s, 0.0);
}

TEST(Causes, NotSensedWhereOnlyWhatStandsBehindHasItsDepth) {
  // A wire that no pixel meets, 0.5 m before a wall: from 5 m on images have it "at its depth".
  World world = wall_world();
  test::add_obstacle(world, test::box_mesh(Vector3f(1e-4F, 1e-4F, 8)), {0.013, 4.2, 4}, "wire");
  act = [](const ab_observation&) { return velocity(0, 2, 0); };
  Told told = fly_and_explain(spec_of<Silent>(), world, test::straight_mission());
  ASSERT_EQ(told.record.collisions.back().kind, "wire") << told.record.reason;
  EXPECT_GT(told.explanation.facts.sensed_image_count, 50.0);
  EXPECT_LT(told.explanation.facts.sensed_s, told.explanation.facts.last_chance_s);
  EXPECT_LT(told.explanation.facts.sensed_lately_count, 3.0);
  EXPECT_EQ(told.explanation.cause, Cause::not_sensed) << facts_text(told.explanation);
  // What a planner says it knows counts more.
  knows = [](const Vec3&) { return AB_PLACE_OCCUPIED; };
  told = fly_and_explain(spec_of<Telling>(), world, test::straight_mission());
  EXPECT_EQ(told.explanation.cause, Cause::mapped_not_avoided) << facts_text(told.explanation);
}

TEST(Causes, WhatThePlannerSaysItKnowsDecides) {
  knows = [](const Vec3&) { return AB_PLACE_FREE; };
  Told told = into_the_wall(spec_of<Telling>(), 2.0);
  EXPECT_EQ(told.explanation.cause, Cause::sensed_not_mapped) << facts_text(told.explanation);
  EXPECT_EQ(told.explanation.facts.mapped_share, 0.0);
  knows = [](const Vec3& place) { return place[1] > 4.6 ? AB_PLACE_OCCUPIED : AB_PLACE_FREE; };
  told = into_the_wall(spec_of<Telling>(), 2.0);
  EXPECT_EQ(told.explanation.cause, Cause::mapped_not_avoided) << facts_text(told.explanation);
  EXPECT_EQ(told.explanation.facts.mapped_share, 1.0);
  told = into_the_wall(spec_of<Silent>(), 2.0);
  EXPECT_EQ(told.explanation.cause, Cause::sensed_not_avoided) << facts_text(told.explanation);
}

TEST(Causes, NoPlanFoundWhereThePlannerHasNoneMostly) {
  act = [](const ab_observation& seen) -> std::optional<ab_command> {
    if (seen.state->position_world_m[1] < 3.0) return velocity(0, 2, 0);
    // Every third call, so that it creeps on.
    const auto call = static_cast<int>(std::lround(seen.state->time_s * 30.0));
    return call % 3 == 0 ? velocity(0, 2, 0) : std::nullopt;
  };
  TrialSpec spec = spec_of<Silent>();
  spec.mission.time_limit_s = 60.0;
  const Told told = fly_and_explain(spec, wall_world(), test::straight_mission());
  ASSERT_EQ(told.record.outcome, Outcome::collided) << told.record.reason;
  EXPECT_EQ(told.explanation.cause, Cause::no_plan_found) << facts_text(told.explanation);
}

Told without_end(const World& world, double reference_length_m) {
  TrialSpec spec = spec_of<Silent>();
  spec.mission.time_limit_s = 10.0;
  const Told told = fly_and_explain(spec, world, test::straight_mission(), reference_length_m);
  EXPECT_EQ(told.record.outcome, Outcome::timed_out) << told.record.reason;
  return told;
}

TEST(Causes, TimeOuts) {
  const auto hover = [](const ab_observation&) { return velocity(0, 0, 0); };
  act = hover;
  Told told = without_end(test::flight_world(), 30.0);
  EXPECT_EQ(told.explanation.cause, Cause::commanded_hover) << facts_text(told.explanation);

  act = [](const ab_observation& seen) -> std::optional<ab_command> {
    if (seen.state->time_s > 6.0) return std::nullopt;
    return velocity(0, 0, 0);
  };
  told = without_end(test::flight_world(), 30.0);
  EXPECT_EQ(told.explanation.cause, Cause::hover_without_plan) << facts_text(told.explanation);
  act = hover;

  World full = test::flight_world();
  // Poles where the goal is, too near to each other for the body.
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      test::add_obstacle(full, test::cylinder_mesh(0.05, 6.0, 12), {0.35 * x, 15 + 0.35 * y, 0},
                         "pole");
    }
  }
  told = without_end(full, 30.0);
  EXPECT_EQ(told.explanation.cause, Cause::blocked_goal) << facts_text(told.explanation);
  // Between four poles, not where one stands, in the goal's middle.
  EXPECT_GT(told.explanation.facts.goal_clearance_m, 0.13);
  EXPECT_LT(told.explanation.facts.goal_clearance_m, 0.35 / std::sqrt(2.0) - 0.05);

  act = [](const ab_observation& seen) {
    return velocity(std::fmod(seen.state->time_s, 4.0) < 2.0 ? 2.0 : -2.0, 0, 0);
  };
  told = without_end(test::flight_world(), 30.0);
  EXPECT_EQ(told.explanation.cause, Cause::trap) << facts_text(told.explanation);

  act = [](const ab_observation&) { return velocity(0, 1.0, 0); };
  told = without_end(test::flight_world(), 30.0);
  // Ever nearer to the goal: nearest at the end, and half a metre before that.
  EXPECT_EQ(told.explanation.facts.closest_s, told.record.samples.back().time_s);
  EXPECT_NEAR(told.explanation.facts.progress_s, 9.5, 0.05);
  EXPECT_EQ(told.explanation.cause, Cause::slow) << facts_text(told.explanation);
  EXPECT_NEAR(told.explanation.facts.flown_m, 9.8, 0.3);

  // Aside and ahead: longer than the shortest way by then.
  act = [](const ab_observation&) { return velocity(1.5, 1.0, 0); };
  told = without_end(test::flight_world(), 12.0);
  EXPECT_EQ(told.explanation.cause, Cause::detour) << facts_text(told.explanation);
}

TEST(Causes, OfFlightsThatEndOtherwise) {
  act = [](const ab_observation&) { return velocity(0, 0, 3); };
  Told told = fly_and_explain(spec_of<Silent>(), test::flight_world(), test::straight_mission());
  ASSERT_EQ(told.record.outcome, Outcome::left_bounds);
  EXPECT_EQ(told.explanation.cause, Cause::flew_out) << facts_text(told.explanation);

  act = [](const ab_observation&) -> std::optional<ab_command> { give_up("no way"); };
  told = fly_and_explain(spec_of<Silent>(), test::flight_world(), test::straight_mission());
  EXPECT_EQ(told.explanation.cause, Cause::gave_up);

  act = [](const ab_observation&) -> std::optional<ab_command> { throw std::runtime_error("?"); };
  told = fly_and_explain(spec_of<Silent>(), test::flight_world(), test::straight_mission());
  EXPECT_EQ(told.explanation.cause, Cause::planner_failed);
}

}  // namespace
}  // namespace avoidbench
