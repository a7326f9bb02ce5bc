#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "control/position_controller.hpp"
#include "control/rate_controller.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// The vehicle of the published step responses: m = 0.73, g = 9.81, bare inertia, no saturation of
/// rates.
VehicleSpec golden_vehicle(bool aerodynamics) {
  VehicleSpec spec = flat_hummingbird();
  spec.mass_kg = 0.73;
  spec.gravity_mps2 = 9.81;
  spec.rotor_inertia_kgm2 = 0.0;
  spec.max_rates_radps = {100, 100, 100};
  spec.max_tilt_rad = 1.4;
  spec.position_controller.drag_compensation = false;
  return aerodynamics ? spec : without_drag(spec);
}

struct Response {
  double rise_s = 0, overshoot_ratio = 0, peak_s = 0, settled_s = 0, final = 0;
};

/// 10-90 % rise time, overshoot and its time, and time of entering ±2 % for good.
Response response(const std::vector<double>& y, double to) {
  Response r;
  r.final = y.back();
  double t10 = -1, t90 = -1, peak = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double t = static_cast<double>(i) * 1e-3, part = y[i] / to;
    if (t10 < 0 && part >= 0.1) t10 = t;
    if (t90 < 0 && part >= 0.9) t90 = t;
    if (part > peak) {
      peak = part;
      r.peak_s = t;
    }
    if (std::abs(part - 1) > 0.02) r.settled_s = t + 1e-3;
  }
  r.rise_s = t90 - t10;
  r.overshoot_ratio = peak - 1;
  return r;
}

/// The mixer the published responses were made with: each rotor clamped by itself.
RotorVector clamped_mix(const VehicleModel& model, const VehicleState& state,
                        const RateTarget& target) {
  const Vector3d torque = rate_torque(model, state, target);
  RotorVector speeds(model.rotor_count);
  for (int i = 0; i < model.rotor_count; ++i) {
    const auto& row = model.mixing[static_cast<std::size_t>(i)];
    const double thrust = row[0] * target.thrust_mps2 * model.spec.mass_kg + row[1] * torque.x() +
                          row[2] * torque.y() + row[3] * torque.z();
    speeds[i] = std::sqrt(std::clamp(thrust, 0.0, model.max_rotor_thrust_n) /
                          model.spec.thrust_coefficient_ns2);
  }
  return speeds;
}

using Outer = std::function<RateTarget(const VehicleState&)>;
using Seen = std::function<double(const VehicleState&)>;

/// The outer loop at 1 kHz, the rate loop at `rate_hz`, from hover.
std::vector<double> run(const VehicleModel& model, int rate_hz, double duration_s,
                        const Outer& outer, const Seen& seen) {
  VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0);
  RotorVector rotors = state.rotor_speed_radps;
  std::vector<double> values;
  for (int i = 0; i < static_cast<int>(duration_s * 1000); ++i) {
    values.push_back(seen(state));
    const RateTarget target = outer(state);
    if (i % (1000 / rate_hz) == 0) rotors = clamped_mix(model, state, target);
    state = step(model, state, rotors, {}, kTicksPerMillisecond);
  }
  return values;
}

std::vector<double> rate_step(bool aerodynamics, int rate_hz, const Vector3d& rates, int axis) {
  const VehicleModel model = make_model(golden_vehicle(aerodynamics));
  return run(
      model, rate_hz, 3.0,
      [&](const VehicleState&) {
        return RateTarget{rates, 9.81};
      },
      [&](const VehicleState& s) { return s.rates_body[axis]; });
}

std::vector<double> pose_step(bool aerodynamics, int rate_hz, const Vector3d& to, double yaw_rad,
                              double duration_s, const Seen& seen) {
  const VehicleModel model = make_model(golden_vehicle(aerodynamics));
  Reference reference;
  reference.position_world = to;
  reference.yaw_rad = yaw_rad;
  return run(
      model, rate_hz, duration_s,
      [&](const VehicleState& s) { return position_control(model, s, reference); }, seen);
}

TEST(ClosedLoop, RollRateStep) {
  const auto at_200 = rate_step(false, 200, {1, 0, 0}, 0);
  const auto at_1000 = rate_step(false, 1000, {1, 0, 0}, 0);
  const Response slow = response(at_200, 1), fast = response(at_1000, 1);
  EXPECT_NEAR(slow.rise_s, 0.084, 0.003);
  EXPECT_NEAR(slow.settled_s, 0.144, 0.004);
  EXPECT_NEAR(at_200[100], 0.9106, 0.01);
  EXPECT_LT(slow.overshoot_ratio, 0.001);
  EXPECT_NEAR(fast.rise_s, 0.087, 0.003);
  EXPECT_NEAR(fast.settled_s, 0.152, 0.004);
  EXPECT_NEAR(at_1000[100], 0.8972, 0.01);
  EXPECT_LT(fast.overshoot_ratio, 0.001);
}

TEST(ClosedLoop, YawRateStep) {
  const Response slow = response(rate_step(false, 200, {0, 0, 1}, 2), 1);
  EXPECT_NEAR(slow.rise_s, 0.067, 0.003);
  EXPECT_NEAR(slow.overshoot_ratio, 0.0168, 0.002);
  EXPECT_NEAR(slow.final, 1.0, 1e-6);
  const Response fast = response(rate_step(false, 1000, {0, 0, 1}, 2), 1);
  EXPECT_NEAR(fast.rise_s, 0.069, 0.003);
  EXPECT_NEAR(fast.overshoot_ratio, 0.0116, 0.002);
}

TEST(ClosedLoop, YawRateUnderDragIsTheClosedForm) {
  const double damping = 4 * 457.6347 * 8.06428e-5 * 0.17 * 0.17;
  EXPECT_NEAR(0.4 / (0.4 + 1.3 * damping), 0.9863, 1e-4);
  EXPECT_NEAR(response(rate_step(true, 200, {0, 0, 1}, 2), 1).final, 0.98633, 2e-5);
}

TEST(ClosedLoop, HeightStep) {
  const auto height = [](const VehicleState& s) { return s.position_world.z(); };
  const Response slow = response(pose_step(false, 200, {0, 0, 0.2}, 0, 4, height), 0.2);
  EXPECT_NEAR(slow.rise_s, 0.567, 0.01);
  EXPECT_NEAR(slow.overshoot_ratio, 0.0217, 0.001);
  EXPECT_NEAR(slow.peak_s, 1.211, 0.02);
  EXPECT_NEAR(slow.settled_s, 1.319, 0.02);
  const Response fast = response(pose_step(true, 1000, {0, 0, 0.2}, 0, 4, height), 0.2);
  EXPECT_NEAR(fast.rise_s, 0.570, 0.01);
  EXPECT_NEAR(fast.overshoot_ratio, 0.0219, 0.001);
  EXPECT_NEAR(fast.settled_s, 1.334, 0.02);
}

TEST(ClosedLoop, SidewaysStep) {
  const auto x = [](const VehicleState& s) { return s.position_world.x(); };
  const Response slow = response(pose_step(false, 200, {0.3, 0, 0}, 0, 4, x), 0.3);
  EXPECT_NEAR(slow.rise_s, 0.455, 0.01);
  EXPECT_NEAR(slow.overshoot_ratio, 0.1011, 0.003);
  EXPECT_NEAR(slow.peak_s, 1.078, 0.02);
  EXPECT_NEAR(slow.settled_s, 1.594, 0.03);
  const Response fast = response(pose_step(false, 1000, {0.3, 0, 0}, 0, 4, x), 0.3);
  EXPECT_NEAR(fast.rise_s, 0.454, 0.01);
  EXPECT_NEAR(fast.overshoot_ratio, 0.1012, 0.003);
}

TEST(ClosedLoop, YawStep) {
  const auto yaw = [](const VehicleState& s) {
    const Vector3d heading = s.q_world_body * Vector3d::UnitX();
    return std::atan2(heading.y(), heading.x());
  };
  const double quarter = M_PI / 2;
  EXPECT_NEAR(response(pose_step(false, 200, {0, 0, 0}, quarter, 4, yaw), quarter).rise_s, 0.379,
              0.01);
  EXPECT_NEAR(response(pose_step(true, 200, {0, 0, 0}, quarter, 4, yaw), quarter).rise_s, 0.394,
              0.01);
  EXPECT_NEAR(response(pose_step(false, 1000, {0, 0, 0}, quarter, 4, yaw), quarter).rise_s, 0.382,
              0.01);
  EXPECT_NEAR(response(pose_step(true, 1000, {0, 0, 0}, quarter, 4, yaw), quarter).rise_s, 0.395,
              0.01);
  const auto drift = [](const VehicleState& s) { return s.position_world.head<2>().norm(); };
  for (const double d : pose_step(true, 200, {0, 0, 0}, quarter, 4, drift)) EXPECT_LT(d, 1e-9);
}

TEST(ClosedLoop, RawTenMetreStepOvershoots) {
  double fastest = 0;
  const Response r = response(pose_step(true, 200, {10, 0, 0}, 0, 10,
                                        [&](const VehicleState& s) {
                                          fastest = std::max(fastest, s.velocity_world.norm());
                                          return s.position_world.x();
                                        }),
                              10);
  EXPECT_NEAR(fastest, 5.10, 0.1);
  EXPECT_NEAR(r.overshoot_ratio * 10, 1.69, 0.05);
}

}  // namespace
}  // namespace avoidbench
