#include "control/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/pose.hpp"
#include "support/flights.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

double tilt(const VehicleState& state) {
  return std::acos(std::min(1.0, (state.q_world_body * Vector3d::UnitZ()).z()));
}

TEST(Tracking, PositionStepsNeitherOverspeedNorOvershoot) {
  for (const VehicleSpec& spec : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    for (const double distance : {0.5, 2.0, 10.0, 40.0}) {
      double furthest = 0, fastest = 0, steepest = 0;
      const VehicleState end = fly(model, hovering_at(spec, {0, 0, 2}, 0), go_to({distance, 0, 2}),
                                   14, [&](const Tracker&, const VehicleState& s) {
                                     furthest = std::max(furthest, s.position_world.x());
                                     fastest = std::max(fastest, s.velocity_world.norm());
                                     steepest = std::max(steepest, tilt(s));
                                   });
      EXPECT_LT(furthest, 1.02 * distance) << spec.name;
      EXPECT_LT(fastest, 1.01 * spec.max_speed_mps) << spec.name;
      EXPECT_LT(steepest, spec.max_tilt_rad) << spec.name;
      EXPECT_LT((end.position_world - Vector3d(distance, 0, 2)).norm(), 1e-3) << spec.name;
    }
  }
}

TEST(Tracking, TenMetreStepIsQuick) {
  const VehicleModel model = make_model(hummingbird_spec());
  double settled_s = 0;
  fly(model, hovering_at(model.spec, {0, 0, 2}, 0), go_to({10, 0, 2}), 8,
      [&](const Tracker&, const VehicleState& s) {
        if (std::abs(s.position_world.x() - 10) > 0.2) settled_s = seconds(s.tick);
      });
  // Bang-bang at 6 m/s² takes 2.58 s.
  EXPECT_LT(settled_s, 3.2);
}

TEST(Tracking, RestsStillAtItsGoal) {
  const VehicleModel model = make_model(hummingbird_spec());
  double fastest = 0, turning = 0;
  fly(model, hovering_at(model.spec, {0, 0, 2}, 0), go_to({3, 1, 2.5}, 1.0), 20,
      [&](const Tracker&, const VehicleState& s) {
        if (seconds(s.tick) < 15) return;
        fastest = std::max(fastest, s.velocity_world.norm());
        turning = std::max(turning, s.rates_body.norm());
      });
  EXPECT_LT(fastest, 1e-9);
  EXPECT_LT(turning, 1e-9);
}

TEST(Tracking, VelocitiesAreReachedWithoutOvershoot) {
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    for (const double speed : {0.5, 2.0, 5.0, 8.0}) {
      double fastest = 0;
      const VehicleState end =
          fly(model, hovering_at(spec, {0, 0, 2}, 0), fly_at({0, speed, 0}, 0.5), 8,
              [&](const Tracker&, const VehicleState& s) {
                fastest = std::max(fastest, s.velocity_world.norm());
              });
      EXPECT_LT(fastest, 1.05 * speed) << spec.name;
      EXPECT_NEAR(end.velocity_world.y(), speed, 0.01 * speed) << spec.name;
      EXPECT_NEAR(yaw_of(end.q_world_body), 0.5, 0.01) << spec.name;
    }
  }
}

TEST(Tracking, AccelerationAndYawRateAreHeld) {
  const VehicleModel model = make_model(hummingbird_spec());
  Command command;
  command.kind = CommandKind::acceleration;
  command.acceleration_world = {2, 0, 0};
  command.yaw_is_rate = true;
  command.yaw_rate_radps = 1.0;
  VehicleState at_1s, at_2s;
  const VehicleState end = fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 8,
                               [&](const Tracker&, const VehicleState& s) {
                                 if (s.tick <= kTicksPerSecond) at_1s = s;
                                 if (s.tick <= 2 * kTicksPerSecond) at_2s = s;
                               });
  EXPECT_NEAR(acceleration_world(model, at_2s, {}).x(), 2.0, 0.1);
  EXPECT_NEAR(yaw_of(at_2s.q_world_body) - yaw_of(at_1s.q_world_body), 1.0, 0.02);
  EXPECT_NEAR(end.velocity_world.norm(), 8.0, 0.1);
}

TEST(Tracking, RatesAreReachedAndLimited) {
  const VehicleModel model = make_model(hummingbird_spec());
  Command command;
  command.kind = CommandKind::rates;
  command.rates_body_radps = {0, 0, 50};
  command.thrust_mps2 = 9.81;
  const VehicleState spun = fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 1);
  EXPECT_NEAR(spun.rates_body.z(), 4.0, 0.1);
  command.rates_body_radps = {1, 0, 0};
  const VehicleState rolled = fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 0.3);
  EXPECT_NEAR(rolled.rates_body.x(), 1.0, 0.02);
  command.rates_body_radps.setZero();
  command.thrust_mps2 = 1000;
  const VehicleState up = fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 0.3);
  EXPECT_NEAR(up.rotor_speed_radps.maxCoeff(), 838.0, 0.01);
}

TEST(Tracking, CircleWithFeedForward) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState start = hovering_at(model.spec, {2, 0, 2}, M_PI / 2);
  start.velocity_world = {0, 3, 0};
  for (const double period_s : {0.02, 0.2}) {
    double sum = 0;
    int count = 0;
    fly(model, start, circle(2, 3, 8, period_s), 7,
        [&](const Tracker& tracker, const VehicleState& s) {
          if (seconds(s.tick) < 1) return;
          const double angle = 1.5 * seconds(s.tick);
          const Vector3d ideal(2 * std::cos(angle), 2 * std::sin(angle), 2);
          EXPECT_LT((reference(tracker).position_world - ideal).norm(), 1e-4);
          sum += (s.position_world - ideal).squaredNorm();
          ++count;
        });
    EXPECT_LT(std::sqrt(sum / count), 0.05);
    RecordProperty("rms_m", std::to_string(std::sqrt(sum / count)));
    std::printf("circle rms %.4f m\n", std::sqrt(sum / count));
  }
}

TEST(Tracking, ACommandBeginsWhereTheOneBeforeHasLed) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0);
  Tracker kept = make_tracker(model, state);
  accept(kept, model, fly_at({2, 0, 0}), state);
  state.tick += 400 * kTicksPerMillisecond;
  state.position_world.x() = 0.3;
  Tracker changed = kept;
  advance(kept, model, state);
  ASSERT_GT(kept.reference.velocity_world.x(), 0.1);
  accept(changed, model, fly_at({0, 2, 0}), state);
  EXPECT_EQ(changed.reference_tick, state.tick);
  EXPECT_EQ(changed.reference.position_world, kept.reference.position_world);
  EXPECT_EQ(changed.reference.velocity_world, kept.reference.velocity_world);
  EXPECT_EQ(changed.reference.acceleration_world, kept.reference.acceleration_world);
}

TEST(Tracking, TrajectoryEndsAtRestAtItsLastPoint) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState start = hovering_at(model.spec, {2, 0, 2}, M_PI / 2);
  const Command command = circle(2, 2, 3, 0.1);
  const VehicleState end = fly(model, start, command, 12);
  EXPECT_LT((end.position_world - command.trajectory.back().position_world).norm(), 0.01);
  EXPECT_LT(end.velocity_world.norm(), 0.01);
}

TEST(Tracking, TrajectoryThatStartsLaterIsReachedSmoothly) {
  const VehicleModel model = make_model(hummingbird_spec());
  Command command = circle(2, 2, 3, 0.1);
  for (TrajectoryPoint& point : command.trajectory) point.time_s += 1.5;
  Vector3d before(1, 0, 2);
  fly(model, hovering_at(model.spec, before, 0), command, 4,
      [&](const Tracker& tracker, const VehicleState&) {
        EXPECT_LT((reference(tracker).position_world - before).norm(), 0.005);
        before = reference(tracker).position_world;
      });
}

TEST(Tracking, SwitchingKindsKeepsTheReferenceSmooth) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {2, 0, 2}, M_PI / 2);
  Tracker tracker = make_tracker(model, state);
  Command rates;
  rates.kind = CommandKind::rates;
  rates.thrust_mps2 = 10;
  rates.rates_body_radps = {0.5, 0.2, 0};
  Command acceleration;
  acceleration.kind = CommandKind::acceleration;
  acceleration.acceleration_world = {0, 1, 0};
  const std::vector<Command> commands{circle(2, 2, 5, 0.1), fly_at({1, 1, 0}),   rates,
                                      go_to({0, 0, 3}),     acceleration,        rates,
                                      fly_at({0, -1, 0}),   circle(2, 2, 5, 0.1)};
  Reference before = reference(tracker);
  for (std::size_t k = 0; k < commands.size(); ++k) {
    Command command = commands[k];
    command.start_tick = state.tick;
    // A trajectory starts where it wants, and under rates the reference is the vehicle.
    const bool jumps =
        command.kind == CommandKind::trajectory || command.kind == CommandKind::rates;
    accept(tracker, model, command, state);
    for (int i = 0; i < 700; ++i) {
      const RotorVector rotors = track(tracker, model, state);
      const Reference& now = reference(tracker);
      if (!(jumps && i == 0)) {
        EXPECT_LT((now.position_world - before.position_world).norm(), 0.01) << k;
        EXPECT_LT((now.velocity_world - before.velocity_world).norm(), 0.05) << k;
      }
      before = now;
      state = step(model, state, rotors, {}, kTicksPerMillisecond);
    }
  }
  EXPECT_LT(tilt(state), 1.0);
}

TEST(Tracking, HoldBrakesWithinTheStoppingDistance) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0);
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, fly_at({6, 0, 0}), state);
  double held_at = 0;
  for (int i = 0; i < 8000; ++i) {
    if (i == 3000) {
      held_at = state.position_world.x();
      hold(tracker, model, state);
    }
    const RotorVector rotors = track(tracker, model, state);
    state = step(model, state, rotors, {}, kTicksPerMillisecond);
  }
  // At 6 m/s² within 30 m/s³: 6²/12 + 6 · 0.2/2 = 3.6 m at best.
  EXPECT_GT(state.position_world.x() - held_at, 3.5);
  EXPECT_LT(state.position_world.x() - held_at, 4.6);
  EXPECT_LT(state.velocity_world.norm(), 1e-4);
}

TEST(Tracking, HorizonBrakes) {
  const VehicleModel model = make_model(hummingbird_spec());
  Command command = fly_at({3, 0, 0});
  command.horizon_s = 1.5;
  const VehicleState at_horizon = fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 1.5);
  EXPECT_NEAR(at_horizon.velocity_world.x(), 3.0, 0.1);
  EXPECT_LT(fly(model, hovering_at(model.spec, {0, 0, 2}, 0), command, 6).velocity_world.norm(),
            1e-3);
}

TEST(Tracking, LeansAgainstAForce) {
  const VehicleModel model = make_model(hummingbird_rotors_spec());
  Environment push;
  push.force_world_n = {2, 0, 0};
  const VehicleState end =
      fly(model, hovering_at(model.spec, {0, 0, 2}, 0), go_to({0, 0, 2}), 10, {}, push);
  EXPECT_NEAR(tilt(end), std::atan(2 / (0.73103 * 9.8)), 1e-6);
  EXPECT_NEAR(end.position_world.x(), 2 / 0.73103 / 10, 1e-3);  // what the position gain leaves
}

/// How far the reference was from the vehicle at most, while a force blew it off for 10 s that it
/// can't beat.
double longest_lead_m(const Command& command) {
  const VehicleModel model = make_model(hummingbird_spec());
  Environment blast;
  blast.force_world_n = {-12, 0, 0};
  double most_m = 0, slowest = 0;
  fly(
      model, hovering_at(model.spec, {0, 0, 2}, 0), command, 10,
      [&](const Tracker& tracker, const VehicleState& s) {
        most_m = std::max(most_m, (reference(tracker).position_world - s.position_world).norm());
        slowest = std::min(slowest, s.velocity_world.x());
      },
      blast);
  EXPECT_LT(slowest, -2.0);
  return most_m;
}

TEST(Tracking, AReferenceThatTheVehicleCantFollowStaysWithinTwoMetres) {
  Command acceleration;
  acceleration.kind = CommandKind::acceleration;
  acceleration.acceleration_world = {2, 0, 0};
  EXPECT_NEAR(longest_lead_m(fly_at({4, 0, 0})), 2.0, 1e-6);
  EXPECT_NEAR(longest_lead_m(acceleration), 2.0, 1e-6);
  // A position command has its own place to come back to.
  EXPECT_GT(longest_lead_m(go_to({0, 0, 2})), 10.0);
}

TEST(Tracking, SlowPhysicsFliesToo) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0);
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, go_to({5, 0, 2}), state);
  double furthest = 0;
  for (int i = 0; i < 2000; ++i) {
    const RotorVector rotors = track(tracker, model, state);
    state = step(model, state, rotors, {}, 4 * kTicksPerMillisecond);
    furthest = std::max(furthest, state.position_world.x());
  }
  EXPECT_LT(furthest, 5.1);
  EXPECT_LT((state.position_world - Vector3d(5, 0, 2)).norm(), 1e-3);
}

}  // namespace
}  // namespace avoidbench
