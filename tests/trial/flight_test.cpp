#include "trial/flight.hpp"

#include <gtest/gtest.h>

#include "support/flight_worlds.hpp"
#include "trial/preset_flight.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// Ahead at 2 m/s, swinging from side to side.
PlanResult swinging(const PlannerView& view) {
  PlanResult result;
  result.status = PlanStatus::command;
  result.command.kind = AB_COMMAND_VELOCITY;
  const Vector3d velocity(math::sin(view.time_s), 2.0, 0.0);
  for (int i = 0; i < 3; ++i) result.command.velocity_world_mps[i] = velocity[i];
  result.command.yaw_rad = 0.5 * math::kPi;
  return result;
}

void expect_same(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.end_time_s, b.end_time_s);
  EXPECT_EQ(a.plan_calls.size(), b.plan_calls.size());
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    ASSERT_EQ(a.samples[i].position_world, b.samples[i].position_world) << i;
    ASSERT_EQ(a.samples[i].q_world_body.coeffs(), b.samples[i].q_world_body.coeffs()) << i;
    ASSERT_EQ(a.samples[i].clearance_m, b.samples[i].clearance_m) << i;
  }
}

/// What a flight over the bare floor is begun with.
struct EmptyWorld {
  World world = test::flight_world();
  Scene scene{world};
  TrialSpec spec;
  Mission mission = test::straight_mission();

  Flight begin() const { return begin_flight(spec, scene, mission, 0); }
};

/// A world in which a post swings across the way.
World swinging_world() {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({0.5, 0.5, 8}), {0, 0, 2}, "post");
  world.motions = {
      {.instance = 1, .path = Sway{.amplitude_world = {6, 0, 0}, .period_s = 11.0, .phase = 0.0}}};
  return world;
}

TEST(Flight, APlannerSteppedByHandFliesThatOfRunTrial) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({2, 1, 8}), {0, 0, 2}, "wall");
  const Scene scene(world);
  const TrialSpec spec = spec_of("reactive");
  const Mission mission = test::straight_mission();
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  const TrialRecord whole = run_trial(spec, scene, mission, planner);
  ASSERT_TRUE(planner.reset(planner_mission(spec, mission, scene.world().bounds)).empty());
  Flight flight = begin_flight(spec, scene, mission, planner.needs());
  while (const PlannerView* view = next_plan(flight)) answer(flight, planner.plan(*view));
  expect_same(end_flight(std::move(flight)), whole);
}

TEST(Flight, FlightsInTurnDoNotDisturbEachOther) {
  const World world = swinging_world();
  const Scene scene(world);
  TrialSpec spec;
  spec.wind.mean_world_mps = {0.5, 0.0, 0.0};
  const Mission mission = test::straight_mission();
  const auto alone = [&] {
    Flight flight = begin_flight(spec, scene, mission, AB_INPUT_DEPTH);
    while (const PlannerView* view = next_plan(flight)) answer(flight, swinging(*view));
    return end_flight(std::move(flight));
  };
  const TrialRecord expected = alone();
  std::vector<Flight> flights;
  for (int i = 0; i < 3; ++i) {
    flights.push_back(begin_flight(spec, scene, mission, AB_INPUT_DEPTH));
    // The later ones lag behind, so that their obstacles stand elsewhere.
    for (int k = 0; k < 10 * (3 - i); ++k) {
      const PlannerView* view = next_plan(flights.back());
      ASSERT_NE(view, nullptr);
      answer(flights.back(), swinging(*view));
    }
  }
  for (bool any = true; any;) {
    any = false;
    for (Flight& flight : flights) {
      if (flight.outcome) continue;
      if (const PlannerView* view = next_plan(flight)) {
        answer(flight, swinging(*view));
        any = true;
      }
    }
  }
  for (Flight& flight : flights) expect_same(end_flight(std::move(flight)), expected);
}

TEST(Flight, IsStoppedWhereItIs) {
  const EmptyWorld empty;
  Flight flight = empty.begin();
  for (int i = 0; i < 4; ++i) answer(flight, swinging(*next_plan(flight)));
  ASSERT_NE(next_plan(flight), nullptr);
  stop_flight(flight, Outcome::planner_gave_up, "enough");
  EXPECT_EQ(next_plan(flight), nullptr);
  EXPECT_EQ(next_plan(flight), nullptr);
  const TrialRecord record = end_flight(std::move(flight));
  EXPECT_EQ(record.outcome, Outcome::planner_gave_up);
  EXPECT_EQ(record.reason, "enough");
  EXPECT_DOUBLE_EQ(record.end_time_s, 4.0 / 30.0);
  EXPECT_EQ(record.plan_calls.size(), 4U);
}

TEST(Flight, EndsAtOnceWhereTheStartIsTheGoal) {
  EmptyWorld empty;
  empty.mission.goal_world = empty.mission.start_world;
  Flight flight = empty.begin();
  EXPECT_EQ(next_plan(flight), nullptr);
  EXPECT_EQ(end_flight(std::move(flight)).outcome, Outcome::reached_goal);
}

TEST(FlightDeathTest, EachPlanIsAnsweredOnce) {
  const EmptyWorld empty;
  Flight flight = empty.begin();
  EXPECT_DEATH(answer(flight, {}), "is_asked");
  const PlanResult result = swinging(*next_plan(flight));
  EXPECT_DEATH(next_plan(flight), "is_answered");
  EXPECT_DEATH(end_flight(std::move(flight)), "outcome");
  answer(flight, result);
  EXPECT_DEATH(answer(flight, result), "is_answered");
}

}  // namespace
}  // namespace avoidbench
