// Steps of 4 ms, those of configs/rates/learning.yaml.
#include <gtest/gtest.h>

#include "support/flights.hpp"
#include "support/plain_rk4.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr Tick kLongStep = 4 * kTicksPerMillisecond;

/// Half a second of rotors at full tilt from a turning, climbing start.
VehicleState turning_start() {
  VehicleState start;
  start.velocity_world = {4, -2, 1};
  start.rates_body = {3, -2, 1.5};
  start.rotor_speed_radps.resize(4);
  start.rotor_speed_radps << 400, 420, 440, 460;
  return start;
}

TEST(LearningStep, IsAThousandTimesNearerThanFirstOrderAt2500Microseconds) {
  const VehicleSpec spec = flat_hummingbird();
  const VehicleModel model = make_model(spec);
  RotorVector command(4);
  command << 600, 650, 620, 610;
  plain::Vector17 exact = plain::pack(turning_start()), first_order = exact;
  for (int i = 0; i < 50000; ++i) exact = plain::step(spec, exact, command, {}, 1e-5);
  for (int i = 0; i < 200; ++i) {
    first_order += 2.5e-3 * plain::derivative(spec, first_order, command, {});
    first_order.segment<4>(6).normalize();
  }
  VehicleState state = turning_start();
  for (int i = 0; i < 125; ++i) state = step(model, state, command, {}, kLongStep);
  const double error_m = (state.position_world - exact.head<3>()).norm();
  const double first_order_error_m = (first_order - exact).head<3>().norm();
  EXPECT_LT(error_m, 2.5e-6);
  EXPECT_GT(first_order_error_m, 1000.0 * error_m) << first_order_error_m;
}

/// Where a flight under a command is after 3 s of such steps, the controllers in each of them.
VehicleState flown(const VehicleModel& model, const Command& command, Tick step_ticks) {
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.0);
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, command, state);
  while (state.tick < 3 * kTicksPerSecond) {
    const RotorVector rotors = track(tracker, model, state);
    state = step(model, state, rotors, {}, step_ticks);
  }
  return state;
}

TEST(LearningStep, FliesWithinMillimetresOfTheDefault) {
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    for (const Command& command : {go_to({6, 3, 3}, 0.5), fly_at({2, -1, 0.3})}) {
      const VehicleState fine = flown(model, command, kTicksPerMillisecond);
      const VehicleState coarse = flown(model, command, kLongStep);
      EXPECT_LT((coarse.position_world - fine.position_world).norm(), 0.01) << spec.name;
      EXPECT_LT((coarse.velocity_world - fine.velocity_world).norm(), 0.02) << spec.name;
    }
  }
}

}  // namespace
}  // namespace avoidbench
