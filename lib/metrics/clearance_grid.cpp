#include "metrics/clearance_grid.hpp"

#include <algorithm>
#include <cmath>

namespace avoidbench {
namespace {

constexpr double kMaxCells = 8e6;

Eigen::Vector3i grid_size(const Aabb& region, double cell_m) {
  const Eigen::Vector3d cells = region.sizes() / cell_m;
  return {std::max(1, static_cast<int>(std::ceil(cells.x()))),
          std::max(1, static_cast<int>(std::ceil(cells.y()))),
          std::max(1, static_cast<int>(std::ceil(cells.z())))};
}

}  // namespace

ClearanceGrid::ClearanceGrid(const Scene& scene, const Aabb& region, double cell_m)
    : scene_(&scene), origin_(region.min()), cell_m_(cell_m) {
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
    kept = static_cast<float>(std::min(kFar_m, scene_->nearest(centre(cell), kFar_m).distance_m));
  }
  return static_cast<double>(kept);
}

double ClearanceGrid::lower_bound_m(const Eigen::Vector3d& point, double enough_m) {
  constexpr double kFloatRounding_m = 1e-6;
  const Eigen::Vector3i cell = cell_of(point);
  const double bound_m = clearance_m(cell) - (point - centre(cell)).norm() - kFloatRounding_m;
  if (bound_m >= enough_m) return bound_m;
  return std::min(kFar_m, scene_->nearest(point, kFar_m).distance_m);
}

bool ClearanceGrid::is_free(const Eigen::Vector3d& point, double radius_m) {
  return lower_bound_m(point, radius_m) >= radius_m;
}

double ClearanceGrid::free_distance_m(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                      double limit_m, double radius_m) {
  if (!is_free(from, radius_m)) return 0.0;
  const double enough_m = radius_m + 0.5 * cell_m_;  // below it a step by the bound would be short
  double travelled_m = 0.0;
  while (travelled_m < limit_m) {
    const double clearance = lower_bound_m(from + travelled_m * direction, enough_m);
    if (clearance < radius_m - kTolerance_m) return travelled_m;
    travelled_m += std::max(clearance - radius_m, kTolerance_m);
  }
  return limit_m;
}

bool ClearanceGrid::is_segment_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                    double radius_m) {
  const double length_m = (to - from).norm();
  if (!is_free(to, radius_m - kTolerance_m)) return false;
  if (length_m < 1e-9) return true;
  const double enough_m = radius_m + 0.5 * cell_m_;
  const Eigen::Vector3d direction = (to - from) / length_m;
  for (double travelled_m = 0.0; travelled_m < length_m;) {
    const double clearance = lower_bound_m(from + travelled_m * direction, enough_m);
    if (clearance < radius_m - kTolerance_m) return false;
    travelled_m += std::max(clearance - radius_m, 2.0 * kTolerance_m);
  }
  return true;
}

bool is_inside(const Scene& scene, const Eigen::Vector3d& point_world) {
  int behind = 0;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0.013, 0.007), Eigen::Vector3d(-0.51, 0.86, 0.011),
        Eigen::Vector3d(0.02, 0.03, 1)}) {
    const RayHit hit = scene.first_hit(point_world, direction);
    if (std::isfinite(hit.distance_m) && hit.normal_world.dot(direction) > 0.0) ++behind;
  }
  return behind >= 2;
}

}  // namespace avoidbench
