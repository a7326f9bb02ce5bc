#include "rollout.hpp"

#include <algorithm>

namespace reactive {

double rollout_clearance(const std::vector<Vector3>& points, const Vector3& velocity,
                         const Vector3& command, const Response& response, double range_m) {
  Vector3 position = response.latency_s * velocity;
  Vector3 now = velocity;
  double square_clearance = range_m * range_m;
  for (int i = 0; i < response.step_count; ++i) {
    const Vector3 change = command - now;
    const double left = norm(change);
    const double possible = response.acceleration_mps2 * response.step_s;
    const Vector3 next = left <= possible ? command : now + (possible / left) * change;
    position = position + (0.5 * response.step_s) * (now + next);
    now = next;
    for (const Vector3& point : points) {
      const Vector3 offset = point - position;
      square_clearance = std::min(square_clearance, dot(offset, offset));
    }
  }
  return std::sqrt(square_clearance);
}

}  // namespace reactive
