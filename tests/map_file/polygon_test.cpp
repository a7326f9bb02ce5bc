#include "map_file/polygon.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

using Polygon = std::vector<Eigen::Vector2f>;
using Triples = std::vector<CornerTriple>;

const Polygon kDart{{0, 0}, {4, 0}, {1, 1}, {0, 4}};  // concave at its third corner
const Polygon kL{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
const Polygon kSpiral{{0, 0}, {8, 0}, {8, 8}, {2, 8}, {2, 4},
                      {4, 4}, {4, 6}, {6, 6}, {6, 2}, {0, 2}};
const Polygon kComb{{0, 0}, {1, 0}, {1, 3}, {2, 3}, {2, 0}, {3, 0},
                    {3, 3}, {4, 3}, {4, 0}, {5, 0}, {5, 5}, {0, 5}};
// A square with a square hole, joined by an edge that is there and back.
const Polygon kKeyhole{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0},
                       {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
const Polygon kMiddles{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 2}, {4, 4}, {0, 4}};

/// In the plane z = (x + 2 y) / 4, or upside down: the corners the other way round.
std::vector<Eigen::Vector3f> tilted(const Polygon& polygon, bool is_upside_down = false) {
  std::vector<Eigen::Vector3f> corners;
  for (const Eigen::Vector2f& p : polygon) {
    corners.emplace_back(p.x(), p.y(), 0.25F * p.x() + 0.5F * p.y());
  }
  if (is_upside_down) std::reverse(corners.begin(), corners.end());
  return corners;
}

Triples cut(const std::vector<Eigen::Vector3f>& corners) {
  Triples triangles;
  EXPECT_TRUE(cut_polygon(corners, triangles));
  return triangles;
}

double twice_area(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector2d u = (b - a).head<2>().cast<double>(), v = (c - a).head<2>().cast<double>();
  return u.x() * v.y() - u.y() * v.x();
}

double area_from_above(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i].cast<double>();
    const Eigen::Vector2d b = polygon[(i + 1) % polygon.size()].cast<double>();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// How many triangles hold the point, as seen from above.
int count_over(const Triples& triangles, const std::vector<Eigen::Vector3f>& corners,
               const Eigen::Vector3f& point) {
  int count = 0;
  for (const auto& [a, b, c] : triangles) {
    const double side = twice_area(corners[a], corners[b], corners[c]) < 0.0 ? -1.0 : 1.0;
    count += side * twice_area(corners[a], corners[b], point) > 0.0 &&
                     side * twice_area(corners[b], corners[c], point) > 0.0 &&
                     side * twice_area(corners[c], corners[a], point) > 0.0
                 ? 1
                 : 0;
  }
  return count;
}

/// Whether the point is inside, by the edges that a ray from it crosses.
bool is_inside(const Polygon& polygon, const Eigen::Vector3f& from) {
  const Eigen::Vector3d point = from.cast<double>();
  bool is_odd = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i].cast<double>();
    const Eigen::Vector2d b = polygon[(i + 1) % polygon.size()].cast<double>();
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) is_odd = !is_odd;
  }
  return is_odd;
}

/// The triangles are as many as can be, turn as the polygon does, have its area, and cover it once
/// and nothing else.
void expect_cover(const Polygon& polygon, const std::string& name) {
  RandomStream draws = stream(5, name);
  for (const bool is_upside_down : {false, true}) {
    const std::vector<Eigen::Vector3f> corners = tilted(polygon, is_upside_down);
    const Triples triangles = cut(corners);
    EXPECT_EQ(triangles.size(), polygon.size() - 2) << name;
    const double side = is_upside_down ? -1.0 : 1.0;
    double area = 0.0;
    for (const auto& [a, b, c] : triangles) {
      const double own = 0.5 * side * twice_area(corners[a], corners[b], corners[c]);
      EXPECT_GE(own, 0.0) << name;
      area += own;
    }
    EXPECT_NEAR(area, area_from_above(polygon), 1e-6 * area) << name;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3f point(static_cast<float>(draws.uniform(-9.0, 9.0)),
                                  static_cast<float>(draws.uniform(-9.0, 9.0)), 0.0F);
      EXPECT_EQ(count_over(triangles, corners, point), is_inside(polygon, point) ? 1 : 0) << name;
    }
  }
}

TEST(Polygon, TrianglesAndConvexQuadsAreCutFromTheirFirstCorner) {
  EXPECT_EQ(cut(tilted({{0, 0}, {4, 0}, {0, 4}})), (Triples{{0, 1, 2}}));
  EXPECT_EQ(cut(tilted({{0, 0}, {4, 0}, {4, 3}, {0, 3}})), (Triples{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, AConcaveQuadIsCutAtItsConcaveCorner) {
  for (std::uint32_t first = 0; first < 4; ++first) {
    Polygon turned = kDart;
    std::rotate(turned.begin(), turned.begin() + first, turned.end());
    const std::uint32_t i = (2 + 4 - first) % 4;
    const Triples expected{{i, (i + 1) % 4, (i + 2) % 4}, {i, (i + 2) % 4, (i + 3) % 4}};
    EXPECT_EQ(cut(tilted(turned)), expected) << first;
    expect_cover(turned, "dart");
  }
}

/// Digests of maps hold this order.
TEST(Polygon, ALargerPolygonLosesEarsFromItsFirstCornerOn) {
  const Polygon pentagon{{2, 0}, {4, 2}, {3, 4}, {1, 4}, {0, 2}};
  EXPECT_EQ(cut(tilted(pentagon)), (Triples{{4, 0, 1}, {2, 4, 1}, {4, 2, 3}}));
  EXPECT_EQ(cut(tilted(kL)), (Triples{{0, 1, 2}, {3, 0, 2}, {0, 3, 4}, {5, 0, 4}}));
}

TEST(Polygon, ConcavePolygonsAreCoveredOnce) {
  expect_cover(kL, "L");
  expect_cover(kSpiral, "spiral");
  expect_cover(kComb, "comb");
  expect_cover(kKeyhole, "keyhole");
  expect_cover(kMiddles, "middles");
  EXPECT_EQ(area_from_above(kKeyhole), 32.0);
}

TEST(Polygon, RandomStarsAreCoveredOnce) {
  RandomStream draws = stream(8, "stars");
  for (int count = 5; count < 80; count += 3) {
    Polygon star;
    for (int i = 0; i < count; ++i) {
      const double angle = math::kTau * i / count;
      const double radius = draws.uniform(1.0, 8.0);
      star.emplace_back(static_cast<float>(radius * math::cos(angle)),
                        static_cast<float>(radius * math::sin(angle)));
    }
    expect_cover(star, "star of " + std::to_string(count));
  }
}

TEST(Polygon, EdgesThatCrossAreRefused) {
  Triples triangles;
  EXPECT_FALSE(cut_polygon(tilted({{0, 0}, {4, 0}, {0, 3}, {4, 4}, {2, -2}}), triangles));
  // An 8 whose halves turn against each other.
  EXPECT_FALSE(cut_polygon(tilted({{0, 0}, {4, 4}, {6, 4}, {6, 0}, {4, 0}, {0, 4}}), triangles));
}

TEST(Polygon, EdgesThatCrossByRoundingAreNone) {
  // The last corner is a hair inside of the first edge.
  const float hair = 1e-7F;
  const Polygon sliver{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, -hair}, {1, hair}};
  EXPECT_EQ(cut(tilted(sliver)).size(), 4U);
}

TEST(Polygon, OneWithoutAnAreaIsCutToTrianglesWithout) {
  const std::vector<Eigen::Vector3f> line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {4, 4, 4}};
  EXPECT_EQ(cut(line).size(), 3U);
  EXPECT_EQ(cut(std::vector<Eigen::Vector3f>(7, {1, 2, 3})).size(), 5U);
}

}  // namespace
}  // namespace avoidbench
