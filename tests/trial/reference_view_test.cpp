#include <gtest/gtest.h>

#include <optional>

#include "support/flight_worlds.hpp"
#include "trial/flight.hpp"

namespace avoidbench {
namespace {

/// Flies two seconds by these commands, one a call, and keeps what each call saw.
struct Flown {
  std::vector<std::optional<ReferenceView>> references;
  std::vector<double> times_s;
  TrialRecord record;
};
template <class Command>
Flown flown(std::uint32_t needs, Command command_at) {
  const World world = test::flight_world();
  const Scene scene(world);
  const Mission mission = test::straight_mission();
  TrialSpec spec;
  spec.mission.time_limit_s = 2.0;
  Flight flight = begin_flight(spec, scene, mission, needs);
  Flown all;
  while (const PlannerView* view = next_plan(flight)) {
    all.references.push_back(view->reference);
    all.times_s.push_back(view->call_time_s);
    PlanResult result;
    result.status = PlanStatus::command;
    result.command = command_at(view->call_time_s);
    answer(flight, result);
  }
  all.record = end_flight(std::move(flight));
  return all;
}

ab_command velocity(double time_s) {
  ab_command command{};
  command.kind = AB_COMMAND_VELOCITY;
  command.velocity_world_mps[1] = time_s < 1.0 ? 3.0 : -1.0;
  command.yaw_rad = 0.4;
  return command;
}

/// What planners are shown is what samples call the reference, which is of the step before.
TEST(ReferenceViewOfFlights, IsThatOfTheSamples) {
  const Flown flight = flown(AB_INPUT_STATE | AB_INPUT_REFERENCE, velocity);
  ASSERT_GT(flight.times_s.size(), 50U);
  int compared = 0;
  for (std::size_t i = 1; i < flight.times_s.size(); ++i) {
    ASSERT_TRUE(flight.references[i].has_value());
    for (const Sample& sample : flight.record.samples) {
      if (sample.time_s != flight.times_s[i]) continue;
      const double step_m = 0.001 * (flight.references[i]->velocity_world.norm() + 0.05);
      EXPECT_LE((sample.reference_world - flight.references[i]->position_world).norm(), step_m);
      ++compared;
    }
  }
  EXPECT_GT(compared, 10);
  const ReferenceView& first = *flight.references.front();
  EXPECT_EQ(first.velocity_world, Eigen::Vector3d::Zero());
  const ReferenceView& late = *flight.references[28];
  EXPECT_GT(late.velocity_world.y(), 2.0);
  EXPECT_GT(late.yaw_rad, 0.1);
}

/// Looking at it changes no flight.
TEST(ReferenceViewOfFlights, ChangesNothing) {
  const Flown with = flown(AB_INPUT_STATE | AB_INPUT_REFERENCE, velocity);
  const Flown without = flown(AB_INPUT_STATE, velocity);
  EXPECT_FALSE(without.references.back().has_value());
  ASSERT_EQ(with.record.samples.size(), without.record.samples.size());
  for (std::size_t i = 0; i < with.record.samples.size(); ++i) {
    EXPECT_EQ(with.record.samples[i].position_world, without.record.samples[i].position_world);
    EXPECT_EQ(with.record.samples[i].reference_world, without.record.samples[i].reference_world);
  }
}

TEST(ReferenceViewOfFlights, IsNoneWhileRatesAreCommanded) {
  const Flown flight = flown(AB_INPUT_STATE | AB_INPUT_REFERENCE, [](double) {
    ab_command command{};
    command.kind = AB_COMMAND_RATES;
    command.thrust_mps2 = 9.81;
    return command;
  });
  EXPECT_TRUE(flight.references.front().has_value());
  EXPECT_FALSE(flight.references.back().has_value());
}

}  // namespace
}  // namespace avoidbench
