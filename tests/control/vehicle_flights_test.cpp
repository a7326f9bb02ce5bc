// Vehicles of all sizes under their own limits: hovering, straight flights at 5, 10 and 15 m/s,
// circles, braking and top speed, each beside its closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/flights.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kSpeeds_mps[] = {5.0, 10.0, 15.0};

/// The presets, and the hummingbird with derived fields.
std::vector<VehicleSpec> vehicles() {
  std::vector<VehicleSpec> all = vehicle_presets();
  VehicleSpec strong = hummingbird_spec();
  strong.name = "hummingbird, T 4";
  strong.thrust_to_weight = 4.0;
  strong.max_speed_mps = 15.0;
  all.push_back(settled(strong));
  strong.name = "hummingbird, T 4, α 160";
  strong.angular_acceleration_radps2 = 160.0;
  all.push_back(settled(strong));
  return all;
}

struct StraightFlight {
  double worst_m = 0.0;  ///< from the reference, at any time
  double lost_height_m = 0.0;
  double stops_in_m = 0.0;  ///< flown, from the command to rest
  double held_mps = 0.0;    ///< before braking
};

/// From hover to `speed_mps` along x, until it is held, then the command to stop.
StraightFlight fly_straight(const VehicleModel& model, double speed_mps) {
  const double cruise_s = 3.0 + 2.0 * speed_mps / model.spec.max_acceleration_mps2;
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.0);
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, fly_at({speed_mps, 0, 0}), state);
  StraightFlight flight;
  double from_m = 0.0;
  for (int i = 0; i < static_cast<int>(2000 * cruise_s); ++i) {
    if (i == static_cast<int>(1000 * cruise_s)) {
      flight.held_mps = state.velocity_world.x();
      from_m = state.position_world.x();
      accept(tracker, model, fly_at({0, 0, 0}), state);
    }
    const RotorVector rotors = track(tracker, model, state);
    const double error_m = (reference(tracker).position_world - state.position_world).norm();
    flight.worst_m = std::max(flight.worst_m, error_m);
    flight.lost_height_m = std::max(flight.lost_height_m, std::abs(state.position_world.z() - 2));
    state = step(model, state, rotors, {}, kTicksPerMillisecond);
  }
  EXPECT_LT(state.velocity_world.norm(), 0.02) << model.spec.name << speed_mps;
  flight.stops_in_m = state.position_world.x() - from_m;
  return flight;
}

/// Greatest distance from a circle flown with half of the acceleration limit, after a second.
double circle_error_m(const VehicleModel& model, double speed_mps) {
  const double radius_m = 2.0 * speed_mps * speed_mps / model.spec.max_acceleration_mps2;
  VehicleState start = hovering_at(model.spec, {radius_m, 0, 2}, M_PI / 2);
  start.velocity_world = {0, speed_mps, 0};
  double worst_m = 0.0;
  fly(model, start, circle(radius_m, speed_mps, 10, 0.02), 8,
      [&](const Tracker& tracker, const VehicleState& state) {
        if (seconds(state.tick) < 2) return;
        const double error_m = (reference(tracker).position_world - state.position_world).norm();
        worst_m = std::max(worst_m, error_m);
      });
  return worst_m;
}

/// The speed that it keeps where it is told to fly faster than drag lets it.
double flown_top_speed_mps(VehicleSpec spec) {
  constexpr double kLong_s = 200.0;  // rotor drag takes many seconds at a steep tilt
  spec.max_speed_mps = 1.05 * top_speed_mps(spec);
  const VehicleModel model = make_model(spec);
  return fly(model, hovering_at(spec, {0, 0, 0}, 0.0), fly_at({spec.max_speed_mps, 0, 0}), kLong_s)
      .velocity_world.x();
}

/// Without the torques that drag has at the rotors: at the 100 m/s and more that rotor drag alone
/// allows they are beyond any controller, and no part of the closed form.
VehicleSpec without_drag_torque(VehicleSpec spec) {
  for (RotorSpec& rotor : spec.rotors) rotor.position_body_m[2] = 0.0;
  spec.rolling_moment_coefficient_kgm = 0.0;
  return spec;
}

TEST(VehicleFlights, EachHovers) {
  for (VehicleSpec spec : vehicles()) {
    for (const Controller controller : {Controller::rpg, Controller::lee}) {
      spec.controller = controller;
      const VehicleModel model = make_model(spec);
      VehicleState start = hovering_at(spec, {0, 0, 2}, 0.3);
      start.q_world_body = start.q_world_body * Eigen::AngleAxisd(0.2, Vector3d::UnitX());
      start.rates_body = {0.5, -0.5, 0.2};
      const VehicleState end = fly(model, start, go_to({0, 0, 2}, 0.3), 12);
      const double offset_m = spec.name == "hummingbird_rotors" && controller == Controller::lee
                                  ? 0.04  // its controller takes it for lighter
                                  : 1e-4;
      EXPECT_LT((end.position_world - Vector3d(0, 0, 2)).norm(), offset_m) << spec.name;
      EXPECT_LT(end.velocity_world.norm(), 1e-4) << spec.name;
      EXPECT_LT(end.rates_body.norm(), 1e-3) << spec.name;
    }
  }
}

TEST(VehicleFlights, StraightLinesAreTrackedAndBrakedInTheClosedFormsWay) {
  for (const VehicleSpec& spec : vehicles()) {
    const VehicleModel model = make_model(spec);
    for (const double speed_mps : kSpeeds_mps) {
      if (speed_mps > spec.max_speed_mps) continue;
      const StraightFlight flight = fly_straight(model, speed_mps);
      EXPECT_NEAR(flight.held_mps, speed_mps, 0.01 * speed_mps) << spec.name << speed_mps;
      EXPECT_LT(flight.worst_m, 0.25) << spec.name << speed_mps;
      EXPECT_LT(flight.lost_height_m, 0.25) << spec.name << speed_mps;
      const double closed_m = stopping_distance_m(model, speed_mps);
      EXPECT_NEAR(flight.stops_in_m, closed_m, 0.05 * closed_m) << spec.name << speed_mps;
      EXPECT_GT(closed_m, 0.5 * speed_mps * speed_mps / spec.max_acceleration_mps2);
    }
  }
}

TEST(VehicleFlights, CirclesAreTracked) {
  for (const VehicleSpec& spec : vehicles()) {
    const VehicleModel model = make_model(spec);
    for (const double speed_mps : kSpeeds_mps) {
      if (speed_mps > spec.max_speed_mps) continue;
      EXPECT_LT(circle_error_m(model, speed_mps), 0.15) << spec.name << speed_mps;
    }
  }
}

TEST(VehicleFlights, TopSpeedIsTheClosedForms) {
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    const VehicleSpec spec = without_drag_torque(vehicle);
    const double top_mps = top_speed_mps(spec);
    EXPECT_NEAR(flown_top_speed_mps(spec), top_mps, 0.01 * top_mps) << spec.name;
  }
  // Rotors in the plane of the centre of gravity: as they are.
  for (const VehicleSpec& spec : {racing_5in_spec(), agile_quad_spec(), crazyflie_spec()}) {
    const double top_mps = top_speed_mps(spec);
    EXPECT_NEAR(flown_top_speed_mps(spec), top_mps, 0.01 * top_mps) << spec.name;
  }
}

TEST(VehicleFlights, DerivedVehiclesTrackToo) {
  for (const double ratio : {1.5, 2.0, 3.0, 5.0}) {
    for (const double turning_radps2 : {30.0, 80.0, 300.0}) {
      VehicleSpec spec = hummingbird_spec();
      spec.thrust_to_weight = ratio;
      spec.angular_acceleration_radps2 = turning_radps2;
      const VehicleModel model = make_model(settled(spec));
      const StraightFlight flight = fly_straight(model, 8.0);
      EXPECT_LT(flight.worst_m, 0.25) << ratio << " " << turning_radps2;
      EXPECT_LT(flight.lost_height_m, 0.2) << ratio << " " << turning_radps2;
      EXPECT_LT(circle_error_m(model, 8.0), 0.15) << ratio << " " << turning_radps2;
    }
  }
}

/// Prints the table of docs/vehicles.md and results/README.md.
TEST(VehicleFlights, Table) {
  std::printf(
      "| vehicle | speed m/s | straight m | circle m | stops in m | closed form m | v²/2a m |\n");
  for (const VehicleSpec& spec : vehicles()) {
    const VehicleModel model = make_model(spec);
    for (const double speed_mps : kSpeeds_mps) {
      if (speed_mps > spec.max_speed_mps) continue;
      const StraightFlight flight = fly_straight(model, speed_mps);
      const double shortest_m = 0.5 * speed_mps * speed_mps / spec.max_acceleration_mps2;
      std::printf("| %s | %.0f | %.3f | %.3f | %.2f | %.2f | %.2f |\n", spec.name.c_str(),
                  speed_mps, flight.worst_m, circle_error_m(model, speed_mps), flight.stops_in_m,
                  stopping_distance_m(model, speed_mps), shortest_m);
      EXPECT_GT(flight.stops_in_m, shortest_m);
    }
  }
  std::printf(
      "| vehicle | T | a m/s² | j m/s³ | roll, pitch, yaw rad/s² | top speed m/s | flown without "
      "the "
      "rotors' drag torque m/s | flown m/s |\n");
  for (const VehicleSpec& spec : vehicle_presets()) {
    const std::array<double, 3> turning = hover_angular_acceleration_radps2(spec);
    const double ideal_mps = flown_top_speed_mps(without_drag_torque(spec));
    std::printf("| %s | %.2f | %.1f | %.0f | %.0f, %.0f, %.1f | %.1f | %.1f | %.1f |\n",
                spec.name.c_str(), thrust_to_weight(spec), spec.max_acceleration_mps2,
                spec.max_jerk_mps3, turning[0], turning[1], turning[2], top_speed_mps(spec),
                ideal_mps, flown_top_speed_mps(spec));
    EXPECT_NEAR(ideal_mps, top_speed_mps(spec), 0.01 * ideal_mps) << spec.name;
  }
}

}  // namespace
}  // namespace avoidbench
