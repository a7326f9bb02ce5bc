#include "real_flights/alignment.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

/// Whether the points span a plane: the second singular value decides.
bool spans_plane(const Eigen::Matrix3Xd& points) {
  constexpr double kLeastWidth_m = 0.1;
  const Eigen::Matrix3Xd around = points.colwise() - points.rowwise().mean();
  const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(around);
  return svd.singularValues()[1] >= kLeastWidth_m;
}

}  // namespace

Alignment align(const AlignmentSpec& spec, const InputProblem& place) {
  Alignment alignment;
  if (spec.points.empty()) {
    const double yaw_rad = spec.yaw_deg * math::kDegree;
    alignment.T_map_log = make_pose(to_eigen(spec.translation_m), yaw_rotation(yaw_rad));
    return alignment;
  }
  const auto count = static_cast<Eigen::Index>(spec.points.size());
  Eigen::Matrix3Xd log(3, count), map(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PointPairSpec& pair = spec.points[static_cast<std::size_t>(i)];
    log.col(i) = to_eigen(pair.log);
    map.col(i) = to_eigen(pair.map);
  }
  if (!spans_plane(log) || !spans_plane(map)) {
    InputProblem problem = place;
    problem.message =
        "alignment.points: lie on one line, or within 10 cm of one: they don't determine a "
        "rotation";
    throw InputError(problem);
  }
  alignment.T_map_log.matrix() = Eigen::umeyama(log, map, false);
  const Eigen::Matrix3Xd aligned = alignment.T_map_log * log;
  alignment.residual_m = std::sqrt((aligned - map).squaredNorm() / static_cast<double>(count));
  return alignment;
}

}  // namespace avoidbench
