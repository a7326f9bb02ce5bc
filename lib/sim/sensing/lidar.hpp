#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/ticks.hpp"
#include "render/scene.hpp"
#include "sensing/lidar_spec.hpp"

namespace avoidbench {

/// What a shot met.
struct LidarPoint {
  Eigen::Vector3f position_lidar = Eigen::Vector3f::Zero();  ///< [m]
  float time_s = 0.0F;     ///< of the shot, after the sweep's end: at most 0
  float intensity = 0.0F;  ///< reflectance times the cosine of incidence, [0, 1]
};

/// What a sweep saw, in the order of its shots. In the lidar's frame: that of the sweep's end where
/// the lidar de-skews, else each in that of its own shot.
struct LidarSweep {
  std::vector<LidarPoint> points;
  std::vector<Eigen::Vector3f> misses;  ///< unit directions of shots that came back with nothing
};

/// How the lidar (FLU) moves for a while, in truth and as the odometry believes; in between evenly.
/// Ticks are counted from the sweep's start.
struct LidarMotion {
  Tick from = 0, to = 0;
  Pose T_world_from, T_world_to;
  Pose T_believed_from, T_believed_to;
};

/// The motion of a lidar that rests for a whole sweep, and whose odometry is right.
LidarMotion at_rest(const LidarSpec& lidar, const Pose& T_world_lidar);

/// A lidar in the middle of its sweep. Not for two threads at once.
class Lidar {
 public:
  explicit Lidar(const LidarSpec& spec);
  ~Lidar();
  Lidar(Lidar&&) noexcept;
  Lidar& operator=(Lidar&&) noexcept;

  /// Begins sweep `index`, from 0; nothing is fired before the first. Its noise follows from
  /// `seed`, whatever was asked before.
  void begin_sweep(std::int64_t index, std::uint64_t seed);

  /// Fires the shots of (from, to]: shot i of n is fired (i + 1) / n of the period after the start.
  /// The scene stands as it is.
  void fire(const Scene& scene, const LidarMotion& motion);

  /// What the sweep saw, from this pose at its end. Buffers of `sweep` are used again.
  void end_sweep(const Pose& T_believed_lidar, LidarSweep& sweep);

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
