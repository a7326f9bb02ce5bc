#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/plain_rk4.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

struct Manoeuvre {
  VehicleState start;
  RotorVector command;
};

Manoeuvre aggressive() {
  Manoeuvre m;
  m.start.velocity_world = {4, -2, 1};
  m.start.rates_body = {3, -2, 1.5};
  m.start.rotor_speed_radps.resize(4);
  m.start.rotor_speed_radps << 400, 420, 440, 460;
  m.command.resize(4);
  m.command << 600, 650, 620, 610;
  return m;
}

constexpr double kDurationS = 0.5;

plain::Vector17 plain_end(const VehicleSpec& spec, const Manoeuvre& m, int steps) {
  plain::Vector17 y = plain::pack(m.start);
  for (int i = 0; i < steps; ++i) y = plain::step(spec, y, m.command, {}, kDurationS / steps);
  return y;
}

VehicleState library_end(const VehicleModel& model, const Manoeuvre& m, int steps) {
  VehicleState state = m.start;
  for (int i = 0; i < steps; ++i) state = step_by(model, state, m.command, {}, kDurationS / steps);
  return state;
}

TEST(Convergence, PlainRk4HasThePublishedErrors) {
  const VehicleSpec spec = flat_hummingbird();
  const Manoeuvre m = aggressive();
  const plain::Vector17 exact = plain_end(spec, m, 50000);
  const double expected[] = {2.364e-6, 1.339e-7, 7.97e-9, 4.86e-10};
  for (int i = 0; i < 4; ++i) {
    const double error = (plain_end(spec, m, 125 << i) - exact).head<3>().norm();
    EXPECT_NEAR(error, expected[i], 0.02 * expected[i]);
  }
}

TEST(Convergence, LibraryIsFourthOrderAndAgreesWithThePlainEquations) {
  for (VehicleSpec spec : {flat_hummingbird(), hummingbird_spec()}) {
    spec.linear_drag_kgps = {0.1, 0.2, 0.3};
    spec.quadratic_drag_kgpm = {0.01, 0.02, 0.03};
    spec.rotor_axial_drag_coefficient_kg = 2e-5;
    const VehicleModel model = make_model(spec);
    const Manoeuvre m = aggressive();
    const plain::Vector17 exact = plain_end(spec, m, 50000);
    std::vector<double> errors;
    for (int i = 0; i < 4; ++i) {
      const VehicleState end = library_end(model, m, 125 << i);
      errors.push_back((end.position_world - exact.head<3>()).norm());
      EXPECT_NEAR(end.q_world_body.norm(), 1.0, 1e-15);
    }
    EXPECT_LT(errors[0], 2.5e-6) << spec.name;
    for (std::size_t i = 0; i + 2 < errors.size(); ++i) {
      EXPECT_NEAR(errors[i] / errors[i + 1], 16.0, 0.15 * 16.0) << spec.name << ' ' << i;
    }
    EXPECT_LT((plain::pack(library_end(model, m, 5000)) - exact).lpNorm<Eigen::Infinity>(), 1e-8);
  }
}

TEST(Convergence, IsFourthOrderAlsoWithRotorsGoingBothWays) {
  const VehicleModel model = make_model(hummingbird_spec());
  Manoeuvre m = aggressive();
  m.command << 600, 300, 620, 200;
  const VehicleState exact = library_end(model, m, 20000);
  const double coarse = (library_end(model, m, 125).position_world - exact.position_world).norm();
  const double fine = (library_end(model, m, 250).position_world - exact.position_world).norm();
  EXPECT_NEAR(coarse / fine, 16.0, 0.15 * 16.0);
}

TEST(Convergence, WindAndForceEnterAsInThePlainEquations) {
  VehicleSpec spec = hummingbird_spec();
  spec.rotors[0].position_body_m = {0.2, -0.03, 0.05};
  spec.rotors[3].position_body_m = {-0.02, -0.15, -0.04};
  spec.linear_drag_kgps = {0.1, 0.2, 0.3};
  spec.rotor_axial_drag_coefficient_kg = 3e-5;
  const VehicleModel model = make_model(spec);
  Environment environment;
  environment.wind_world_mps = {3, -1, 2};
  environment.force_world_n = {0.5, 1, -0.3};
  VehicleState state = aggressive().start;
  state.q_world_body = Eigen::Quaterniond(0.5, 0.1, -0.6, 0.3).normalized();
  const plain::Vector17 rate =
      plain::derivative(spec, plain::pack(state), state.rotor_speed_radps, environment);
  EXPECT_LT((acceleration_world(model, state, environment) - rate.segment<3>(3)).norm(), 1e-12);
  EXPECT_LT((angular_acceleration_body(model, state, environment) - rate.segment<3>(10)).norm(),
            1e-10);
}

}  // namespace
}  // namespace avoidbench
