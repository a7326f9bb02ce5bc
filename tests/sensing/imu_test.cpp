#include "sensing/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/spec_json.hpp"
#include "control/tracking.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

struct Spread {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  void add(const Vector3d& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  double sigma() const { return std::sqrt(squares / count); }
};

/// A measured standard deviation is within three of its own of the true one.
void expect_sigma(const Spread& spread, double sigma) {
  EXPECT_NEAR(spread.sigma(), sigma, 3 * sigma / std::sqrt(2.0 * spread.count));
  EXPECT_NEAR(spread.sum / spread.count, 0.0, 3 * sigma / std::sqrt(spread.count));
}

TEST(Imu, WhiteNoiseHasItsDensity) {
  ImuSpec imu;
  imu.gyro_random_walk = imu.accelerometer_random_walk = 0;
  RandomStream random(3);
  ImuState state;
  Spread gyro, accelerometer;
  for (int i = 0; i < 333334; ++i) {
    const ImuSample sample = add_imu_noise(imu, state, {}, 1e-3, random);
    gyro.add(sample.rates_body_radps);
    accelerometer.add(sample.specific_force_body_mps2);
  }
  expect_sigma(gyro, 3.394e-4 / std::sqrt(1e-3));
  expect_sigma(accelerometer, 0.126491);
  EXPECT_NEAR(3.394e-4 / std::sqrt(1e-3), 0.010733, 1e-6);
}

TEST(Imu, BiasSpreadsAsAGaussMarkovProcess) {
  const ImuSpec imu;
  Spread gyro_60s, accelerometer_60s, gyro_late, accelerometer_late;
  for (std::uint64_t unit = 0; unit < 3000; ++unit) {
    RandomStream random(stream_seed(11, unit));
    ImuState state;
    for (int i = 0; i < 20; ++i) add_imu_noise(imu, state, {}, 3.0, random);
    gyro_60s.add(state.gyro_bias);
    accelerometer_60s.add(state.accelerometer_bias);
    for (int i = 0; i < 40; ++i) add_imu_noise(imu, state, {}, 200.0, random);
    gyro_late.add(state.gyro_bias);
    accelerometer_late.add(state.accelerometer_bias);
  }
  expect_sigma(gyro_60s, 2.9164e-4);
  expect_sigma(accelerometer_60s, 0.0421933);
  expect_sigma(gyro_late, 8.6726e-4);
  expect_sigma(accelerometer_late, 0.0734847);
}

TEST(Imu, TurnOnBiasIsDrawnOnce) {
  const ImuSpec imu;
  Spread gyro, accelerometer;
  RandomStream random(5);
  for (int i = 0; i < 20000; ++i) {
    const ImuState state = make_imu(imu, random);
    gyro.add(state.gyro_turn_on);
    accelerometer.add(state.accelerometer_turn_on);
  }
  expect_sigma(gyro, 0.0087);
  expect_sigma(accelerometer, 0.196);
}

/// Allan deviation over clusters of `size` samples.
double allan_deviation(const std::vector<double>& samples, std::size_t size) {
  std::vector<double> means;
  for (std::size_t i = 0; i + size <= samples.size(); i += size) {
    double sum = 0;
    for (std::size_t j = 0; j < size; ++j) sum += samples[i + j];
    means.push_back(sum / static_cast<double>(size));
  }
  double squares = 0;
  for (std::size_t i = 0; i + 1 < means.size(); ++i)
    squares += std::pow(means[i + 1] - means[i], 2);
  return std::sqrt(0.5 * squares / static_cast<double>(means.size() - 1));
}

TEST(Imu, AllanDeviationFallsWithTheRootOfTime) {
  const ImuSpec imu;
  RandomStream random(9);
  ImuState state = make_imu(imu, random);
  std::vector<double> gyro;
  for (int i = 0; i < 500000; ++i) {
    gyro.push_back(add_imu_noise(imu, state, {}, 1e-3, random).rates_body_radps.x());
  }
  const double at_10ms = allan_deviation(gyro, 10), at_1s = allan_deviation(gyro, 1000);
  EXPECT_NEAR(at_10ms, 3.394e-4 / std::sqrt(0.01), 0.02 * at_10ms);
  EXPECT_NEAR(std::log10(at_1s / at_10ms) / 2, -0.5, 0.04);
}

TEST(Imu, FeelsGravityAtRestAndNothingInFreeFall) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 0}, 1.0);
  EXPECT_LT((true_imu({}, model, state, {}).specific_force_body_mps2 - Vector3d(0, 0, 9.81)).norm(),
            1e-12);
  state.rotor_speed_radps.setZero();
  EXPECT_LT(true_imu({}, model, state, {}).specific_force_body_mps2.norm(), 1e-12);
}

TEST(Imu, FeelsItsLeverArm) {
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 0}, 0.0);
  state.rates_body = {0, 0, 3};
  ImuSpec imu;
  imu.position_body_m = {0.1, 0, 0};
  const Vector3d felt = true_imu(imu, model, state, {}).specific_force_body_mps2;
  EXPECT_NEAR(felt.x(), -0.9, 1e-12);  // towards the axis, ω² r
  EXPECT_NEAR(felt.y(), 0.1 * angular_acceleration_body(model, state, {}).z(), 1e-12);
}

TEST(Imu, IntegratesToTheFlight) {
  // A perfect unit's samples, summed up, are the flight's velocity.
  const VehicleModel model = make_model(hummingbird_spec());
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.4);
  Tracker tracker = make_tracker(model, state);
  Command command;
  command.velocity_world = {2, 1, 0.5};
  command.yaw_rad = -0.3;
  accept(tracker, model, command, state);
  Vector3d velocity = Vector3d::Zero();
  Eigen::Quaterniond q = state.q_world_body;
  for (int i = 0; i < 2000; ++i) {
    const RotorVector rotors = track(tracker, model, state);
    const VehicleState next = step(model, state, rotors, {}, kTicksPerMillisecond);
    const ImuSample before = true_imu({}, model, state, {}), after = true_imu({}, model, next, {});
    const Vector3d turned = 0.5e-3 * (before.rates_body_radps + after.rates_body_radps);
    const Eigen::Quaterniond q_next =
        (q * Eigen::Quaterniond(1, turned.x() / 2, turned.y() / 2, turned.z() / 2)).normalized();
    velocity +=
        0.5e-3 * (q * before.specific_force_body_mps2 + q_next * after.specific_force_body_mps2) -
        Vector3d(0, 0, 9.81e-3);
    q = q_next;
    state = next;
  }
  EXPECT_LT((velocity - state.velocity_world).norm(), 1e-3);
  EXPECT_GT(state.velocity_world.norm(), 2.0);
}

TEST(Imu, SameSeedSameSamples) {
  const ImuSpec imu;
  const VehicleModel model = make_model(hummingbird_spec());
  const VehicleState vehicle = hovering_at(model.spec, {0, 0, 0}, 0.0);
  RandomStream one = stream(1, "imu"), two = stream(1, "imu"), three = stream(2, "imu");
  ImuState a = make_imu(imu, one), b = make_imu(imu, two), c = make_imu(imu, three);
  const ImuSample x = sense_imu(imu, a, model, vehicle, {}, 1e-3, one);
  const ImuSample y = sense_imu(imu, b, model, vehicle, {}, 1e-3, two);
  const ImuSample z = sense_imu(imu, c, model, vehicle, {}, 1e-3, three);
  EXPECT_EQ(x.rates_body_radps, y.rates_body_radps);
  EXPECT_EQ(x.specific_force_body_mps2, y.specific_force_body_mps2);
  EXPECT_NE(x.rates_body_radps, z.rates_body_radps);
  EXPECT_EQ(spec_to_json(spec_from_json<ImuSpec>(spec_to_json(imu))), spec_to_json(imu));
}

}  // namespace
}  // namespace avoidbench
