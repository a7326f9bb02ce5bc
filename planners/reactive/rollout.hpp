#pragma once

#include <vector>

#include "vector3.hpp"

namespace reactive {

/// How the vehicle answers a velocity command: nothing for `latency_s`, then a constant
/// acceleration toward it.
struct Response {
  double latency_s = 0.05;
  double acceleration_mps2 = 4.0;
  int step_count = 11;
  double step_s = 0.1;
};

/// Least distance between the vehicle's centre and the points while it answers `command`, beginning
/// at the origin with `velocity`; at most `range_m`. `points` are relative to the vehicle.
double rollout_clearance(const std::vector<Vector3>& points, const Vector3& velocity,
                         const Vector3& command, const Response& response, double range_m);

}  // namespace reactive
