#include "control/mixer.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "support/vehicles.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

TEST(Mixer, FourRotorsComeBack) {
  const VehicleModel model = make_model(hummingbird_spec());
  RandomStream random(1);
  for (int trial = 0; trial < 200; ++trial) {
    RotorVector thrust(4);
    for (int i = 0; i < 4; ++i) thrust[i] = random.uniform(0.0, model.max_rotor_thrust_n);
    const Vector4d w = wrench(model, thrust);
    EXPECT_LT((mix_thrusts(model, w[0], w.tail<3>()) - thrust).norm(), 1e-12);
    const RotorVector speeds = mix(model, w[0], w.tail<3>());
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(speeds[i] * speeds[i] * model.spec.thrust_coefficient_ns2, thrust[i], 1e-12);
    }
  }
}

TEST(Mixer, IsTheQuadrotorsClosedForm) {
  const VehicleModel model = make_model(hummingbird_spec());
  const double F = 7.0, tx = 0.1, ty = -0.05, tz = 0.01, l = 0.17, km = 0.016;
  const RotorVector f = mix_thrusts(model, F, {tx, ty, tz});
  EXPECT_NEAR(f[0], F / 4 - ty / (2 * l) + tz / (4 * km), 1e-13);
  EXPECT_NEAR(f[1], F / 4 + tx / (2 * l) - tz / (4 * km), 1e-13);
  EXPECT_NEAR(f[2], F / 4 + ty / (2 * l) + tz / (4 * km), 1e-13);
  EXPECT_NEAR(f[3], F / 4 - tx / (2 * l) - tz / (4 * km), 1e-13);
}

TEST(Mixer, SixRotorsGiveTheWrenchWithTheLeastSquares) {
  const VehicleModel model = make_model(firefly_spec());
  const Vector3d torque(0.2, -0.3, 0.05);
  const RotorVector thrust = mix_thrusts(model, 15.0, torque);
  const Vector4d w = wrench(model, thrust);
  EXPECT_NEAR(w[0], 15.0, 1e-12);
  EXPECT_LT((w.tail<3>() - torque).norm(), 1e-12);
  // Every other solution differs by a vector of the null space, across which the least one is.
  const Eigen::Matrix<double, 4, 6> A = model.allocation.leftCols<6>();
  const Eigen::Matrix<double, 6, 1> any = Eigen::Matrix<double, 6, 1>::LinSpaced(1.0, 3.0);
  const Eigen::Matrix<double, 6, 1> null =
      any - A.transpose() * (A * A.transpose()).inverse() * (A * any);
  EXPECT_GT(null.norm(), 0.1);
  EXPECT_NEAR(null.dot(thrust), 0.0, 1e-12);
}

TEST(Mixer, SaturationGivesUpYawFirst) {
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    const double hover_n = spec.mass_kg * spec.gravity_mps2;
    const Vector3d torque(0.1, -0.05, 5.0);
    const Vector4d w = wrench(model, mix_thrusts(model, hover_n, torque));
    EXPECT_NEAR(w[0], hover_n, 1e-12);
    EXPECT_NEAR(w[1], torque.x(), 1e-12);
    EXPECT_NEAR(w[2], torque.y(), 1e-12);
    EXPECT_GT(w[3], 0.0);
    EXPECT_LT(w[3], 5.0);
  }
}

TEST(Mixer, ThrustMovesToKeepRollAndPitch) {
  const VehicleModel model = make_model(hummingbird_spec());
  const Vector3d torque(0.3, 0.2, 0.0);
  const Vector4d low = wrench(model, mix_thrusts(model, 0.0, torque));
  EXPECT_NEAR(low[1], 0.3, 1e-12);
  EXPECT_NEAR(low[2], 0.2, 1e-12);
  EXPECT_NEAR(low[0], 4 * 0.3 / (2 * 0.17), 1e-12);
  const double all_n = 4 * model.max_rotor_thrust_n;
  const Vector4d high = wrench(model, mix_thrusts(model, all_n, torque));
  EXPECT_NEAR(high[1], 0.3, 1e-12);
  EXPECT_NEAR(high[2], 0.2, 1e-12);
  EXPECT_NEAR(high[0], all_n - 4 * 0.3 / (2 * 0.17), 1e-12);
}

TEST(Mixer, AnyDemandStaysWithinLimitsAndKeepsTheTiltsDirection) {
  RandomStream random(2);
  for (const VehicleSpec& spec : {hummingbird_spec(), firefly_spec()}) {
    const VehicleModel model = make_model(spec);
    for (int trial = 0; trial < 2000; ++trial) {
      const double thrust_n = random.uniform(-10.0, 60.0);
      const double x = random.uniform(-5.0, 5.0);
      const double y = random.uniform(-5.0, 5.0);
      const double z = random.uniform(-1.0, 1.0);
      const RotorVector thrust = mix_thrusts(model, thrust_n, {x, y, z});
      EXPECT_GE(thrust.minCoeff(), 0.0);
      EXPECT_LE(thrust.maxCoeff(), model.max_rotor_thrust_n);
      const Vector4d w = wrench(model, thrust);
      EXPECT_NEAR(w[1] * y - w[2] * x, 0.0, 1e-10);
      EXPECT_GE(w[1] * x + w[2] * y, 0.0);
      EXPECT_GE(w[3] * z, -1e-12);
    }
  }
}

}  // namespace
}  // namespace avoidbench
