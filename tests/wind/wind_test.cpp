#include "wind/wind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/input_error.hpp"
#include "support/flights.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

WindSpec rough() {
  WindSpec spec;
  spec.mean_world_mps = {3, 4, 0};
  spec.gust.amplitude_world_mps = {5, 0, 0};
  spec.gust.period_s = 6.0;
  spec.gust.start_jitter_s = 2.0;
  spec.gust.random_heading = true;
  spec.turbulence.model = TurbulenceModel::mil_f_8785c;
  spec.kicks.rate_per_min = 20.0;
  spec.kicks.force_n = 2.0;
  spec.kicks.torque_nm = 0.02;
  return spec;
}

/// Steps of 1 ms, split where a force changes; `each` sees the environment and the step's length.
template <class Each>
void over_time(Wind& wind, double duration_s, Each&& each) {
  const Tick end = ticks(duration_s);
  for (Tick now = 0; now < end;) {
    const Environment environment = environment_at(wind, now, Vector3d::Zero());
    const Tick grid = (now / kTicksPerMillisecond + 1) * kTicksPerMillisecond;
    const Tick next = std::min({grid, next_force_change(wind, now), end});
    each(environment, next - now);
    now = next;
  }
}

TEST(Wind, TheDefaultIsStillAirForEver) {
  Wind wind = make_wind({}, 1, 60.0);
  EXPECT_TRUE(wind.is_steady);
  const Environment none = environment_at(wind, 12345, {1, 2, 3});
  EXPECT_EQ(none.wind_world_mps, Vector3d::Zero());
  EXPECT_EQ(none.force_world_n, Vector3d::Zero());
  EXPECT_EQ(none.torque_body_nm, Vector3d::Zero());
  EXPECT_EQ(next_force_change(wind, 0), std::numeric_limits<Tick>::max());
}

TEST(Wind, ConstantPartsAreThere) {
  WindSpec spec;
  spec.mean_world_mps = {1, 2, 3};
  spec.force_world_n = {4, 5, 6};
  spec.torque_body_nm = {7, 8, 9};
  for (const bool is_turbulent : {false, true}) {
    spec.turbulence.model = is_turbulent ? TurbulenceModel::given : TurbulenceModel::none;
    spec.turbulence.sigma_mps = {1e-9, 1e-9, 1e-9};
    Wind wind = make_wind(spec, 1, 60.0);
    EXPECT_EQ(wind.is_steady, !is_turbulent);
    const Environment now = environment_at(wind, 77, Vector3d::Zero());
    EXPECT_LT((now.wind_world_mps - Vector3d(1, 2, 3)).norm(), 1e-7);
    EXPECT_EQ(now.force_world_n, Vector3d(4, 5, 6));
    EXPECT_EQ(now.torque_body_nm, Vector3d(7, 8, 9));
  }
}

/// T14: 5 N for 2 s, rotors off, gravity off.
TEST(Wind, AForceGustHasItsImpulseWhereverItBegins) {
  VehicleSpec vehicle = flat_hummingbird();
  vehicle.gravity_mps2 = 0.0;
  const VehicleModel model = make_model(vehicle);
  for (const double start_s : {0.0, 0.5, 0.50037}) {
    WindSpec spec;
    spec.force_gust = {{3, 4, 0}, start_s, 2.0};
    Wind wind = make_wind(spec, 1, 60.0);
    VehicleState state = still(model, 0.0);
    over_time(wind, 4.0, [&](const Environment& environment, Tick dt) {
      state = step(model, state, all_rotors(model, 0.0), environment, dt);
    });
    EXPECT_NEAR(state.velocity_world.norm(), 13.679329, 1e-6);
    EXPECT_NEAR(state.velocity_world.norm(), 10 / 0.73103, 1e-9);
  }
}

TEST(Wind, KicksHaveTheirImpulseExactly) {
  WindSpec spec;
  spec.kicks = {60.0, 4.0, 0.05, 0.1234};
  Wind wind = make_wind(spec, 5, 100.0);
  Vector3d expected = Vector3d::Zero(), expected_twist = Vector3d::Zero();
  for (const Kick& kick : wind.kicks) {
    expected += seconds(kick.until - kick.from) * kick.force_world_n;
    expected_twist += seconds(kick.until - kick.from) * kick.torque_body_nm;
  }
  EXPECT_GT(wind.kicks.size(), 50U);
  Vector3d impulse = Vector3d::Zero(), twist = Vector3d::Zero();
  double most = 0.0;
  over_time(wind, 101.0, [&](const Environment& environment, Tick dt) {
    impulse += seconds(dt) * environment.force_world_n;
    twist += seconds(dt) * environment.torque_body_nm;
    most = std::max(most, environment.force_world_n.norm());
  });
  EXPECT_LT((impulse - expected).norm(), 1e-10);
  EXPECT_LT((twist - expected_twist).norm(), 1e-12);
  EXPECT_GT(most, 4.0 + 1e-9);  // some overlap
}

TEST(Wind, ATorqueTurnsTheBodyAboutItsOwnAxes) {
  VehicleSpec vehicle = flat_hummingbird();
  vehicle.gravity_mps2 = 0.0;
  const VehicleModel model = make_model(vehicle);
  Environment environment;
  environment.torque_body_nm = {0, 0, 0.006};
  VehicleState state = still(model, 0.0);
  state.q_world_body = Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Vector3d::UnitX()));
  state = coast(model, state, environment, 1000);
  EXPECT_NEAR(state.rates_body.z(), 0.5, 1e-12);
  EXPECT_LT(state.rates_body.head<2>().norm(), 1e-12);
  EXPECT_LT(state.velocity_world.norm(), 1e-12);
}

TEST(Wind, TurbulenceIsAlignedWithTheMeanWind) {
  WindSpec spec;
  spec.mean_world_mps = {0, 7, 1};
  spec.turbulence.model = TurbulenceModel::given;
  spec.turbulence.sigma_mps = {2, 0, 0};
  Wind wind = make_wind(spec, 3, 60.0);
  double square = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d gust = environment_at(wind, i * 1000, Vector3d::Zero()).wind_world_mps;
    EXPECT_EQ(gust.x(), 0.0);
    EXPECT_EQ(gust.z(), 1.0);
    square += (gust.y() - 7.0) * (gust.y() - 7.0) / 2000;
  }
  EXPECT_GT(square, 0.5);
  spec.turbulence.intensity_ratio = 0.0;
  EXPECT_TRUE(make_wind(spec, 3, 60.0).is_steady);
}

std::vector<double> log_of(const WindSpec& spec, std::uint64_t seed, Tick step) {
  Wind wind = make_wind(spec, seed, 30.0);
  std::vector<double> log;
  for (Tick now = 0; now < ticks(30.0); now += step) {
    const Environment environment = environment_at(wind, now, Vector3d::Zero());
    if (now % 360 != 0) continue;
    for (int i = 0; i < 3; ++i) {
      log.push_back(environment.wind_world_mps[i]);
      log.push_back(environment.force_world_n[i]);
      log.push_back(environment.torque_body_nm[i]);
    }
  }
  return log;
}

TEST(Wind, IsAFunctionOfTimeAndSeedAlone) {
  const std::vector<double> first = log_of(rough(), 4, 36);
  EXPECT_EQ(first, log_of(rough(), 4, 36));
  EXPECT_EQ(first, log_of(rough(), 4, 12));  // however time is split
  EXPECT_EQ(first, log_of(rough(), 4, 360));
  EXPECT_NE(first, log_of(rough(), 5, 36));
  WindSpec other = rough();
  other.seed = 2;
  EXPECT_NE(first, log_of(other, 4, 36));
}

TEST(Wind, ContradictionsAreToldAllAtOnce) {
  WindSpec spec;
  spec.gust.period_s = 1.0;
  spec.turbulence.rate_hz = 700.0;
  try {
    check_wind(spec);
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2U);
    EXPECT_TRUE(error.problems()[0].message.starts_with("gust.period_s: "));
    EXPECT_TRUE(error.problems()[1].message.starts_with("turbulence.rate_hz: "));
  }
}

/// Farthest from where it ought to hover, after `from_s`.
double farthest_m(const VehicleSpec& vehicle, const WindSpec& spec, double duration_s) {
  const VehicleModel model = make_model(vehicle);
  Wind wind = make_wind(spec, 8, duration_s);
  VehicleState state = hovering_at(vehicle, {0, 0, 2}, 0.4);
  Tracker tracker = make_tracker(model, state);
  accept(tracker, model, go_to({0, 0, 2}, 0.4), state);
  double farthest = 0.0;
  while (state.tick < ticks(duration_s)) {
    const Environment environment = environment_at(wind, state.tick, state.position_world);
    const RotorVector rotors = track(tracker, model, state);
    const Tick grid = (state.tick / kTicksPerMillisecond + 1) * kTicksPerMillisecond;
    const Tick next = std::min(grid, next_force_change(wind, state.tick));
    state = step(model, state, rotors, environment, next - state.tick);
    farthest = std::max(farthest, (state.position_world - Vector3d(0, 0, 2)).norm());
  }
  return farthest;
}

TEST(Wind, HoverStaysNearUnderGustsTurbulenceAndKicks) {
  WindSpec gusty;
  gusty.gust.amplitude_world_mps = {6, 3, 0};
  WindSpec turbulent;
  turbulent.turbulence.model = TurbulenceModel::mil_f_8785c;
  turbulent.turbulence.wind_6m_mps = 15.4;
  WindSpec kicked;
  kicked.kicks = {30.0, 3.0, 0.03, 0.1};
  for (const Controller controller : {Controller::rpg, Controller::lee}) {
    for (VehicleSpec vehicle : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
      vehicle.controller = controller;
      const std::string name = vehicle.name + " " + std::string(text(controller));
      const double gust = farthest_m(vehicle, gusty, 12.0);
      const double turbulence = farthest_m(vehicle, turbulent, 30.0);
      const double kicks = farthest_m(vehicle, kicked, 30.0);
      std::printf("%s: gust %.3f m, turbulence %.3f m, kicks %.3f m\n", name.c_str(), gust,
                  turbulence, kicks);
      EXPECT_LT(gust, 0.4) << name;
      EXPECT_LT(turbulence, 0.5) << name;
      EXPECT_LT(kicks, 0.4) << name;
      EXPECT_GT(gust, 0.02) << name;
    }
  }
}

}  // namespace
}  // namespace avoidbench
