#include "sensing/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {
namespace {

VehicleState at(double x_m, double time_s) {
  VehicleState state;
  state.tick = ticks(time_s);
  state.position_world = {x_m, 1.0, 2.0};
  state.velocity_world = {3.0, 0.0, 0.0};
  state.q_world_body = yaw_rotation(0.3);
  return state;
}

TEST(Odometry, WithoutErrorsItSaysTheTruth) {
  EXPECT_TRUE(is_perfect(OdometrySpec{}));
  RandomStream random(1);
  OdometryState state = make_odometry({}, at(0.0, 0.0), random);
  for (int i = 1; i <= 100; ++i) advance(state, {}, at(0.1 * i, 0.01 * i), 0.01, random);
  const VehicleState estimate = estimated(state, at(10.03, 1.003));
  EXPECT_TRUE(estimate.position_world.isApprox(at(10.03, 0).position_world, 1e-12));
  EXPECT_TRUE(estimate.q_world_body.isApprox(at(0, 0).q_world_body, 1e-12));
  EXPECT_EQ(estimate.velocity_world, at(0, 0).velocity_world);
}

TEST(Odometry, WhiteNoiseHasItsDeviations) {
  OdometrySpec odometry;
  odometry.position_sigma_m = 0.05;
  odometry.velocity_sigma_mps = 0.2;
  odometry.attitude_sigma_deg = 1.0;
  odometry.rates_sigma_radps = 0.03;
  EXPECT_FALSE(is_perfect(odometry));
  RandomStream random(2);
  const VehicleState truth = at(0.0, 0.0);
  OdometryState state = make_odometry(odometry, truth, random);
  double position = 0.0, velocity = 0.0, attitude = 0.0, rates = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    advance(state, odometry, truth, 0.005, random);
    const VehicleState estimate = estimated(state, truth);
    position += (estimate.position_world - truth.position_world).squaredNorm();
    velocity += (estimate.velocity_world - truth.velocity_world).squaredNorm();
    attitude += std::pow(estimate.q_world_body.angularDistance(truth.q_world_body), 2.0);
    rates += (estimate.rates_body - truth.rates_body).squaredNorm();
  }
  const auto sigma = [](double squares) { return std::sqrt(squares / (3.0 * kCount)); };
  EXPECT_NEAR(sigma(position), 0.05, 0.001);
  EXPECT_NEAR(sigma(velocity), 0.2, 0.004);
  EXPECT_NEAR(sigma(attitude), 1.0 * math::kDegree, 0.02 * math::kDegree);
  EXPECT_NEAR(sigma(rates), 0.03, 0.0006);
}

TEST(Odometry, DriftGrowsWithTheRootOfTheWayAndTheTime) {
  OdometrySpec odometry;
  odometry.position_drift_ratio = 0.02;
  odometry.yaw_drift_deg_per_sqrt_s = 0.0;
  constexpr int kFlights = 2000, kSteps = 50;
  double early = 0.0, late = 0.0;
  for (int flight = 0; flight < kFlights; ++flight) {
    RandomStream random(static_cast<std::uint64_t>(flight));
    OdometryState state = make_odometry(odometry, at(0.0, 0.0), random);
    for (int i = 1; i <= kSteps; ++i) {
      const VehicleState truth = at(0.5 * i, 0.1 * i);
      advance(state, odometry, truth, 0.1, random);
      const double error = (estimated(state, truth).position_world - truth.position_world).y();
      if (i == 2) early += error * error;
      if (i == kSteps) late += error * error;
    }
  }
  EXPECT_NEAR(std::sqrt(early / kFlights), 0.02, 0.001);                   // after 1 m
  EXPECT_NEAR(std::sqrt(late / kFlights), 0.02 * std::sqrt(25.0), 0.005);  // after 25 m

  odometry.position_drift_ratio = 0.0;
  odometry.yaw_drift_deg_per_sqrt_s = 0.5;
  double yaw = 0.0;
  for (int flight = 0; flight < kFlights; ++flight) {
    RandomStream random(static_cast<std::uint64_t>(flight));
    OdometryState state = make_odometry(odometry, at(0.0, 0.0), random);
    for (int i = 1; i <= 40; ++i) advance(state, odometry, at(0.0, 0.1 * i), 0.1, random);
    yaw += state.yaw_drift_rad * state.yaw_drift_rad;
  }
  EXPECT_NEAR(std::sqrt(yaw / kFlights), 0.5 * 2.0 * math::kDegree, 0.06 * math::kDegree);  // 4 s
}

TEST(Odometry, YawDriftTurnsTheWayFromThenOn) {
  OdometryState state;
  state.anchor_true_world = state.anchor_world = at(0.0, 0.0).position_world;
  state.yaw_drift_rad = 0.5 * math::kPi;
  const VehicleState estimate = estimated(state, at(2.0, 1.0));
  EXPECT_TRUE(estimate.position_world.isApprox(Eigen::Vector3d(0.0, 3.0, 2.0), 1e-12));
  EXPECT_TRUE(estimate.velocity_world.isApprox(Eigen::Vector3d(0.0, 3.0, 0.0), 1e-12));
  EXPECT_NEAR(yaw_of(estimate.q_world_body), 0.3 + 0.5 * math::kPi, 1e-12);
}

}  // namespace
}  // namespace avoidbench
