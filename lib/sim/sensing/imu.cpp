#include "sensing/imu.hpp"

#include <cmath>

#include "base/math.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// One after the other: the order in which a call's arguments are evaluated is not fixed.
Vector3d normals(RandomStream& random) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return {x, y, z};
}

/// The bias `dt_s` later: b exp(-dt/τ) plus a draw of variance σ² τ/2 (1 - exp(-2 dt/τ)).
Vector3d wandered(const Vector3d& bias, double random_walk, double time_s, double dt_s,
                  RandomStream& random) {
  const double keep = math::exp(-dt_s / time_s);
  const double sigma = random_walk * std::sqrt(0.5 * time_s * (1.0 - keep * keep));
  return keep * bias + sigma * normals(random);
}

}  // namespace

ImuState make_imu(const ImuSpec& imu, RandomStream& random) {
  ImuState state;
  state.gyro_turn_on = imu.gyro_turn_on_bias_radps * normals(random);
  state.accelerometer_turn_on = imu.accelerometer_turn_on_bias_mps2 * normals(random);
  return state;
}

ImuSample add_imu_noise(const ImuSpec& imu, ImuState& state, const ImuSample& truth, double dt_s,
                        RandomStream& random) {
  // A density over the bandwidth of a sample: the shorter it is, the noisier.
  const double white = 1.0 / std::sqrt(dt_s);
  state.gyro_bias =
      wandered(state.gyro_bias, imu.gyro_random_walk, imu.gyro_bias_time_s, dt_s, random);
  state.accelerometer_bias = wandered(state.accelerometer_bias, imu.accelerometer_random_walk,
                                      imu.accelerometer_bias_time_s, dt_s, random);
  ImuSample sample = truth;
  sample.rates_body_radps += state.gyro_turn_on + state.gyro_bias;
  sample.rates_body_radps += imu.gyro_noise_density * white * normals(random);
  sample.specific_force_body_mps2 += state.accelerometer_turn_on + state.accelerometer_bias;
  sample.specific_force_body_mps2 += imu.accelerometer_noise_density * white * normals(random);
  return sample;
}

ImuSample true_imu(const ImuSpec& imu, const VehicleModel& model, const VehicleState& vehicle,
                   const Environment& environment) {
  const Vector3d arm = to_eigen(imu.position_body_m);
  const Vector3d& rates = vehicle.rates_body;
  const Vector3d turning = angular_acceleration_body(model, vehicle, environment);
  // What an accelerometer feels: the acceleration without gravity's part.
  const Vector3d felt_world =
      acceleration_world(model, vehicle, environment) + Vector3d(0.0, 0.0, model.spec.gravity_mps2);
  ImuSample sample;
  sample.tick = vehicle.tick;
  sample.rates_body_radps = rates;
  sample.specific_force_body_mps2 = vehicle.q_world_body.conjugate() * felt_world +
                                    // Off the centre of gravity it also feels angular acceleration
                                    // and the centripetal one.
                                    turning.cross(arm) + rates.cross(rates.cross(arm));
  return sample;
}

ImuSample sense_imu(const ImuSpec& imu, ImuState& state, const VehicleModel& model,
                    const VehicleState& vehicle, const Environment& environment, double dt_s,
                    RandomStream& random) {
  return add_imu_noise(imu, state, true_imu(imu, model, vehicle, environment), dt_s, random);
}

}  // namespace avoidbench
