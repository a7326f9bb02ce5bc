#include "polar_histogram.hpp"

#include <algorithm>

#include "avoidbench/portable_math.hpp"

namespace reactive {
namespace {

namespace portable = avoidbench::portable;

constexpr double kStep_rad = portable::kTau / PolarHistogram::kAzimuths;

/// Where a ball of this squared radius touches `point` when it flies along the unit vector, or
/// `free_m` if later or never.
double touched_at(const Vector3& point, double square_distance, const Vector3& along,
                  double square_radius, double free_m) {
  const double ahead_m = dot(point, along);
  if (ahead_m <= 0.0) return free_m;
  const double square_aside = square_distance - ahead_m * ahead_m;
  if (square_aside >= square_radius) return free_m;
  return std::min(free_m, std::max(0.0, ahead_m - std::sqrt(square_radius - square_aside)));
}

/// The radius with which a point at this distance counts: a point that is nearer than the wanted
/// radius only blocks the way to it.
double counted_radius(double distance_m, double radius_m) {
  return std::min(radius_m, 0.98 * distance_m);
}

}  // namespace

PolarHistogram::PolarHistogram() {
  constexpr int kMiddle = kElevations / 2;
  for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
    for (int elevation = 0; elevation < kElevations; ++elevation) {
      const double a = azimuth * kStep_rad, e = (elevation - kMiddle) * kStep_rad;
      const double level = portable::cos(e);
      directions_.push_back({level * portable::cos(a), level * portable::sin(a), portable::sin(e)});
    }
  }
  free_m_.assign(kDirections, 0.0);
}

void PolarHistogram::clear(double range_m) {
  range_m_ = range_m;
  std::fill(free_m_.begin(), free_m_.end(), range_m);
}

void PolarHistogram::add(const Vector3& point, double radius_m) {
  const double square_distance = dot(point, point);
  const double distance_m = std::sqrt(square_distance);
  if (!(distance_m - radius_m < range_m_) || distance_m < 1e-6) return;
  const double radius = counted_radius(distance_m, radius_m);
  const double level_m = horizontal_norm(point);

  // Most of the ground: farther below the lowest direction, or above the highest, than the radius.
  const Vector3& lowest_direction = directions_.front();  // at azimuth 0: its y is 0
  if (std::abs(point.z) * lowest_direction.x + level_m * lowest_direction.z > radius + 1e-9) return;

  // Only the elevations and azimuths that can touch it: within asin(radius / distance), and within
  // asin(radius / level distance) or all where it is above or below.
  constexpr double kSlack = 1e-9;
  constexpr int kMiddle = kElevations / 2;
  const double height = portable::atan2(point.z, level_m) / kStep_rad + kMiddle;
  const double reach = portable::asin(radius / distance_m) / kStep_rad + kSlack;
  const int lowest = std::max(0, static_cast<int>(std::ceil(height - reach)));
  const int highest = std::min(kElevations - 1, static_cast<int>(std::floor(height + reach)));
  if (lowest > highest) return;
  int first = 0, count = kAzimuths;
  if (level_m > radius) {
    const double centre = portable::atan2(point.y, point.x) / kStep_rad;
    const double half = portable::asin(radius / level_m) / kStep_rad;
    first = static_cast<int>(std::ceil(centre - half));
    count = std::min(kAzimuths, static_cast<int>(std::floor(centre + half)) - first + 1);
  }
  for (int i = 0; i < count; ++i) {
    const int azimuth = (first + i + 2 * kAzimuths) % kAzimuths;
    for (int elevation = lowest; elevation <= highest; ++elevation) {
      const auto index = static_cast<std::size_t>(azimuth * kElevations + elevation);
      free_m_[index] =
          touched_at(point, square_distance, directions_[index], radius * radius, free_m_[index]);
    }
  }
}

double free_distance(const std::vector<Vector3>& points, const Vector3& from, const Vector3& along,
                     double radius_m, double range_m) {
  double free_m = range_m;
  for (const Vector3& point : points) {
    const Vector3 offset = point - from;
    const double square_distance = dot(offset, offset);
    const double reach_m = free_m + radius_m;
    if (square_distance > reach_m * reach_m) continue;
    const double radius = counted_radius(std::sqrt(square_distance), radius_m);
    free_m = touched_at(offset, square_distance, along, radius * radius, free_m);
  }
  return free_m;
}

}  // namespace reactive
