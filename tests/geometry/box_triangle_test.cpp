#include "geometry/box_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Vector3d random_point(RandomStream& draws, double reach) {
  Vector3d point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = draws.uniform(-reach, reach);
  return point;
}

/// Points spread over the triangle.
template <class Visit>
void for_each_sample(const Triangle& triangle, int steps, Visit visit_point) {
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      visit_point(Vector3d(triangle[0] + u * (triangle[1] - triangle[0]) +
                           v * (triangle[2] - triangle[0])));
    }
  }
}

double distance_to_box(const Vector3d& half_extents, const Vector3d& point) {
  return (point - point.cwiseMax(-half_extents).cwiseMin(half_extents)).norm();
}

TEST(ClosestPoint, IsNoFartherThanAnySampleAndOnTheTriangle) {
  RandomStream draws(1);
  for (int i = 0; i < 300; ++i) {
    Triangle triangle;
    for (Vector3d& corner : triangle) corner = random_point(draws, 1.0);
    const Vector3d point = random_point(draws, 2.0);
    const double found = (closest_point(point, triangle) - point).norm();
    double best = 1e9;
    for_each_sample(triangle, 60,
                    [&](const Vector3d& p) { best = std::min(best, (p - point).norm()); });
    EXPECT_LE(found, best + 1e-12);
    EXPECT_GE(found, best - 0.06);
  }
}

TEST(BoxTriangle, DistanceAgreesWithSamplesAndOverlapWithZero) {
  RandomStream draws(2);
  const Vector3d half_extents(0.25, 0.25, 0.06);
  int touching = 0;
  for (int i = 0; i < 600; ++i) {
    Triangle triangle;
    const Vector3d centre = random_point(draws, 0.7);
    for (Vector3d& corner : triangle) corner = centre + random_point(draws, 0.6);
    double best = 1e9;
    for_each_sample(triangle, 80, [&](const Vector3d& p) {
      best = std::min(best, distance_to_box(half_extents, p));
    });
    const double found = distance(half_extents, triangle);
    EXPECT_LE(found, best + 1e-12);
    EXPECT_GE(found, best - 0.03);
    EXPECT_EQ(overlaps(half_extents, triangle), found == 0.0);
    if (found == 0.0) ++touching;
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 550);
}

TEST(BoxTriangle, EdgeThroughTheBoxTouchesThoughNoCornerIsInside) {
  const Vector3d half_extents(0.25, 0.25, 0.06);
  EXPECT_TRUE(overlaps(half_extents, {Vector3d(-1, -1, 0), Vector3d(1, 1, 0), Vector3d(0, 0, 9)}));
  EXPECT_FALSE(
      overlaps(half_extents, {Vector3d(-1, -1, 0.07), Vector3d(1, 1, 0.07), Vector3d(0, 0, 9)}));
  EXPECT_NEAR(
      distance(half_extents, {Vector3d(-1, -1, 0.07), Vector3d(1, 1, 0.07), Vector3d(0, 0, 9)}),
      0.01, 1e-12);
}

TEST(BoxTriangle, DegenerateTrianglesArePointsAndSegments) {
  const Vector3d half_extents(0.5, 0.5, 0.5);
  const Vector3d point(1.0, 0.0, 0.0);
  EXPECT_NEAR(distance(half_extents, {point, point, point}), 0.5, 1e-12);
  EXPECT_NEAR(distance(half_extents, {Vector3d(1, -2, 0), Vector3d(1, 2, 0), Vector3d(1, 2, 0)}),
              0.5, 1e-12);
}

TEST(Pose, YawGoesThereAndBack) {
  for (const double yaw : {-3.0, -0.5, 0.0, 1.0, 3.14}) {
    EXPECT_NEAR(yaw_of(yaw_rotation(yaw)), yaw, 1e-14);
    const Vector3d ahead = yaw_rotation(yaw) * Vector3d::UnitX();
    EXPECT_NEAR(ahead.x(), math::cos(yaw), 1e-15);
    EXPECT_NEAR(ahead.y(), math::sin(yaw), 1e-15);
  }
}

}  // namespace
}  // namespace avoidbench
