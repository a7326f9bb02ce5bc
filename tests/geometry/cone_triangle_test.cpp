#include "geometry/cone_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

ConeShell shell_of(double inner_deg, double outer_deg) {
  return {.axis = Vector3d::UnitX(),
          .cos_inner = math::cos(inner_deg * math::kDegree),
          .cos_outer = math::cos(outer_deg * math::kDegree)};
}

/// A triangle across the axis, 2 m ahead, that fills the whole view.
const Triangle kWall{Vector3d(2, -50, -50), Vector3d(2, 50, -50), Vector3d(2, 0, 90)};

TEST(ConeTriangle, OfAWallIsAtTheInnerAngle) {
  EXPECT_NEAR(distance(shell_of(0, 15), kWall), 2.0, 1e-12);
  EXPECT_NEAR(distance(shell_of(15, 30), kWall), 2.0 / std::cos(15 * math::kDegree), 1e-9);
}

TEST(ConeTriangle, IsNoneBehindAndBeside) {
  const Triangle behind{Vector3d(-2, -50, -50), Vector3d(-2, 50, -50), Vector3d(-2, 0, 90)};
  EXPECT_TRUE(std::isinf(distance(shell_of(0, 15), behind)));
  EXPECT_TRUE(std::isinf(distance(shell_of(15, 30), behind)));
  const Triangle ahead{Vector3d(2, -0.1, -0.1), Vector3d(2, 0.1, -0.1), Vector3d(2, 0, 0.1)};
  EXPECT_TRUE(std::isinf(distance(shell_of(15, 30), ahead)));
}

TEST(ConeTriangle, AgreesWithManyPoints) {
  RandomStream draws = stream(3, "triangles");
  int inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double size_m = draws.uniform(0.1, 3.0);
    const Vector3d middle(draws.uniform(-1.0, 4.0), 2.0 * draws.normal(), 2.0 * draws.normal());
    Triangle corners;
    for (Vector3d& corner : corners) {
      corner = middle + size_m * Vector3d(draws.normal(), draws.normal(), draws.normal());
    }
    const ConeShell shell = trial % 2 == 0 ? shell_of(0, 20) : shell_of(20, 40);
    double brute = HUGE_VAL;
    constexpr int kParts = 300;
    for (int i = 0; i <= kParts; ++i) {
      for (int k = 0; i + k <= kParts; ++k) {
        const Vector3d point = corners[0] + (corners[1] - corners[0]) * i / kParts +
                               (corners[2] - corners[0]) * k / kParts;
        const double cosine = point.dot(shell.axis) / point.norm();
        if (cosine >= shell.cos_outer && cosine <= shell.cos_inner) {
          brute = std::min(brute, point.norm());
        }
      }
    }
    const double found = distance(shell, corners);
    EXPECT_LE(found, brute + 1e-9);
    if (std::isinf(brute)) continue;  // at most a sliver
    ++inside;
    const double spacing_m = 6.0 * size_m / kParts;
    EXPECT_GE(found, brute - 3.0 * spacing_m) << trial;
  }
  EXPECT_GT(inside, 60);
}

}  // namespace
}  // namespace avoidbench
