#include "control/lee_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "control/mixer.hpp"
#include "geometry/pose.hpp"
#include "support/flights.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// The vehicle that the gains of RotorS are made for: its controller's mass, inertia and gravity.
VehicleSpec matched_hummingbird() {
  VehicleSpec spec = without_drag(flat_hummingbird());
  spec.controller = Controller::lee;
  spec.mass_kg = 0.716;
  spec.gravity_mps2 = 9.81;
  spec.rotor_inertia_kgm2 = 0.0;
  spec.max_tilt_rad = 1.4;
  spec.lee_controller = {};
  return spec;
}

struct Step {
  double overshoot_ratio = 0.0, peak_s = 0.0, last = 0.0;
};

/// The answer to a reference that jumps to `to` and `yaw_rad`.
Step jump(const VehicleSpec& spec, const Vector3d& to, double yaw_rad, double size,
          const std::function<double(const VehicleState&)>& seen) {
  const VehicleModel model = make_model(spec);
  VehicleState state = hovering_at(spec, {0, 0, 0}, 0);
  Reference reference;
  reference.position_world = to;
  reference.yaw_rad = yaw_rad;
  Step found;
  for (int i = 0; i < 8000; ++i) {
    const ThrustAndTorque wanted = lee_control(model, state, reference);
    const RotorVector rotors = mix(model, wanted.thrust_n, wanted.torque_body_nm);
    state = step(model, state, rotors, {}, kTicksPerMillisecond);
    const double part = seen(state) / size;
    if (part - 1 > found.overshoot_ratio) {
      found.overshoot_ratio = part - 1;
      found.peak_s = (i + 1) * 1e-3;
    }
    found.last = part;
  }
  return found;
}

TEST(Lee, HeightStepIsTheSecondOrderOfItsGains) {
  const auto height = [](const VehicleState& s) { return s.position_world.z(); };
  // omega 2.3636 rad/s, zeta 0.650: 6.81 % at 1.749 s; the rotors' lag comes on top.
  VehicleSpec quick = matched_hummingbird();
  quick.time_constant_up_s = quick.time_constant_down_s = 1e-4;
  const Step ideal = jump(quick, {0, 0, 0.2}, 0, 0.2, height);
  EXPECT_NEAR(ideal.overshoot_ratio, 0.0681, 0.0003);
  EXPECT_NEAR(ideal.peak_s, 1.749, 0.003);
  const Step lagging = jump(matched_hummingbird(), {0, 0, 0.2}, 0, 0.2, height);
  std::printf("z step: ideal %.4f at %.3f s, with rotor lag %.4f at %.3f s\n",
              ideal.overshoot_ratio, ideal.peak_s, lagging.overshoot_ratio, lagging.peak_s);
  EXPECT_NEAR(lagging.overshoot_ratio, 0.0681, 0.015);
  EXPECT_NEAR(lagging.peak_s, 1.749, 0.08);
  EXPECT_NEAR(lagging.last, 1.0, 1e-4);
}

TEST(Lee, YawStepIsTheSecondOrderOfItsGains) {
  const auto yaw = [](const VehicleState& s) { return yaw_of(s.q_world_body); };
  // omega 1.708 rad/s, zeta 0.610
  const double zeta = 0.025 / (2 * std::sqrt(0.035 * 0.012));
  const double damped = std::sqrt(0.035 / 0.012) * std::sqrt(1 - zeta * zeta);
  VehicleSpec quick = matched_hummingbird();
  quick.time_constant_up_s = quick.time_constant_down_s = 1e-4;
  const Step found = jump(quick, {0, 0, 0}, 0.05, 0.05, yaw);
  EXPECT_NEAR(found.overshoot_ratio, std::exp(-M_PI * zeta / std::sqrt(1 - zeta * zeta)), 0.002);
  EXPECT_NEAR(found.peak_s, M_PI / damped, 0.02);
}

TEST(Lee, SidewaysStepOvershootsMoreByTheAttitudesLag) {
  const auto x = [](const VehicleState& s) { return s.position_world.x(); };
  const Step found = jump(matched_hummingbird(), {0.2, 0, 0}, 0, 0.2, x);
  std::printf("x step: %.4f at %.3f s\n", found.overshoot_ratio, found.peak_s);
  EXPECT_GT(found.overshoot_ratio, 0.0681);
  EXPECT_LT(found.overshoot_ratio, 0.25);
  EXPECT_NEAR(found.last, 1.0, 1e-3);
}

double hover_error_m(VehicleSpec spec) {
  spec.controller = Controller::lee;
  const VehicleModel model = make_model(spec);
  return fly(model, hovering_at(spec, {0, 0, 2}, 0), go_to({0, 0, 2}), 15).position_world.z() - 2;
}

TEST(Lee, AMassTakenForAnotherShiftsTheHover) {
  EXPECT_NEAR(hover_error_m(hummingbird_rotors_spec()), -0.0350, 5e-5);
  VehicleSpec firefly = firefly_spec();
  firefly.gravity_mps2 = 9.8;
  firefly.lee_controller.mass_kg = 1.56779;
  firefly.lee_controller.gravity_mps2 = 9.81;
  EXPECT_NEAR(hover_error_m(firefly), 0.0398, 5e-5);
  EXPECT_NEAR(hover_error_m(hummingbird_spec()), 0.0, 1e-9);
  EXPECT_NEAR(hover_error_m(firefly_spec()), 0.0, 1e-9);
}

/// T14: the tilt that balances 5 N.
TEST(Lee, LeansAgainstAForce) {
  VehicleSpec spec = hummingbird_rotors_spec();
  spec.controller = Controller::lee;
  spec.lee_controller.mass_kg = 0.0;
  spec.lee_controller.gravity_mps2 = 0.0;
  const VehicleModel model = make_model(spec);
  Environment push;
  push.force_world_n = {3, 4, 0};
  const VehicleState end =
      fly(model, hovering_at(spec, {0, 0, 2}, 0), go_to({0, 0, 2}), 20, {}, push);
  const double tilt_rad = std::acos((end.q_world_body * Vector3d::UnitZ()).z());
  EXPECT_NEAR(tilt_rad * 180 / M_PI, 34.912, 0.001);
  EXPECT_LT((end.position_world - Vector3d(0.75, 1.0, 2)).norm(), 1e-3);  // 5 N / (4 N/m)
}

TEST(Lee, FliesEveryKindOfCommand) {
  for (VehicleSpec spec : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
    spec.controller = Controller::lee;
    const VehicleModel model = make_model(spec);
    const VehicleState start = hovering_at(spec, {2, 0, 2}, M_PI / 2);
    const VehicleState there = fly(model, start, go_to({8, -3, 4}, 1.0), 15);
    EXPECT_LT((there.position_world - Vector3d(8, -3, 4)).norm(), 0.04) << spec.name;
    EXPECT_NEAR(yaw_of(there.q_world_body), 1.0, 1e-3) << spec.name;
    const VehicleState cruising = fly(model, start, fly_at({3, 1, 0}, 0.3), 8);
    EXPECT_LT((cruising.velocity_world - Vector3d(3, 1, 0)).norm(), 0.05) << spec.name;
    Command rates = go_to({0, 0, 0});
    rates.kind = CommandKind::rates;
    rates.rates_body_radps = {0, 0, 1};
    rates.thrust_mps2 = spec.gravity_mps2;
    EXPECT_NEAR(fly(model, start, rates, 1).rates_body.z(), 1.0, 0.05) << spec.name;
    const VehicleState held = fly(model, start, circle(2, 2, 6, 0.1), 14);
    EXPECT_LT(held.velocity_world.norm(), 0.01) << spec.name;
  }
}

double circle_error_m(const VehicleSpec& spec) {
  const VehicleModel model = make_model(spec);
  double square = 0.0;
  int count = 0;
  fly(model, hovering_at(spec, {2, 0, 2}, M_PI / 2), circle(2, 2, 12, 0.05), 12,
      [&](const Tracker& tracker, const VehicleState& s) {
        if (seconds(s.tick) < 6) return;
        square += (s.position_world - reference(tracker).position_world).squaredNorm();
        ++count;
      });
  return std::sqrt(square / count);
}

TEST(Lee, FeedForwardFollowsACircleCloser) {
  VehicleSpec spec = without_drag(hummingbird_spec());  // for which it has no remedy
  spec.controller = Controller::lee;
  const double with = circle_error_m(spec);
  spec.lee_controller.feed_forward = false;
  const double without = circle_error_m(spec);
  std::printf("circle rms: with feed-forward %.4f m, without %.4f m\n", with, without);
  EXPECT_LT(with, 0.2 * without);
}

}  // namespace
}  // namespace avoidbench
