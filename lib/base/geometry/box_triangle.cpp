#include "geometry/box_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// Whether `axis` separates the box from the triangle.
bool separates(const Vector3d& axis, const Vector3d& half_extents, const Triangle& triangle) {
  const double a = axis.dot(triangle[0]);
  const double b = axis.dot(triangle[1]);
  const double c = axis.dot(triangle[2]);
  // The box's half shadow on the axis; the triangle's is between its least and greatest corner.
  const double reach = half_extents.dot(axis.cwiseAbs());
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

/// Squared distance between two segments p0p1 and q0q1 (Ericson §5.1.9).
double squared_segment_distance(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0,
                                const Vector3d& q1) {
  const Vector3d d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  // Squares of lengths below a picometre: such a segment is a point.
  constexpr double kTiny = 1e-24;
  double s = 0.0, t = 0.0;
  if (a <= kTiny && e <= kTiny) return r.squaredNorm();
  if (a <= kTiny) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else {
    const double c = d1.dot(r);
    if (e <= kTiny) {
      s = std::clamp(-c / a, 0.0, 1.0);
    } else {
      const double b = d1.dot(d2);
      const double denominator = a * e - b * b;
      // Parallel segments have it 0: any s is as good, and t follows.
      if (denominator > kTiny) s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
      t = (b * s + f) / e;
      if (t < 0.0) {
        t = 0.0;
        s = std::clamp(-c / a, 0.0, 1.0);
      } else if (t > 1.0) {
        t = 1.0;
        s = std::clamp((b - c) / a, 0.0, 1.0);
      }
    }
  }
  return (p0 + d1 * s - q0 - d2 * t).squaredNorm();
}

}  // namespace

/// By the region that the point is in (Ericson §5.1.5): beyond a corner, beside an edge, or above
/// the face. vc, vb and va are twice the areas of its barycentric parts.
Vector3d closest_point(const Vector3d& point, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  // Beyond corner a.
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  // Beyond corner b.
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  // Beside edge ab.
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  // Beyond corner c.
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  // Beside edge ac.
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  // Beside edge bc.
  if (va <= 0.0 && (d4 - d3) >= 0.0 && (d5 - d6) >= 0.0) {
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  // Above the face.
  const double inverse = 1.0 / (va + vb + vc);
  return a + ab * (vb * inverse) + ac * (vc * inverse);
}

/// Separating axes (Akenine-Möller 2001): the box's three, the triangle's normal, and the nine
/// products of their edges.
bool overlaps(const Vector3d& half_extents, const Triangle& triangle) {
  const std::array<Vector3d, 3> edges{triangle[1] - triangle[0], triangle[2] - triangle[1],
                                      triangle[0] - triangle[2]};
  for (int i = 0; i < 3; ++i) {
    if (separates(Vector3d::Unit(i), half_extents, triangle)) return false;
  }
  if (separates(edges[0].cross(edges[1]), half_extents, triangle)) return false;
  for (const Vector3d& edge : edges) {
    for (int i = 0; i < 3; ++i) {
      if (separates(Vector3d::Unit(i).cross(edge), half_extents, triangle)) return false;
    }
  }
  return true;
}

double distance(const Vector3d& half_extents, const Triangle& triangle) {
  if (overlaps(half_extents, triangle)) return 0.0;
  // Squared until the end. Two convex solids that do not overlap are nearest at a corner of one
  // against a face of the other, or between two edges.
  double best = std::numeric_limits<double>::infinity();
  // A corner of the triangle against the box.
  for (const Vector3d& corner : triangle) {
    const Vector3d inside = corner.cwiseMax(-half_extents).cwiseMin(half_extents);
    best = std::min(best, (corner - inside).squaredNorm());
  }
  // A corner of the box against the triangle, and the box's edges against the triangle's.
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner(((i & 1) != 0 ? 1 : -1) * half_extents.x(),
                          ((i & 2) != 0 ? 1 : -1) * half_extents.y(),
                          ((i & 4) != 0 ? 1 : -1) * half_extents.z());
    best = std::min(best, (corner - closest_point(corner, triangle)).squaredNorm());
    for (int axis = 0; axis < 3; ++axis) {
      if ((i & (1 << axis)) != 0) continue;  // each edge once, from its low end
      Vector3d end = corner;
      end[axis] = half_extents[axis];
      for (std::size_t k = 0; k < 3; ++k) {
        best = std::min(best,
                        squared_segment_distance(corner, end, triangle[k], triangle[(k + 1) % 3]));
      }
    }
  }
  return std::sqrt(best);
}

}  // namespace avoidbench
