#pragma once

#include <Eigen/Core>
#include <array>

#include "base/fields.hpp"
#include "base/random.hpp"
#include "base/ticks.hpp"
#include "vehicle/dynamics.hpp"

namespace avoidbench {

/// Noise of an inertial measurement unit: white noise, a bias that wanders as a first-order
/// Gauss-Markov process, and a constant bias drawn at power-on; equal on the three axes. The model
/// and the defaults (an ADIS16448) are RotorS' (gazebo_imu_plugin.cpp). All zero: a perfect unit.
struct ImuSpec {
  double gyro_noise_density = 3.394e-4;
  double gyro_random_walk = 3.8785e-5;
  double gyro_bias_time_s = 1000.0;
  double gyro_turn_on_bias_radps = 0.0087;
  double accelerometer_noise_density = 0.004;
  double accelerometer_random_walk = 0.006;
  double accelerometer_bias_time_s = 300.0;
  double accelerometer_turn_on_bias_mps2 = 0.196;
  std::array<double, 3> position_body_m{0.0, 0.0, 0.0};
  double rate_hz = 200.0;
};

template <class Visitor, ConstOr<ImuSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("gyro_noise_density", s.gyro_noise_density, Range{0, 1}, "White noise, rad/s/√Hz.");
  v.field("gyro_random_walk", s.gyro_random_walk, Range{0, 1},
          "Noise that drives the bias, rad/s²/√Hz.");
  v.field("gyro_bias_time_s", s.gyro_bias_time_s, Range{1e-3, 1e6},
          "Correlation time of the bias.");
  v.field("gyro_turn_on_bias_radps", s.gyro_turn_on_bias_radps, Range{0, 1},
          "Standard deviation of the constant bias.");
  v.field("accelerometer_noise_density", s.accelerometer_noise_density, Range{0, 10},
          "White noise, m/s²/√Hz.");
  v.field("accelerometer_random_walk", s.accelerometer_random_walk, Range{0, 10},
          "Noise that drives the bias, m/s³/√Hz.");
  v.field("accelerometer_bias_time_s", s.accelerometer_bias_time_s, Range{1e-3, 1e6},
          "Correlation time of the bias.");
  v.field("accelerometer_turn_on_bias_mps2", s.accelerometer_turn_on_bias_mps2, Range{0, 10},
          "Standard deviation of the constant bias.");
  v.field("rate_hz", s.rate_hz, Range{1, 4000}, "Samples per second.");
  v.field("position_body_m", s.position_body_m, Range{-1, 1},
          "Where it sits, from the centre of gravity, body frame (FLU).");
}

/// The biases as they are now; wandering ones start at zero.
struct ImuState {
  Eigen::Vector3d gyro_turn_on = Eigen::Vector3d::Zero(), gyro_bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_turn_on = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();
};

struct ImuSample {
  Tick tick = 0;
  Eigen::Vector3d rates_body_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_body_mps2 = Eigen::Vector3d::Zero();  ///< (0, 0, g) at rest
};

/// The unit just powered on: draws the turn-on biases (six normals).
ImuState make_imu(const ImuSpec& imu, RandomStream& random);

/// Turns a true sample into a measured one and moves the biases on by `dt_s`, the time since the
/// sample before (the sampling period: white noise is of density / √dt). Exact for any dt. Draws
/// twelve normals.
ImuSample add_imu_noise(const ImuSpec& imu, ImuState& state, const ImuSample& truth, double dt_s,
                        RandomStream& random);

/// What the unit truly feels: the body's rates, and acceleration less gravity where it sits.
ImuSample true_imu(const ImuSpec& imu, const VehicleModel& model, const VehicleState& vehicle,
                   const Environment& environment);

/// The measured sample: true_imu(), then add_imu_noise().
ImuSample sense_imu(const ImuSpec& imu, ImuState& state, const VehicleModel& model,
                    const VehicleState& vehicle, const Environment& environment, double dt_s,
                    RandomStream& random);

}  // namespace avoidbench
