#include "geometry/cone_triangle.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Least distance to where the cone's surface cuts an edge; +inf if it does not.
double distance_to_edge(const Vector3d& axis, double cosine, const Vector3d& from,
                        const Vector3d& to) {
  // (p · axis)² = cosine² p² on p = from + t way.
  const Vector3d way = to - from;
  const double square = cosine * cosine;
  const double a = way.dot(axis) * way.dot(axis) - square * way.squaredNorm();
  const double b = from.dot(axis) * way.dot(axis) - square * from.dot(way);
  const double c = from.dot(axis) * from.dot(axis) - square * from.squaredNorm();
  const double root = b * b - a * c;
  if (root < 0.0) return kInfinity;
  // Without the difference of two nearly equal numbers; a is 0 where the edge is as steep as the
  // cone.
  const double q = -(b + std::copysign(std::sqrt(root), b));
  double least = kInfinity;
  for (const double t : {a != 0.0 ? q / a : kInfinity, q != 0.0 ? c / q : kInfinity}) {
    if (!(t >= 0.0 && t <= 1.0)) continue;
    const Vector3d point = from + t * way;
    // The equation has the cone's mirror image, too.
    if (point.dot(axis) > 0.0) least = std::min(least, point.norm());
  }
  return least;
}

/// Distance to the point of the cone's surface that is nearest on the triangle's plane; +inf if it
/// is not on the triangle.
double distance_inside(const Vector3d& axis, double cosine, const Triangle& triangle) {
  Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double twice_area = normal.norm();
  // No plane; its edges count.
  if (twice_area < 1e-15) return kInfinity;
  normal /= twice_area;
  double height = normal.dot(triangle[0]);
  if (height < 0.0) {
    height = -height;
    normal = -normal;
  }
  // Of all directions on the cone, the one nearest to the normal meets the plane first.
  Vector3d aside = normal - normal.dot(axis) * axis;
  if (aside.norm() < 1e-12) aside = axis.unitOrthogonal();  // a circle: all of it is as near
  const Vector3d ray = cosine * axis + std::sqrt(1.0 - cosine * cosine) * aside.normalized();
  const double rise = ray.dot(normal);
  // It never meets the plane, or the apex is in it.
  if (rise <= 1e-12 || height <= 1e-12) return kInfinity;
  const double far = height / rise;
  const Vector3d point = far * ray;
  return (closest_point(point, triangle) - point).norm() <= 1e-9 * (1.0 + far) ? far : kInfinity;
}

}  // namespace

double distance(const ConeShell& shell, const Triangle& triangle) {
  // The nearest point of all, if the shell has it; else the nearest lies on one of the cones.
  const Vector3d nearest = closest_point(Vector3d::Zero(), triangle);
  const double along = nearest.dot(shell.axis), away = nearest.norm();
  if (along >= shell.cos_outer * away && along <= shell.cos_inner * away) return away;
  double least = kInfinity;
  for (const double cosine : {shell.cos_inner, shell.cos_outer}) {
    // A cone of no opening is only its axis.
    if (cosine >= 1.0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      least =
          std::min(least, distance_to_edge(shell.axis, cosine, triangle[i], triangle[(i + 1) % 3]));
    }
    least = std::min(least, distance_inside(shell.axis, cosine, triangle));
  }
  return least;
}

}  // namespace avoidbench
