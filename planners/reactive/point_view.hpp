#pragma once

#include <cstdint>
#include <vector>

#include "avoidbench/planner.h"
#include "vector3.hpp"

namespace reactive {

/// The last sweeps of a lidar, each brought down to sectors of 3° by 3° around it with the nearest
/// point in each: what DepthView is to images. Points of a lidar need no confirmation.
class PointView {
 public:
  void take(const ab_cloud& cloud);
  bool is_empty() const { return sweeps_.empty(); }

  /// World points of the nearest surface in each sector of the newest sweep, up to `range_m`.
  void append_points(double range_m, std::vector<Vector3>& points_world) const;

  /// Whether the last sweeps fired along this world direction, and came back with anything or
  /// nothing.
  bool has_seen(const Vector3& direction_world) const;

  /// Whether all of the last sweeps saw past this world point, as far as they fired there.
  bool sees_through(const Vector3& point_world) const;

 private:
  struct Sector {
    double nearest_m;  ///< +inf: shots came back with nothing, or there were none
    Vector3 point;
    std::int32_t shots;
  };
  struct Sweep {
    Vector3 position;
    std::vector<Sector> sectors;
  };
  static int sector_of(const Vector3& direction);

  std::vector<Sweep> sweeps_;  ///< oldest first
};

}  // namespace reactive
