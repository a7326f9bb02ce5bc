#include "metrics/clearance_grid.hpp"

#include <algorithm>
#include <cmath>

namespace avoidbench {
namespace {

// 32 MB of distances, and three times that in a search over them.
constexpr double kMaxCells = 8e6;
constexpr double kWorthAStep =
    0.25;  ///< of a cell: the scene is asked where a step would be shorter
// Distances are kept as floats; bounds made of them give way by this.
constexpr double kFloatRounding_m = 1e-6;

Eigen::Vector3i grid_size(const Aabb& region, double cell_m) {
  const Eigen::Vector3d cells = region.sizes() / cell_m;
  return {std::max(1, static_cast<int>(std::ceil(cells.x()))),
          std::max(1, static_cast<int>(std::ceil(cells.y()))),
          std::max(1, static_cast<int>(std::ceil(cells.z())))};
}

}  // namespace

ClearanceGrid::ClearanceGrid(const Scene& scene, const Aabb& region, double cell_m)
    : scene_(&scene), region_(region), origin_(region.min()), cell_m_(cell_m) {
  // A large map gets coarser cells.
  while (region.sizes().prod() / (cell_m_ * cell_m_ * cell_m_) > kMaxCells) cell_m_ *= 1.1;
  size_ = grid_size(region, cell_m_);
  clearance_m_.assign(static_cast<std::size_t>(cell_count()), -1.0F);
}

Eigen::Vector3d ClearanceGrid::centre(const Eigen::Vector3i& cell) const {
  return origin_ + cell_m_ * (cell.cast<double>() + Eigen::Vector3d::Constant(0.5));
}

Eigen::Vector3i ClearanceGrid::cell_of(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d scaled = (point - origin_) / cell_m_;
  Eigen::Vector3i cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double clamped = std::clamp(std::floor(scaled[axis]), 0.0, size_[axis] - 1.0);
    cell[axis] = static_cast<int>(clamped);
  }
  return cell;
}

std::int64_t ClearanceGrid::index(const Eigen::Vector3i& cell) const {
  return (std::int64_t{cell.z()} * size_.y() + cell.y()) * size_.x() + cell.x();
}

Eigen::Vector3i ClearanceGrid::cell(std::int64_t index) const {
  const std::int64_t row = index / size_.x();
  return {static_cast<int>(index % size_.x()), static_cast<int>(row % size_.y()),
          static_cast<int>(row / size_.y())};
}

double ClearanceGrid::clearance_m(const Eigen::Vector3i& cell) {
  float& kept = clearance_m_[static_cast<std::size_t>(index(cell))];
  if (kept < 0.0F) {
    // A query within a known bound visits few triangles. Neighbours are mostly known: callers walk
    // from cell to cell.
    const double limit_m = upper_bound_m(cell);
    kept = static_cast<float>(std::min(kFar_m, scene_->nearest(centre(cell), limit_m).distance_m));
  }
  return static_cast<double>(kept);
}

/// A neighbour's clearance and the way to it: clearances change no faster than places do.
double ClearanceGrid::upper_bound_m(const Eigen::Vector3i& cell) const {
  double bound_m = kFar_m;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Eigen::Vector3i beside = cell;
      beside[axis] += side;
      if (beside[axis] < 0 || beside[axis] >= size_[axis]) continue;
      const double known_m =
          static_cast<double>(clearance_m_[static_cast<std::size_t>(index(beside))]);
      if (known_m >= 0.0) bound_m = std::min(bound_m, known_m + cell_m_ + kFloatRounding_m);
    }
  }
  return bound_m;
}

double ClearanceGrid::interpolated_bound_m(const Eigen::Vector3d& point) {
  const Eigen::Vector3d scaled = (point - origin_) / cell_m_ - Eigen::Vector3d::Constant(0.5);
  Eigen::Vector3i low;
  Eigen::Vector3d share;
  for (int axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(scaled[axis]);
    // No eight centres around the point: no bound.
    if (floor < 0.0 || floor + 1.0 >= size_[axis]) return 0.0;
    low[axis] = static_cast<int>(floor);
    share[axis] = scaled[axis] - floor;
  }
  double mean_m = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(corner & 1, (corner >> 1) & 1, corner >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? share[axis] : 1.0 - share[axis];
    mean_m += weight * clearance_m(low + step);
  }
  // With p the surface point nearest to x, every corner c has d(c) ≤ |c − p| ≤ d(x) + u·(c − x) +
  // |c − x|²/2d(x), so that mean ≤ d + S/2d, S the mean of |c − x|². Of the two ranges of d that
  // this leaves, the lower is out where mean − √S ≤ d is above it.
  const double spread_m2 = cell_m_ * cell_m_ * (share.array() * (1.0 - share.array())).sum();
  // The lower range is out from mean² = 2.25 S on; the limit is a little above that, and 2 S, where
  // the root ends, is well below it.
  if (mean_m * mean_m < 2.62 * spread_m2) return 0.0;
  return 0.5 * (mean_m + std::sqrt(mean_m * mean_m - 2.0 * spread_m2)) - kFloatRounding_m;
}

/// The cheapest bound that is enough: the cell's own, then that of the eight cells around, then the
/// scene's answer.
double ClearanceGrid::lower_bound_m(const Eigen::Vector3d& point, double enough_m) {
  const Eigen::Vector3i cell = cell_of(point);
  const double offset_m = (point - centre(cell)).norm() + kFloatRounding_m;
  const double at_centre_m = clearance_m(cell);
  if (at_centre_m - offset_m >= enough_m) return at_centre_m - offset_m;
  // The point is the centre.
  if (offset_m <= 2.0 * kFloatRounding_m) return at_centre_m;
  // Else no bound can reach what is asked for, and the scene has to say.
  if (at_centre_m + offset_m >= enough_m) {
    const double bound_m = interpolated_bound_m(point);
    if (bound_m >= enough_m) return bound_m;
  }
  const double limit_m = std::min(kFar_m, at_centre_m + offset_m);
  return std::min(limit_m, scene_->nearest(point, limit_m).distance_m);
}

bool ClearanceGrid::is_free(const Eigen::Vector3d& point, double radius_m) {
  const Eigen::Vector3i cell = cell_of(point);
  const double offset_m = (point - centre(cell)).norm() + kFloatRounding_m;
  // Too near for certain: nothing has to be asked.
  if (clearance_m(cell) + offset_m < radius_m) return false;
  return lower_bound_m(point, radius_m) >= radius_m;
}

double ClearanceGrid::free_distance_m(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                      double limit_m, double radius_m) {
  if (!is_free(from, radius_m)) return 0.0;
  const double enough_m = radius_m + kWorthAStep * cell_m_;
  double travelled_m = 0.0;
  while (travelled_m < limit_m) {
    const double clearance = lower_bound_m(from + travelled_m * direction, enough_m);
    if (clearance < radius_m - kTolerance_m) return travelled_m;
    // Sphere tracing: nothing is nearer than the clearance. The least step keeps a flight along a
    // wall from creeping.
    travelled_m += std::max(clearance - radius_m, kTolerance_m);
  }
  return limit_m;
}

std::optional<Eigen::Vector3d> ClearanceGrid::obstruction(const Eigen::Vector3d& from,
                                                          const Eigen::Vector3d& to,
                                                          double radius_m) {
  const double length_m = (to - from).norm();
  const double least_m = radius_m - kSightTolerance_m;
  // The end first: one look that may spare the walk.
  if (!is_free(to, least_m)) return to;
  if (length_m < 1e-9) return std::nullopt;
  const Eigen::Vector3d direction = (to - from) / length_m;
  // A clearance at s covers as much before s as after it: look ahead by what the last one left.
  double covered_m = 0.0, ahead_m = 0.0;
  while (covered_m < length_m) {
    const double s_m = std::min(covered_m + ahead_m, length_m);
    const double behind_m = s_m - covered_m;
    const double enough_m =
        least_m + std::max(kSightTolerance_m, std::min(behind_m, kWorthAStep * cell_m_));
    const Eigen::Vector3d place = from + s_m * direction;
    const double margin_m = lower_bound_m(place, enough_m) - least_m;
    if (margin_m < 0.0) return place;
    // The free ball reaches back to what is covered, or the look ahead is as short as the tolerance
    // allows: go on from its far side. Else look nearer.
    if (margin_m >= behind_m || ahead_m <= kSightTolerance_m) {
      covered_m = s_m + margin_m;
      ahead_m = std::max(margin_m, kSightTolerance_m);
    } else {
      ahead_m = std::max(std::min(margin_m, 0.5 * behind_m), kSightTolerance_m);
    }
  }
  return std::nullopt;
}

Eigen::Vector3d ClearanceGrid::nearest_surface(const Eigen::Vector3d& point) const {
  const NearestPoint found = scene_->nearest(point, kFar_m);
  return found.distance_m <= kFar_m ? found.point_world : point;
}

bool is_inside(const Scene& scene, const Eigen::Vector3d& point_world) {
  // Rays that are askew to all axes: walls and boxes stand along the axes, and a ray along one
  // meets their edges. One of three may slip through a crack of a mesh or be undecided at an edge;
  // two are believed.
  int behind = 0;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0.013, 0.007), Eigen::Vector3d(-0.51, 0.86, 0.011),
        Eigen::Vector3d(0.02, 0.03, 1)}) {
    const RayHit hit = scene.first_hit(point_world, direction);
    // The back of a surface is met first: the ray came from inside.
    if (std::isfinite(hit.distance_m) && hit.normal_world.dot(direction) > 0.0) ++behind;
  }
  return behind >= 2;
}

}  // namespace avoidbench
