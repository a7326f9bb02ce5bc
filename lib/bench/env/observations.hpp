#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "env/env_spec.hpp"
#include "plugin/planner_instance.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// Numbers of one flight in EnvArrays::state, ::goal, ::pose and in each sample of ::imu.
inline constexpr std::size_t kStateWidth = 9, kGoalWidth = 3, kPoseWidth = 14, kImuWidth = 7;

/// A lidar of the rig.
struct LidarShape {
  std::size_t shots = 0;  ///< of a sweep
  double period_s = 0.0;  ///< of sweeps
  double min_range_m = 0.0, max_range_m = 0.0;

  friend bool operator==(const LidarShape&, const LidarShape&) = default;
};

/// Sizes of what one flight sees.
struct ViewShape {
  std::size_t cameras = 0, height_px = 0, width_px = 0;
  std::size_t imu_samples = 0;  ///< the most between two plans
  double min_range_m = 0.0, max_range_m = 0.0;
  std::vector<LidarShape> lidars = {};
  /// Of all lidars: the most shots, and the widest range.
  LidarShape widest_lidar = {};

  std::size_t pixels() const { return cameras * height_px * width_px; }
  std::size_t shots() const { return lidars.size() * widest_lidar.shots; }
};

/// Throws InputError where the cameras' pictures have different sizes.
ViewShape view_shape(const TrialSpec& spec);

/// Where one flight's, or of N flights the first's, observation is written; null: not wanted. All
/// is what the vehicle believes, as planners see it.
struct ViewArrays {
  float* depth = nullptr;          ///< cameras × height × width, see DepthEncoding
  std::uint8_t* stereo = nullptr;  ///< cameras × 2 (left, right) × height × width, grey
  std::uint8_t* color = nullptr;   ///< cameras × height × width × 3, RGB
  /// lidars × shots × 3: what each shot of the newest sweep met, in the lidar's frame, m; zeros
  /// where it came back with nothing, and behind the shots of a lidar that has fewer.
  float* points = nullptr;
  /// lidars × shots: how far off that is, written as depth is: a shot that came back with nothing
  /// has the greatest range, and 0 is where nothing is known.
  float* ranges = nullptr;
  /// imu_samples × 7: time_s, rates_body_radps, specific_force_body_mps2; the newest last, and
  /// zeros before the first where there are fewer.
  float* imu = nullptr;
  float* state =
      nullptr;            ///< velocity in the heading frame, up in the body frame, rates_body_radps
  float* goal = nullptr;  ///< from the vehicle to the goal in the heading frame, m
  /// time_s, position_world_m, velocity_world_mps, q_world_body (w, x, y, z), rates_body_radps.
  double* pose = nullptr;
};

/// The arrays of flight `index`.
ViewArrays at(const ViewArrays& arrays, const ViewShape& shape, std::size_t index);

/// Writes what `view` shows. A camera without a new image, and a lidar without a new sweep, keeps
/// what is there.
void write_view(const PlannerView& view, const Eigen::Vector3d& goal_world, const ViewShape& shape,
                DepthEncoding encoding, const ViewArrays& to);

/// Writes what is seen before the first image and sweep: nothing is known.
void clear_images(const ViewShape& shape, const ViewArrays& to);

}  // namespace avoidbench
