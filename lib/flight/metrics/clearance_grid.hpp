#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene.hpp"

namespace avoidbench {

/// Distance to the nearest surface at the centres of a grid's cells, exact, asked of the scene when
/// first needed and then kept. It answers whether a ball is free at a point or along a segment: the
/// scene is asked again only where the cell's distance does not decide. One thread at a time.
class ClearanceGrid {
 public:
  /// Cells of `cell_m`, larger where `region` would have more than 8 million of them.
  ClearanceGrid(const Scene& scene, const Aabb& region, double cell_m);

  const Aabb& region() const { return region_; }
  const Eigen::Vector3i& size() const { return size_; }
  double cell_m() const { return cell_m_; }
  std::int64_t cell_count() const { return std::int64_t{size_.x()} * size_.y() * size_.z(); }
  Eigen::Vector3d centre(const Eigen::Vector3i& cell) const;
  Eigen::Vector3i cell_of(const Eigen::Vector3d& point) const;  ///< clamped to the grid
  std::int64_t index(const Eigen::Vector3i& cell) const;
  Eigen::Vector3i cell(std::int64_t index) const;

  /// Distance at a cell's centre, at most kFar_m.
  double clearance_m(const Eigen::Vector3i& cell);

  /// Whether a ball of this radius fits at `point` (of surfaces it knows only the distance: see
  /// is_inside()).
  bool is_free(const Eigen::Vector3d& point, double radius_m);

  /// How far a ball can be moved from `from` along the unit `direction`, at most `limit_m`: sphere
  /// tracing, to kTolerance_m; 0 where it does not fit at the start.
  double free_distance_m(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                         double limit_m, double radius_m);

  /// Whether a ball can be moved from `from` to `to`, except for kSightTolerance_m of its radius.
  bool is_segment_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m) {
    return !obstruction(from, to, radius_m);
  }

  /// A place on the way from `from` to `to` where the ball does not fit, except for
  /// kSightTolerance_m of its radius; nothing where the way is free.
  std::optional<Eigen::Vector3d> obstruction(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                             double radius_m);

  /// The surface point nearest to `point`, within kFar_m; `point` itself if none is.
  Eigen::Vector3d nearest_surface(const Eigen::Vector3d& point) const;

  static constexpr double kFar_m = 2.5;
  static constexpr double kTolerance_m = 0.0005;
  static constexpr double kSightTolerance_m = 0.01;

 private:
  /// What a cell's distance can't exceed, from its neighbours: a short query is a cheap one.
  double upper_bound_m(const Eigen::Vector3i& cell) const;

  /// A distance that is free around `point` for sure, from the eight cells around it; 0 at the rim.
  double interpolated_bound_m(const Eigen::Vector3d& point);

  /// A distance that is free around `point` for sure, exact where it is less than `enough_m`.
  double lower_bound_m(const Eigen::Vector3d& point, double enough_m);

  const Scene* scene_;
  Aabb region_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i size_;
  double cell_m_;
  std::vector<float> clearance_m_;  ///< < 0: not asked yet
};

/// Whether the point lies inside a closed obstacle or below the ground: most of three rays meet a
/// surface from behind.
bool is_inside(const Scene& scene, const Eigen::Vector3d& point_world);

}  // namespace avoidbench
