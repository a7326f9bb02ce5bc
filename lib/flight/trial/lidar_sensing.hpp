#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "avoidbench/planner.h"
#include "plugin/planner_instance.hpp"
#include "sensing/lidar.hpp"
#include "trial/trial_spec.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// A sweep of one lidar, kept until the planner has seen it.
struct SeenSweep {
  Tick end = 0;
  Tick ready = 0;  ///< when the planner may have it
  std::uint32_t lidar = 0;
  Pose T_world_lidar;  ///< at the end, as the odometry believes
  std::vector<ab_lidar_point> points;
  std::vector<Eigen::Vector3f> misses_lidar;
};

/// A lidar on the vehicle, in the middle of its sweep.
struct MountedLidar {
  std::optional<Lidar> lidar;  ///< nothing: nobody sees it
  Pose T_body_lidar;
  Tick period = 0, delay = 0;
  std::int64_t sweep = 0;
};

/// What the lidars of a rig sense during a trial. Sweeps end at the same ticks whatever the planner
/// asks for; shots that nobody sees are not fired.
struct LidarSensing {
  bool is_seen = false;  ///< there are lidars, and the planner declares points
  std::uint64_t seed = 0;
  std::vector<MountedLidar> lidars;
  Pose T_world_body, T_believed_body;  ///< at `tick`
  Tick tick = 0;
  std::vector<SeenSweep> sweeps;  ///< oldest first
  LidarSweep buffer;
};

/// At the start of a trial, where truth and belief are alike or not.
LidarSensing make_lidar_sensing(const SensorSpec& sensor, std::uint32_t needs, std::uint64_t seed,
                                const VehicleState& truth, const VehicleState& believed);

/// The first tick after `now` at which a sweep ends.
Tick next_sweep_end(const LidarSensing& sensing, Tick now);

/// Fires what is due since the last call; the vehicle moved evenly since then.
void sense_points(LidarSensing& sensing, const Scene& scene, const VehicleState& truth,
                  const VehicleState& believed);

/// What the planner sees at `now`, newest first; points stay the sensing's until forget_sweeps().
std::vector<CloudView> cloud_views(const LidarSensing& sensing, Tick now);

/// Frees the sweeps that the planner might have had at `now`.
void forget_sweeps(LidarSensing& sensing, Tick now);

/// The rig's lidars as planners get them.
std::vector<LidarSetup> lidar_setups(const SensorSpec& sensor);

}  // namespace avoidbench
