#include "env/path_progress.hpp"

#include <algorithm>
#include <limits>

namespace avoidbench {

double arc_length_m(std::span<const Eigen::Vector3d> path, const Eigen::Vector3d& place) {
  double best_m = 0.0, before_m = 0.0;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d piece = path[i] - path[i - 1];
    const double length_m = piece.norm();
    // A path may have the same point twice: such a piece has no direction.
    const double share =
        length_m > 0.0 ? std::clamp(piece.dot(place - path[i - 1]) / piece.squaredNorm(), 0.0, 1.0)
                       : 0.0;
    const double distance_m2 = (path[i - 1] + share * piece - place).squaredNorm();
    if (distance_m2 < nearest_m2) {
      nearest_m2 = distance_m2;
      best_m = before_m + share * length_m;
    }
    before_m += length_m;
  }
  return best_m;
}

}  // namespace avoidbench
