#pragma once

#include <vector>

#include "depth_view.hpp"
#include "point_view.hpp"
#include "vector3.hpp"

namespace reactive {

/// What the last few depth images of each camera agree on, and what lidars see. A stereo matcher
/// makes up surfaces, most of them in the sky and near the camera, and others in each image: one
/// image alone is not believed, neither that something is there nor that it is gone.
class Sight {
 public:
  static constexpr int kImages = 4;  ///< of each camera that are looked at
  static constexpr int kNeeded = 3;  ///< of them, that have to say the same

  void take(const ab_depth_image& image);
  void take(const ab_cloud& cloud);
  void forget() {
    cameras_.clear();
    lidars_.clear();
  }
  /// Before a camera has that many images, or a lidar a sweep, nothing is believed.
  bool is_ready() const;

  /// World points of the surfaces in each camera's newest image that enough of its others show too,
  /// up to `range_m` along camera z, and of those in each lidar's newest sweep, up to that
  /// distance.
  void append_points(double range_m, std::vector<Vector3>& points_world) const;

  /// Whether enough images of one camera, or a lidar, measured something along this world
  /// direction.
  bool has_seen(const Vector3& direction_world) const;

  /// Whether enough images of one camera, or a lidar, saw past this world point: a remembered
  /// obstacle there is gone.
  bool sees_through(const Vector3& point_world) const;

  /// Cosine of the horizontal angle between this world direction and the forward axis of the camera
  /// that looks along it most, when that took its newest image; 1 where a lidar saw there.
  double looked_along(const Vector3& direction_world) const;

 private:
  using Views = std::vector<DepthView>;  // oldest first
  std::vector<Views> cameras_;           // by index
  std::vector<PointView> lidars_;        // by index
};

}  // namespace reactive
