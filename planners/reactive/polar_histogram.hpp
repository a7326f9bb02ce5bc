#pragma once

#include <vector>

#include "vector3.hpp"

namespace reactive {

/// For directions on a grid of azimuth and elevation about the vehicle, world-aligned: how far the
/// body can fly along each before it touches a point. A point at distance d blocks the directions
/// within asin(radius / d) of it (the enlargement of VFH+, Ulrich and Borenstein 1998, here in
/// three dimensions and with the exact distance at which the body touches).
class PolarHistogram {
 public:
  static constexpr int kAzimuths = 72;  ///< 5° each; the first is +x, the others counter-clockwise
  static constexpr int kElevations = 11;  ///< from -25° to 25°
  static constexpr int kDirections = kAzimuths * kElevations;

  PolarHistogram();

  /// All directions free up to `range_m`.
  void clear(double range_m);

  /// Blocks what `point`, relative to the vehicle, blocks for a ball of `radius_m`. A point nearer
  /// than that blocks only what leads nearer to it, so that a body that came too near can still
  /// leave along the surface.
  void add(const Vector3& point, double radius_m);

  const Vector3& direction(int index) const { return directions_[static_cast<std::size_t>(index)]; }
  double free_m(int index) const { return free_m_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<Vector3> directions_;  // azimuth-major: index = azimuth · kElevations + elevation
  std::vector<double> free_m_;
  double range_m_ = 0.0;
};

/// How far a ball of `radius_m` gets along the unit vector `along` before it touches one of the
/// points; at most `range_m`.
double free_distance(const std::vector<Vector3>& points, const Vector3& from, const Vector3& along,
                     double radius_m, double range_m);

}  // namespace reactive
