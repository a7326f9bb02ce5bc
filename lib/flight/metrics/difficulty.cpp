#include "metrics/difficulty.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/cone_triangle.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

// The sensing range of all three measures, as in FlightBench.
constexpr double kSensing_m = 4.0;

/// A place of the path and the direction there.
struct Station {
  Vector3d place, direction;
};

/// At `along_m` from the path's start; beyond its end, the end.
Station station(const Path& path, double along_m) {
  // The last piece ends the walk at the latest.
  for (std::size_t i = 1;; ++i) {
    const Vector3d piece = path[i] - path[i - 1];
    const double length_m = piece.norm();
    if (along_m < length_m || i + 1 == path.size()) {
      const Vector3d direction = length_m > 0.0 ? Vector3d(piece / length_m) : Vector3d::UnitX();
      return {path[i - 1] + std::min(along_m, length_m) * direction, direction};
    }
    along_m -= length_m;
  }
}

/// Two directions that complete `forward` to a right-handed frame.
std::pair<Vector3d, Vector3d> sideways(const Vector3d& forward) {
  const Vector3d helper =
      // Any helper that is not nearly parallel to `forward` will do.
      std::abs(forward.z()) < 0.9 ? Vector3d(Vector3d::UnitZ()) : Vector3d(Vector3d::UnitX());
  const Vector3d left = helper.cross(forward).normalized();
  return {left, forward.cross(left)};
}

struct Sphere {
  Vector3d center;
  double radius_m = 0.0;
};

/// The free ball around a place, less the body's: the room for the body's centre.
Sphere free_sphere(const Scene& scene, const Vector3d& center, double body_radius_m) {
  const double limit_m = kSensing_m + body_radius_m;
  const double clearance_m = std::min(limit_m, scene.nearest(center, limit_m).distance_m);
  return {center, clearance_m - body_radius_m};
}

double ball_volume(double radius_m) {
  return 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m;
}

/// Volume that two spheres share; nothing where they don't cut each other.
std::optional<double> shared_volume(const Sphere& a, const Sphere& b) {
  const double d = (a.center - b.center).norm();
  const double small = std::min(a.radius_m, b.radius_m), large = std::max(a.radius_m, b.radius_m);
  // Apart, or one within the other: they have no circle in common.
  if (small <= 0.0 || d < large - small || d > large + small || d <= 0.0) return std::nullopt;
  const auto cap = [](double radius, double height) {
    return std::numbers::pi / 3.0 * height * height * (3.0 * radius - height);
  };
  // The plane of the circle in which the spheres cut each other, from the small one's centre; each
  // side of it is a cap.
  const double to_plane = (small * small + d * d - large * large) / (2.0 * d);
  return cap(small, small - to_plane) + cap(large, large - (d - to_plane));
}

/// The best sphere about `aim` that cuts the last one: large, overlapping, not far from the path.
std::optional<Sphere> next_sphere(const Scene& scene, const Sphere& last, const Vector3d& aim,
                                  double body_radius_m, RandomStream& draws) {
  constexpr int kSamples = 40;
  constexpr double kSize = 0.7, kOverlap = 0.1, kAhead = 0.35, kAside = 0.1, kAimCost = 0.4;
  const Vector3d way = aim - last.center;
  const double reach_m = way.norm();
  const Vector3d forward = way / reach_m;
  const auto [left, up] = sideways(forward);
  std::optional<Sphere> best;
  double best_score = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector3d& center, double cost) {
    const Sphere sphere = free_sphere(scene, center, body_radius_m);
    const auto shared = shared_volume(last, sphere);
    if (!shared) return;
    const double score = kSize * ball_volume(sphere.radius_m) + kOverlap * *shared - cost;
    if (score <= best_score) return;
    best_score = score;
    best = sphere;
  };
  // The path's own place, at a fixed cost.
  consider(aim, kAimCost);
  // The others are scattered about it, twice as far aside as ahead.
  for (int i = 0; i < kSamples; ++i) {
    const double ahead_m = 0.25 * reach_m * draws.normal();
    const double left_m = 0.5 * reach_m * draws.normal(), up_m = 0.5 * reach_m * draws.normal();
    consider(aim + ahead_m * forward + left_m * left + up_m * up,
             kAhead * ahead_m + kAside * math::hypot(left_m, up_m));
  }
  return best;
}

/// Radii of a corridor of spheres from the path's start to its end.
std::vector<double> corridor_radii(const Scene& scene, const Path& path, double body_radius_m,
                                   RandomStream& draws) {
  constexpr double kStep_m = 0.3, kLeast_m = 0.05;
  constexpr int kTries = 20, kMostSpheres = 2000;
  const double length_m = path_length_m(path);
  Sphere last = free_sphere(scene, path.front(), body_radius_m);
  last.radius_m = std::max(last.radius_m, kLeast_m);
  std::vector<double> radii{last.radius_m};
  double along_m = 0.0;
  // Until the path's end is within the last sphere.
  while ((path.back() - last.center).norm() >= last.radius_m && radii.size() < kMostSpheres) {
    // The first place of the path outside of the last sphere.
    Vector3d aim = last.center;
    while ((aim - last.center).norm() < last.radius_m && along_m < length_m) {
      along_m += kStep_m;
      aim = station(path, along_m).place;
    }
    if (along_m >= length_m) aim = path.back();
    std::optional<Sphere> next;
    for (int i = 0; i < kTries && !next; ++i) {
      next = next_sphere(scene, last, aim, body_radius_m, draws);
    }
    if (!next) {  // squeezed: the path itself is free there
      next = free_sphere(scene, aim, body_radius_m);
      next->radius_m = std::max(next->radius_m, kLeast_m);
    }
    last = *next;
    radii.push_back(last.radius_m);
    if (along_m >= length_m && last.center == path.back()) break;
  }
  return radii;
}

/// One ring of the field of view.
struct Ring {
  double inner_deg, outer_deg, weight;
};
// Weights add up to 1.
constexpr std::array<Ring, 4> kRings{
    {{0.0, 15.0, 0.55}, {15.0, 22.5, 0.3}, {22.5, 30.0, 0.1}, {30.0, 36.0, 0.05}}};

/// The nearest surface in each ring of the view along `at.direction`; +inf beyond the sensing
/// range.
std::array<double, kRings.size()> nearest_in_rings(const Scene& scene, const Station& at) {
  std::array<ConeShell, kRings.size()> shells;
  std::array<double, kRings.size()> nearest_m;
  nearest_m.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < kRings.size(); ++i) {
    shells[i] = {.axis = at.direction,
                 .cos_inner = math::cos(kRings[i].inner_deg * math::kDegree),
                 .cos_outer = math::cos(kRings[i].outer_deg * math::kDegree)};
  }
  // The ball through the apex and the rim of the view's cap holds all of the view.
  const double reach_m = 0.5 * kSensing_m / shells.back().cos_outer;
  const Vector3d middle = at.place + reach_m * at.direction;
  scene.visit_triangles(middle, reach_m, [&](const Triangle& corners_world) {
    Triangle corners = corners_world;
    for (Vector3d& corner : corners) corner -= at.place;
    // Most triangles are farther than what each ring has found already: no cone is asked then.
    const double least_m = closest_point(Vector3d::Zero(), corners).norm();
    for (std::size_t i = 0; i < kRings.size(); ++i) {
      if (least_m >= std::min(nearest_m[i], kSensing_m)) continue;
      const double found_m = distance(shells[i], corners);
      if (found_m <= kSensing_m) nearest_m[i] = std::min(nearest_m[i], found_m);
    }
    // The search does not shrink: each ring has a nearest surface of its own.
    return reach_m;
  });
  return nearest_m;
}

}  // namespace

double traversability_obstruction(const Scene& scene, const Path& path, double radius_m,
                                  std::uint64_t seed) {
  constexpr int kCorridors = 8;
  AB_CHECK(path.size() >= 2, path.size());
  RandomStream draws = stream(seed, "traversability_obstruction");
  // Corridors are drawn at random: the widest of eight counts.
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kCorridors; ++i) {
    std::vector<double> radii = corridor_radii(scene, path, radius_m, draws);
    std::sort(radii.begin(), radii.end());
    // Narrow places make a mission hard; wide ones beside them do not make it easier.
    const std::size_t half = std::max<std::size_t>(1, radii.size() / 2);
    double sum = 0.0;
    for (std::size_t k = 0; k < half; ++k) sum += 1.0 / radii[k];
    least = std::min(least, kSensing_m * sum / (2.0 * static_cast<double>(half)));
  }
  return least;
}

double view_occlusion(const Scene& scene, const Path& path) {
  constexpr double kStep_m = 0.1 * kSensing_m;
  AB_CHECK(path.size() >= 2, path.size());
  const double length_m = path_length_m(path);
  const int count = std::max(1, static_cast<int>(std::floor(length_m / kStep_m)));
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto nearest_m = nearest_in_rings(scene, station(path, (i + 0.5) * length_m / count));
    for (std::size_t k = 0; k < kRings.size(); ++k) {
      sum += kRings[k].weight * kSensing_m / nearest_m[k];  // 0 where nothing is seen
    }
  }
  return sum / count;
}

double angle_over_length_1pm(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 2; i < path.size(); ++i) {
    const Vector3d in = path[i - 1] - path[i - 2], out = path[i] - path[i - 1];
    const double angle_rad = math::atan2(in.cross(out).norm(), in.dot(out));
    // 0 straight on, e - 1 at a right angle.
    sum += math::exp(2.0 * angle_rad / std::numbers::pi) - 1.0;
  }
  return sum / path_length_m(path);
}

MissionDifficulty mission_difficulty(const Scene& scene, const Path& path, double radius_m,
                                     std::uint64_t seed) {
  return {.traversability_obstruction = traversability_obstruction(scene, path, radius_m, seed),
          .view_occlusion = view_occlusion(scene, path),
          .angle_over_length_1pm = angle_over_length_1pm(path)};
}

}  // namespace avoidbench
