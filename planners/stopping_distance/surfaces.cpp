#include "surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace stopping_distance {
namespace {

constexpr double kCell_m = 0.1;

Eigen::Vector3d vector(const avoidbench::Vec3& v) { return {v[0], v[1], v[2]}; }

std::uint64_t cell_of(const Eigen::Vector3d& place_world) {
  constexpr std::int64_t kHalf = 1 << 20;  // cells on either side of the origin, 100 km
  constexpr std::uint64_t kMask = 2 * kHalf - 1;
  std::uint64_t cell = 0;
  for (const double x : place_world) {
    const auto index = static_cast<std::int64_t>(std::floor(x / kCell_m)) + kHalf;
    cell = cell << 21U | (static_cast<std::uint64_t>(index) & kMask);
  }
  return cell;
}

}  // namespace

void Surfaces::add(const ab_observation& seen) {
  for (std::uint32_t i = 0; i < seen.depth_count; ++i) add_image(*seen.depth[i]);
  for (std::uint32_t i = 0; i < seen.cloud_count; ++i) add_cloud(*seen.clouds[i]);
  std::erase_if(points_,
                [&](const auto& entry) { return entry.second.time_s < seen.time_s - memory_s_; });
}

/// Of each part of the image one of the nearest surfaces. The very nearest pixels may be a stereo
/// matcher's slips.
void Surfaces::add_image(const ab_depth_image& image) {
  constexpr std::int32_t kParts = 80;  // across
  constexpr std::size_t kSlips = 3;    // pixels
  const std::int32_t size_px = std::max(1, image.width_px / kParts);
  for (std::int32_t row = 0; row + size_px <= image.height_px; row += size_px) {
    for (std::int32_t column = 0; column + size_px <= image.width_px; column += size_px) {
      cell_.clear();
      for (std::int32_t y = row; y < row + size_px; ++y) {
        for (std::int32_t x = column; x < column + size_px; ++x) {
          const std::int32_t pixel = y * image.width_px + x;
          const float depth_m = image.depth_m[pixel];
          if (depth_m > 0.0F && depth_m < static_cast<float>(reach_m_)) {
            cell_.emplace_back(depth_m, pixel);
          }
        }
      }
      const std::size_t slips = size_px > 2 ? kSlips : 0;
      if (cell_.size() <= slips) continue;
      const auto nearest = cell_.begin() + static_cast<std::ptrdiff_t>(slips);
      std::nth_element(cell_.begin(), nearest, cell_.end());
      const auto [depth_m, pixel] = *nearest;
      const std::int32_t x = pixel % image.width_px, y = pixel / image.width_px;
      const auto z_m = static_cast<double>(depth_m);
      add_point(vector(avoidbench::pixel_in_world(image, x, y, z_m)), image.time_s, z_m);
    }
  }
}

void Surfaces::add_cloud(const ab_cloud& cloud) {
  for (std::uint32_t i = 0; i < cloud.point_count; ++i) {
    const ab_lidar_point& point = cloud.points[i];
    const double range_m = static_cast<double>(Eigen::Vector3f(point.position_lidar_m).norm());
    if (range_m > 0.0 && range_m < reach_m_) {
      add_point(vector(avoidbench::point_in_world(cloud, point)), cloud.time_s, range_m);
    }
  }
}

void Surfaces::add_point(const Eigen::Vector3d& place_world, double time_s, double range_m) {
  if (!place_world.allFinite()) return;
  const auto [known, is_new] =
      points_.try_emplace(cell_of(place_world), Point{place_world, time_s, range_m});
  if (is_new) return;
  Point& point = known->second;
  // Of one image the nearest, of several the newest.
  if (time_s > point.time_s || (time_s == point.time_s && range_m < point.range_m)) {
    point = {place_world, time_s, range_m};
  }
}

std::vector<Eigen::Vector3d> Surfaces::near(const Eigen::Vector3d& place_world,
                                            double distance_m) const {
  std::vector<Eigen::Vector3d> found;
  for (const auto& [cell, point] : points_) {
    if ((point.place_world - place_world).squaredNorm() <= distance_m * distance_m) {
      found.push_back(point.place_world);
    }
  }
  return found;
}

double free_way_m(const std::vector<Eigen::Vector3d>& points_world,
                  const Eigen::Vector3d& from_world, const Eigen::Vector3d& along, double radius_m,
                  double most_m) {
  // Cosine between the way and the direction to a point in the ball from which on it comes nearer.
  constexpr double kNearer = 0.2;
  double least_m = most_m;
  for (const Eigen::Vector3d& point_world : points_world) {
    const Eigen::Vector3d way = point_world - from_world;
    const double ahead_m = way.dot(along);
    if (ahead_m <= 0.0 || ahead_m > least_m + radius_m) continue;
    const double distance_m = way.norm();
    if (distance_m <= radius_m) {
      if (ahead_m > kNearer * distance_m) return 0.0;
      continue;
    }
    const double half_m2 = radius_m * radius_m - distance_m * distance_m + ahead_m * ahead_m;
    if (half_m2 > 0.0) least_m = std::min(least_m, std::max(0.0, ahead_m - std::sqrt(half_m2)));
  }
  return least_m;
}

}  // namespace stopping_distance
