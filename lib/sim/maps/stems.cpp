#include "maps/stems.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

struct StemPlace {
  std::size_t ring = 0;
  double ratio = 0.0;
};

/// By rings, not by length: on a stem of uneven rings the middle ratio is the middle ring.
StemPlace place_on(const Stem& stem, double ratio) {
  const double scaled = std::clamp(ratio, 0.0, 1.0) * static_cast<double>(stem.size() - 1);
  const std::size_t ring = std::min(static_cast<std::size_t>(scaled), stem.size() - 2);
  return {ring, scaled - static_cast<double>(ring)};
}

}  // namespace

Stem grow_stem(const StemGrowth& growth, RandomStream& random) {
  Stem stem;
  Eigen::Vector3d position = growth.root;
  Eigen::Vector3d direction = growth.direction.normalized();
  const double step_m = growth.length_m / growth.segments;
  for (int i = 0; i <= growth.segments; ++i) {
    const double taper = 1.0 - static_cast<double>(i) / growth.segments;
    stem.push_back({.centre = position, .radius_m = growth.root_radius_m * taper});
    // Each by itself: compilers order the draws of one expression differently.
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    const double z = random.uniform(-1.0, 1.0);
    // Each joint turns a little up and, by its three draws, a little aside.
    direction += Eigen::Vector3d::UnitZ() * (growth.rise / growth.segments) +
                 growth.wander * Eigen::Vector3d(x, y, z);
    direction.normalize();
    position += step_m * direction;
  }
  return stem;
}

Eigen::Vector3d stem_point(const Stem& stem, double ratio) {
  const StemPlace place = place_on(stem, ratio);
  const Eigen::Vector3d& a = stem[place.ring].centre;
  return a + place.ratio * (stem[place.ring + 1].centre - a);
}

double stem_radius_m(const Stem& stem, double ratio) {
  const StemPlace place = place_on(stem, ratio);
  const double a = stem[place.ring].radius_m;
  return a + place.ratio * (stem[place.ring + 1].radius_m - a);
}

Eigen::Vector3d stem_direction(const Stem& stem, double ratio) {
  const StemPlace place = place_on(stem, ratio);
  return (stem[place.ring + 1].centre - stem[place.ring].centre).normalized();
}

Eigen::Vector3d turned_from(const Eigen::Vector3d& axis, double angle_rad, double turn_rad) {
  // Any direction that is not nearly the axis.
  const Eigen::Vector3d reference =
      std::abs(axis.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  // Two directions square to the axis and to each other.
  const Eigen::Vector3d side = axis.cross(reference).normalized();
  const Eigen::Vector3d other = axis.cross(side);
  const Eigen::Vector3d away = math::cos(turn_rad) * side + math::sin(turn_rad) * other;
  return math::cos(angle_rad) * axis + math::sin(angle_rad) * away;
}

double varied(double middle, double ratio, RandomStream& random) {
  return middle * (1.0 + ratio * random.uniform(-1.0, 1.0));
}

}  // namespace avoidbench
