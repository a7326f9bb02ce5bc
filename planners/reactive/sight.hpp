#pragma once

#include <vector>

#include "depth_view.hpp"
#include "vector3.hpp"

namespace reactive {

/// What the last few depth images agree on. A stereo matcher makes up surfaces, most of them in the
/// sky and near the camera, and others in each image: one image alone is not believed, neither that
/// something is there nor that it is gone.
class Sight {
 public:
  static constexpr int kImages = 4;  ///< that are looked at
  static constexpr int kNeeded = 3;  ///< of them, that have to say the same

  void take(const ab_depth_image& image);
  void forget() { views_.clear(); }
  /// Before that many images nothing is believed.
  bool is_ready() const { return static_cast<int>(views_.size()) >= kNeeded; }

  /// World points of the surfaces in the newest image that enough of the others show too, up to
  /// `range_m` along camera z.
  void append_points(double range_m, std::vector<Vector3>& points_world) const;

  /// Whether enough images measured something along this world direction.
  bool has_seen(const Vector3& direction_world) const;

  /// Whether enough images saw past this world point: a remembered obstacle there is gone.
  bool sees_through(const Vector3& point_world) const;

  /// The camera's forward axis in the world, when it took the newest image.
  Vector3 forward_world() const { return views_.back().forward_world(); }

 private:
  std::vector<DepthView> views_;  // oldest first
};

}  // namespace reactive
