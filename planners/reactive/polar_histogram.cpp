#include "polar_histogram.hpp"

#include <algorithm>

#include "avoidbench/portable_math.hpp"

namespace reactive {
namespace {

namespace portable = avoidbench::portable;

constexpr double kStep_rad = portable::kTau / PolarHistogram::kAzimuths;
constexpr double kRounding_m = 1e-9;

/// Where a ball of this squared radius touches a point that is `ahead_m` along its way and
/// `square_aside` (less than the squared radius) beside it, or `free_m` if later.
double touched_at(double ahead_m, double square_aside, double square_radius, double free_m) {
  return std::min(free_m, std::max(0.0, ahead_m - std::sqrt(square_radius - square_aside)));
}

/// The radius with which a point at this distance counts: a point that is nearer than the wanted
/// radius only blocks the way to it.
double counted_radius(double distance_m, double radius_m) {
  return std::min(radius_m, 0.98 * distance_m);
}

constexpr double kSteps_per_rad = 1.0 / kStep_rad;
constexpr double kRoughSlack = 0.06;

/// The angle of (x, y) in steps of the grid, within `kRoughSlack`: enough to find the cells that
/// are then looked at exactly, and several times faster than the exact one.
double rough_step(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  const double ratio = std::min(ax, ay) / std::max({ax, ay, 1e-12});
  // Within 0.0038 rad, which are 0.044 steps.
  double angle = ratio * (portable::kPi / 4 + 0.273 * (1.0 - ratio));
  if (ay > ax) angle = portable::kPi / 2 - angle;
  if (x < 0.0) angle = portable::kPi - angle;
  return (y < 0.0 ? -angle : angle) * kSteps_per_rad;
}

/// asin(sine) in steps of the grid or a little more, for a sine from 0 to 1: (asin(s) - s) / s³
/// grows to π/2 - 1 at 1.
double most_asin_steps(double sine) {
  constexpr double kCube = portable::kPi / 2 - 1.0 + 1e-9;
  return sine * (1.0 + kCube * sine * sine) * kSteps_per_rad;
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
  constexpr int kMiddle = kElevations / 2;
  const double height = rough_step(point.z, level_m) + kMiddle;
  const double reach = most_asin_steps(radius / distance_m) + kRoughSlack;
  const int lowest = std::max(0, static_cast<int>(std::ceil(height - reach)));
  const int highest = std::min(kElevations - 1, static_cast<int>(std::floor(height + reach)));
  if (lowest > highest) return;
  int first = 0, count = kAzimuths;
  if (level_m > radius) {
    const double centre = rough_step(point.y, point.x);
    const double half = most_asin_steps(radius / level_m) + kRoughSlack;
    first = static_cast<int>(std::ceil(centre - half));
    count = std::min(kAzimuths, static_cast<int>(std::floor(centre + half)) - first + 1);
  }
  const double square_radius = radius * radius;
  const double soonest_m = distance_m - radius;
  for (int i = 0; i < count; ++i) {
    const int azimuth = (first + i + 2 * kAzimuths) % kAzimuths;
    for (int elevation = lowest; elevation <= highest; ++elevation) {
      const int cell = azimuth * kElevations + elevation;
      const auto index = static_cast<std::size_t>(cell);
      if (free_m_[index] < soonest_m - kRounding_m) continue;
      const double ahead_m = dot(point, directions_[index]);
      const double square_aside = square_distance - ahead_m * ahead_m;
      if (ahead_m <= 0.0 || square_aside >= square_radius) continue;
      free_m_[index] = touched_at(ahead_m, square_aside, square_radius, free_m_[index]);
    }
  }
}

double free_distance(const std::vector<Vector3>& points, const Vector3& from, const Vector3& along,
                     double radius_m, double range_m) {
  const double most_square_radius = radius_m * radius_m;
  double free_m = range_m;
  for (const Vector3& point : points) {
    const Vector3 offset = point - from;
    const double ahead_m = dot(offset, along);
    const double square_distance = dot(offset, offset);
    const double square_aside = square_distance - ahead_m * ahead_m;
    // In one test, which nearly always fails.
    const bool is_near = static_cast<int>(ahead_m > 0.0) &
                         static_cast<int>(ahead_m < free_m + radius_m) &
                         static_cast<int>(square_aside < most_square_radius);
    if (!is_near) continue;
    const double radius = counted_radius(std::sqrt(square_distance), radius_m);
    if (square_aside >= radius * radius) continue;
    free_m = touched_at(ahead_m, square_aside, radius * radius, free_m);
  }
  return free_m;
}

}  // namespace reactive
