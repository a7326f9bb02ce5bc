#include "map_file/polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace avoidbench {
namespace {

/// The corner that both triangles of a quad share: a quad has one concave corner at most.
std::uint32_t shared_corner(const std::vector<Eigen::Vector3f>& corners) {
  // A concave corner's diagonal lies inside, the other one outside.
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto direction_to = [&](std::uint32_t other) {
      const Eigen::Vector3d v = corners[(i + other) % 4].cast<double>() - corners[i].cast<double>();
      return v.normalized().eval();
    };
    const Eigen::Vector3d diagonal = direction_to(2);
    // cos a + cos b < 0: the angles at either side of the diagonal are more than half a turn.
    if (direction_to(1).dot(diagonal) + direction_to(3).dot(diagonal) < 0.0) return i;
  }
  return 0;
}

/// The polygon along the axis that its normal is nearest to, so that it turns counter-clockwise.
std::vector<Eigen::Vector2d> flattened(const std::vector<Eigen::Vector3f>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // by Newell's method
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = corners[i].cast<double>();
    const Eigen::Vector3d b = corners[(i + 1) % corners.size()].cast<double>();
    normal += (a - corners[0].cast<double>()).cross(b - corners[0].cast<double>());
  }
  Eigen::Index up = 0;
  normal.cwiseAbs().maxCoeff(&up);
  // The two other axes, in the order in which the polygon turns counter-clockwise.
  Eigen::Index right = (up + 1) % 3, ahead = (up + 2) % 3;
  if (normal[up] < 0.0) std::swap(right, ahead);
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(corners.size());
  for (const Eigen::Vector3f& corner : corners) flat.emplace_back(corner[right], corner[ahead]);
  return flat;
}

/// Cuts off ears: corners whose triangle turns as the polygon does and holds no other corner, on
/// its border neither.
///
/// Whichever ears are chosen, the triangles' winding numbers sum up to the polygon's. So if none of
/// them turns the other way, those of a polygon that does not cross itself neither overlap nor
/// stick out; and of one with a part that turns the other way, some must.
struct EarCutter {
  const std::vector<Eigen::Vector2d>& corners;
  double slack;  ///< areas (twice) below are taken for none
  std::vector<std::uint32_t> next = {};

  /// Twice the triangle's area; positive where it turns counter-clockwise.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Eigen::Vector2d to_b = corners[b] - corners[a], to_c = corners[c] - corners[a];
    return to_b.x() * to_c.y() - to_b.y() * to_c.x();
  }

  bool is_ear(std::uint32_t before, std::uint32_t ear, std::uint32_t after) const {
    const double area = turn(before, ear, after);
    if (area < -slack) return false;
    if (area <= slack) return true;  // flat: it holds nothing
    for (std::uint32_t i = next[after]; i != before; i = next[i]) {
      // A hole is joined to the border by an edge that is gone along twice: its corners are there
      // twice.
      const bool is_same_place = corners[i] == corners[before] || corners[i] == corners[ear] ||
                                 corners[i] == corners[after];
      if (is_same_place) continue;
      if (turn(before, ear, i) >= -slack && turn(ear, after, i) >= -slack &&
          turn(after, before, i) >= -slack) {
        return false;
      }
    }
    return true;
  }

  bool cut(std::vector<CornerTriple>& triangles) {
    triangles.clear();
    const auto count = static_cast<std::uint32_t>(corners.size());
    next.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) next[i] = (i + 1) % count;
    // A ring of corners that are left; `before` and `ear` go round it.
    std::uint32_t before = count - 1, ear = 0;
    std::uint32_t left = count, refused = 0;
    while (left > 3) {
      const std::uint32_t after = next[ear];
      if (is_ear(before, ear, after)) {
        triangles.push_back({before, ear, after});
        next[before] = after;
        --left;
        refused = 0;
      } else {
        // Once round without an ear: there is none.
        if (++refused == left) return false;
        before = ear;
      }
      ear = after;
    }
    // The last triangle begins with its least number: else its first corner would depend on where
    // the walk stopped.
    const std::uint32_t first = std::min({before, ear, next[ear]});
    triangles.push_back({first, next[first], next[next[first]]});
    return turn(before, ear, next[ear]) >= -slack;
  }
};

/// By how much a triangle's area (twice) may be wrong since coordinates are rounded to single
/// precision: so edges that touch may seem to cross.
double rounding_of(const std::vector<Eigen::Vector2d>& corners) {
  constexpr double kFourUlp = 1.0 / (1U << 21U);
  double farthest = 0.0, extent = 0.0;
  for (const Eigen::Vector2d& corner : corners) {
    farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
    extent = std::max(extent, (corner - corners[0]).cwiseAbs().maxCoeff());
  }
  return kFourUlp * farthest * extent;
}

/// Turns triangles so that none begins at the corner that the one before began with: for no reason
/// but that maps were first read so, and their digests hold the order of corners.
void turn_apart(std::vector<CornerTriple>& triangles) {
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    auto& [a, b, c] = triangles[i];
    if (a == triangles[i - 1][0]) triangles[i] = {c, a, b};
  }
}

}  // namespace

bool cut_polygon(const std::vector<Eigen::Vector3f>& corners,
                 std::vector<CornerTriple>& triangles) {
  if (corners.size() == 3) {
    triangles = {{0, 1, 2}};
    return true;
  }
  if (corners.size() == 4) {
    const std::uint32_t i = shared_corner(corners);
    triangles = {{i, (i + 1) % 4, (i + 2) % 4}, {i, (i + 2) % 4, (i + 3) % 4}};
    return true;
  }
  const std::vector<Eigen::Vector2d> flat = flattened(corners);
  // Exactly first: slack is only for polygons that need it.
  if (!EarCutter{flat, 0.0}.cut(triangles) && !EarCutter{flat, rounding_of(flat)}.cut(triangles)) {
    return false;
  }
  turn_apart(triangles);
  return true;
}

}  // namespace avoidbench
