#include <gtest/gtest.h>

#include <cmath>

#include "plugin/planner_instance.hpp"
#include "support/flight_worlds.hpp"
#include "trial/flight.hpp"
#include "trial/flown_world.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// What a flight north at a constant speed saw, and its record.
struct FlownNorth {
  TrialRecord record;
  std::vector<std::vector<TrackView>> tracks;  ///< one list a call
  std::vector<double> times_s;
};

FlownNorth flown_among(const TrialSpec& spec, const Scene& scene, double speed_mps,
                       std::uint32_t needs = AB_INPUT_STATE, const FlightChange& change = {}) {
  FlownNorth flown;
  const Mission mission = test::straight_mission();
  Flight flight = begin_flight(spec, scene, mission, needs, nullptr, change);
  while (const PlannerView* view = next_plan(flight)) {
    flown.tracks.push_back(view->tracks);
    flown.times_s.push_back(view->call_time_s);
    PlanResult result;
    result.status = PlanStatus::command;
    result.command.kind = AB_COMMAND_VELOCITY;
    result.command.velocity_world_mps[1] = speed_mps;
    result.command.yaw_rad = mission.start_yaw_rad;
    answer(flight, result);
  }
  flown.record = end_flight(std::move(flight));
  return flown;
}

TrialSpec spec_with(MoverMotion motion, std::int64_t count) {
  TrialSpec spec;
  spec.movers.count = count;
  spec.movers.kind = MoverKind::ball;
  spec.movers.motion = motion;
  spec.mission.time_limit_s = 20.0;
  return spec;
}

void expect_same_flight(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].position_world, b.samples[i].position_world);
    EXPECT_EQ(a.samples[i].clearance_m, b.samples[i].clearance_m);
  }
}

/// Whom a vehicle meets that flies as fast as the movers were timed for.
TEST(FlightAmongMovers, TheVehicleMeetsWhoCrosses) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec = spec_with(MoverMotion::cross, 1);
  spec.vehicle.max_speed_mps = 3.0;
  const FlownNorth flown = flown_among(spec, scene, 3.0);
  ASSERT_EQ(flown.record.outcome, Outcome::collided) << flown.record.reason;
  const Collision& contact = flown.record.collisions.front();
  EXPECT_EQ(contact.kind, "ball");
  EXPECT_EQ(contact.obstacle, 1) << "after the map's own";
  // Its ball touches the body then, and the others' clearances lead there.
  const World world = *world_with_movers(spec, scene, test::straight_mission());
  const World still = standing_at(world, contact.time_s);
  const Scene frozen(still);
  const Sample& last = flown.record.samples.back();
  EXPECT_EQ(frozen.nearest(last.position_world).instance, 1U);
  EXPECT_LT(last.clearance_m, 1e-6);
}

TEST(FlightAmongMovers, IsAPureFunctionWhateverSceneItIsGiven) {
  const World map = test::flight_world();
  const Scene scene(map), other(map, 0);
  TrialSpec spec = spec_with(MoverMotion::mixed, 30);
  spec.movers.kind = MoverKind::mixed;
  spec.mission.max_collisions = 100;
  const FlownNorth flown = flown_among(spec, scene, 2.0);
  expect_same_flight(flown.record, flown_among(spec, scene, 2.0).record);
  expect_same_flight(flown.record, flown_among(spec, other, 2.0).record);
  // Clearances are those of the world as it is at each moment.
  const World world = *world_with_movers(spec, scene, test::straight_mission());
  int near = 0;
  for (std::size_t i = 0; i < flown.record.samples.size(); i += 11) {
    const Sample& sample = flown.record.samples[i];
    const World still = standing_at(world, sample.time_s);
    const double expected_m = Scene(still, 0).body_clearance(
        to_eigen(spec.vehicle.body_size_m), make_pose(sample.position_world, sample.q_world_body),
        kClearanceLimit_m);
    EXPECT_NEAR(sample.clearance_m, std::min(expected_m, kClearanceLimit_m), 1e-9);
    if (expected_m < 1.0) ++near;
  }
  EXPECT_GT(near, 3);
}

TEST(FlightAmongMovers, EveryMissionHasItsOwn) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec = spec_with(MoverMotion::walk, 5);
  const World first = *world_with_movers(spec, scene, test::straight_mission());
  spec.mission_index = 1;
  const World second = *world_with_movers(spec, scene, test::straight_mission());
  EXPECT_NE(world_digest(first), world_digest(second));
  spec.movers = {};
  EXPECT_FALSE(world_with_movers(spec, scene, test::straight_mission()));
  EXPECT_EQ(movers_key(spec), "");
}

/// A mission that returns ends where it starts: there is no line to cross but that of its legs.
TEST(FlightAmongMovers, TheyCrossTheFirstLeg) {
  const World map = test::flight_world();
  const Scene scene(map);
  const Mission there = test::straight_mission();
  Mission and_back = there;
  and_back.waypoints_world = {there.goal_world};
  and_back.goal_world = there.start_world;
  for (const MoverMotion motion : {MoverMotion::cross, MoverMotion::chase}) {
    const TrialSpec spec = spec_with(motion, 5);
    EXPECT_EQ(world_digest(*world_with_movers(spec, scene, and_back)),
              world_digest(*world_with_movers(spec, scene, there)));
  }
}

TEST(FlightAmongMovers, TheyStandWhereAChangeWantsIt) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec = spec_with(MoverMotion::cross, 1);
  spec.vehicle.max_speed_mps = 3.0;
  EXPECT_EQ(flown_among(spec, scene, 3.0, AB_INPUT_STATE, {.still_at_s = 0.0}).record.outcome,
            Outcome::reached_goal)
      << "as the flight begins it is beside the way";
}

TEST(FlightAmongMovers, TracksAreWhereTheyAre) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec = spec_with(MoverMotion::walk, 40);
  spec.mission.max_collisions = 100;
  const FlownNorth flown = flown_among(spec, scene, 2.0, AB_INPUT_STATE | AB_INPUT_TRACKS);
  const World world = *world_with_movers(spec, scene, test::straight_mission());
  std::size_t seen = 0;
  for (std::size_t call = 0; call < flown.tracks.size(); call += 29) {
    for (const TrackView& track : flown.tracks[call]) {
      EXPECT_LE(track.time_s, flown.times_s[call]);
      EXPECT_GT(track.time_s, flown.times_s[call] - 0.051);
      EXPECT_EQ(track.kind, AB_TRACK_BALL);
      double nearest_m = 1e9;
      for (const Motion& motion : world.motions) {
        const Vector3d rest =
            world.instances[motion.instance].T_world_prototype.translation().cast<double>();
        nearest_m =
            std::min(nearest_m,
                     (rest + displacement_world(motion, track.time_s) - track.center_world).norm());
      }
      EXPECT_LT(nearest_m, 1e-3);
      ++seen;
    }
  }
  EXPECT_GT(seen, 50U);
}

TEST(FlightAmongMovers, ToSeeTracksChangesNothing) {
  const World map = test::flight_world();
  const Scene scene(map);
  TrialSpec spec = spec_with(MoverMotion::walk, 20);
  spec.tracks.rate_hz = 7.5;
  spec.tracks.false_count = 3.0;
  const FlownNorth with = flown_among(spec, scene, 2.0, AB_INPUT_STATE | AB_INPUT_TRACKS);
  const FlownNorth without = flown_among(spec, scene, 2.0);
  expect_same_flight(with.record, without.record);
  EXPECT_TRUE(without.tracks.back().empty());
  EXPECT_FALSE(with.tracks.back().empty());
}

}  // namespace
}  // namespace avoidbench
