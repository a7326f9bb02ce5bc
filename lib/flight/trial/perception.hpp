#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "plugin/planner_instance.hpp"
#include "sensing/camera.hpp"
#include "sensing/imu.hpp"
#include "sensing/odometry.hpp"
#include "trial/lidar_sensing.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// Images of one camera at one moment, kept until the planner has seen them.
struct Exposure {
  Tick tick = 0;   ///< the middle of the exposure
  Tick ready = 0;  ///< when the planner may have it
  std::uint32_t camera = 0;
  Pose T_world_camera;  ///< as the odometry believes
  CameraImages images;
};

/// The cameras of one kind, which all expose at the same moments.
struct CameraGroup {
  Camera camera;                   ///< of all mountings, one after the other
  std::uint32_t first_camera = 0;  ///< of the rig
  std::vector<Pose> T_body_cameras;
  Tick period = 0, delay = 0, most_jitter = 0, next_exposure = 0;
  std::int64_t image_index = 0;
  RandomStream jitter_random;
};

/// What the vehicle senses during a trial. All events happen at the same ticks and with the same
/// noise whatever the planner asks for; only images that nobody sees are not made.
struct Perception {
  ImageNeeds image_needs;
  std::vector<CameraGroup> cameras;  ///< one for each kind
  std::uint64_t image_seed = 0;
  std::vector<Exposure> exposures;  ///< oldest first; buffers beyond exposure_count are spare
  std::size_t exposure_count = 0;

  ImuSpec imu;
  bool sees_imu = false;
  Tick imu_period = 0;
  ImuState imu_state;
  RandomStream imu_random;
  std::vector<ImuSample> imu_samples;  ///< that the planner has not seen

  OdometrySpec odometry;
  bool is_perfect = true;  ///< the odometry
  Tick odometry_period = 0, state_delay = 0, plan_period = 0;
  OdometryState odometry_state;
  RandomStream odometry_random;
  std::deque<VehicleState> past;  ///< estimates at plan ticks less the delay, oldest first
  bool sees_states = false;
  std::vector<VehicleState> states;  ///< estimates at the IMU's ticks that the planner has not seen
  LidarSensing lidars;
};

/// At the start of a trial. `needs` are the planner's (AB_INPUT_…).
Perception make_perception(const TrialSpec& spec, std::uint32_t needs, const VehicleState& start);

/// The first tick after `now` at which something is sensed.
Tick next_sensing(const Perception& perception, Tick now);

/// Senses what is due at `truth.tick`.
void sense(Perception& perception, const Scene& scene, const VehicleModel& model,
           const VehicleState& truth, const Environment& environment);

/// What the vehicle's own controller takes for its state: the odometry's estimate, without delay.
VehicleState believed_state(const Perception& perception, const VehicleState& truth);

/// The truth of which the odometry, but for its white noise, says `believed`.
VehicleState truth_believed_as(const Perception& perception, const VehicleState& believed);

/// What the planner sees now. Pixels and points stay the perception's until forget_seen().
PlannerView planner_view(Perception& perception, const VehicleState& truth);

/// Frees the images and sweeps that the planner might have had at `tick`.
void forget_images(Perception& perception, Tick tick);

/// Frees what the last planner_view() showed.
void forget_seen(Perception& perception, Tick now);

}  // namespace avoidbench
