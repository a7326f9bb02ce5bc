#pragma once

#include <cstdint>
#include <vector>

#include "sight.hpp"
#include "vector3.hpp"

namespace reactive {

/// Points seen in the last seconds, one a cell of a quarter metre, in a table of fixed size: enough
/// that an obstacle beside the vehicle, out of view, still counts. No map: nothing is kept of free
/// space, and old or far points go.
class ObstacleMemory {
 public:
  ObstacleMemory();
  void forget();
  void add(const Vector3& point_world, double time_s);

  /// Drops points that are older than `age_s`, farther than `range_m` from `centre_world`, or seen
  /// through.
  void prune(const Vector3& centre_world, double range_m, double time_s, double age_s,
             const Sight& sight);

  /// All points but those added at `except_time_s`.
  void append_points(double except_time_s, std::vector<Vector3>& points_world) const;

 private:
  struct Entry {
    Vector3 point;
    double time_s;
    bool is_used;
  };
  std::vector<Entry> entries_;
};

}  // namespace reactive
