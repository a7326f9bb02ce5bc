#include "point_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"

namespace reactive {
namespace {

namespace portable = avoidbench::portable;

constexpr int kAzimuths = 120, kElevations = 60;  // 3° each
constexpr std::size_t kSweeps = 4;                // gaps of one sweep are filled by the others
constexpr std::int32_t kLeastShots = 4;           // in a sector, to say that nothing is there
constexpr double kGoesOn_m = 0.5;                 // behind what is seen through

Vector3 as_vector3(const avoidbench::Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

/// In the world's axes.
int PointView::sector_of(const Vector3& direction) {
  const double azimuth_rad = portable::atan2(direction.y, direction.x);
  const double elevation_rad = portable::atan2(direction.z, horizontal_norm(direction));
  const int column =
      static_cast<int>((azimuth_rad + portable::kPi) / (2.0 * portable::kPi) * kAzimuths);
  const int row =
      static_cast<int>((elevation_rad + 0.5 * portable::kPi) / portable::kPi * kElevations);
  return std::clamp(row, 0, kElevations - 1) * kAzimuths + std::clamp(column, 0, kAzimuths - 1);
}

void PointView::take(const ab_cloud& cloud) {
  const Vector3 position = vector3(cloud.position_world_m);
  // A planner may be shown anything by the conformance suite: such a sweep says nothing.
  if (!is_finite(position)) return;
  if (sweeps_.size() < kSweeps) {
    sweeps_.emplace_back();
  } else {
    std::rotate(sweeps_.begin(), sweeps_.begin() + 1,
                sweeps_.end());  // the oldest's buffer goes on
  }
  Sweep& sweep = sweeps_.back();
  sweep.position = position;
  sweep.sectors.assign(kAzimuths * kElevations, {std::numeric_limits<double>::infinity(), {}, 0});
  for (std::uint32_t i = 0; i < cloud.point_count; ++i) {
    const Vector3 point = as_vector3(avoidbench::point_in_world(cloud, cloud.points[i]));
    const Vector3 offset = point - sweep.position;
    const double distance_m = norm(offset);
    if (!(distance_m > 0.0 && distance_m < 1e6)) continue;
    Sector& sector = sweep.sectors[static_cast<std::size_t>(sector_of(offset))];
    ++sector.shots;
    if (distance_m >= sector.nearest_m) continue;
    sector.nearest_m = distance_m;
    sector.point = point;
  }
  for (std::uint32_t i = 0; i < cloud.miss_count; ++i) {
    const Vector3 direction = as_vector3(avoidbench::miss_in_world(cloud, i));
    if (!is_finite(direction)) continue;
    ++sweep.sectors[static_cast<std::size_t>(sector_of(direction))].shots;
  }
}

void PointView::append_points(double range_m, std::vector<Vector3>& points_world) const {
  if (is_empty()) return;
  for (const Sector& sector : sweeps_.back().sectors) {
    if (sector.nearest_m <= range_m) points_world.push_back(sector.point);
  }
}

bool PointView::has_seen(const Vector3& direction_world) const {
  const auto at = static_cast<std::size_t>(sector_of(direction_world));
  return std::any_of(sweeps_.begin(), sweeps_.end(),
                     [at](const Sweep& sweep) { return sweep.sectors[at].shots > 0; });
}

bool PointView::sees_through(const Vector3& point_world) const {
  std::int32_t shots = 0;
  for (const Sweep& sweep : sweeps_) {
    const Vector3 offset = point_world - sweep.position;
    const Sector& sector = sweep.sectors[static_cast<std::size_t>(sector_of(offset))];
    if (sector.nearest_m <= norm(offset) + kGoesOn_m) return false;
    shots += sector.shots;
  }
  return shots >= kLeastShots;
}

}  // namespace reactive
