#pragma once

#include <array>
#include <memory>
#include <vector>

#include "avoidbench/planner.h"

namespace ros_shim {

/// A world of the nodes' own, upright as avoidbench's: missions and observations go into it,
/// commands come out of it.
class NodesWorld {
 public:
  /// Where its origin lies in avoidbench's world, m, and how it is turned about z, rad.
  NodesWorld(const std::array<double, 3>& origin_m, double yaw_rad);

  /// The mission, its box the smallest that holds the turned one. Its goals live as long as this.
  ab_mission of(const ab_mission& mission);
  /// What the nodes see; until the next call. References and tracks, which no topic has, are left
  /// out.
  const ab_observation& of(const ab_observation& seen);
  /// The command in avoidbench's world; its points until the next call.
  ab_command back(const ab_command& command);

 private:
  using Vec3 = double[3];
  void place(const Vec3& from, Vec3& to) const;      ///< a place into the nodes' world
  void direction(const Vec3& from, Vec3& to) const;  ///< a velocity, likewise
  void turn(double (&q_world_x)[4]) const;           ///< a quaternion, likewise
  void place_back(Vec3& at) const;
  void direction_back(Vec3& at) const;
  ab_state of(const ab_state& state) const;
  template <class Image>
  Image of_camera(const Image& image) const;

  /// Copies of what an observation points to, and the pointers to them.
  template <class T>
  struct Copies {
    std::vector<T> values;
    std::vector<const T*> pointers;
    const T* const* point();
  };

  Vec3 origin_m_{};
  double yaw_rad_, cos_, sin_, half_cos_, half_sin_;
  std::vector<double> goals_;
  std::vector<ab_point> points_;
  ab_observation seen_{};
  ab_state state_{};
  Copies<ab_state> states_;
  Copies<ab_depth_image> depth_;
  Copies<ab_picture> color_, left_, right_;
  Copies<ab_stereo_pair> stereo_;
  Copies<ab_cloud> clouds_;
};

}  // namespace ros_shim
