#include "metrics/difficulty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.hpp"
#include "metrics/environment.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

TEST(AngleOverLength, OfStraightAndBentPaths) {
  EXPECT_EQ(angle_over_length_1pm({{0, 0, 2}, {0, 5, 2}, {0, 9, 2}}), 0.0);
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 2}, {0, 5, 2}, {5, 5, 2}}), (std::exp(1.0) - 1.0) / 10,
              1e-12);
  // There and back again, and a bend upward.
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 0}, {0, 4, 0}, {0, 0, 0}}), (std::exp(2.0) - 1.0) / 8,
              1e-12);
  EXPECT_NEAR(angle_over_length_1pm({{0, 0, 0}, {0, 1, 0}, {0, 2, 1}}),
              (std::exp(0.5) - 1.0) / (1.0 + std::sqrt(2.0)), 1e-12);
}

TEST(ViewOcclusion, IsNothingInTheOpen) {
  const World world = test::flight_world();
  const Scene scene(world);
  EXPECT_EQ(view_occlusion(scene, {{0, -10, 6}, {0, 10, 6}}), 0.0);
}

TEST(ViewOcclusion, OfAWallAhead) {
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh({20, 1, 10}), {0, 0.5, 5}, "wall");
  const Scene scene(world);
  // One place, 2 m before the wall, whose nearest point in a ring lies at the ring's inner edge.
  const double found = view_occlusion(scene, {{0, -2.2, 6}, {0, -1.8, 6}});
  const auto inverse = [](double degrees) { return std::cos(degrees * math::kDegree) / 2.0; };
  const double exact =
      4.0 * (0.55 * inverse(0) + 0.3 * inverse(15) + 0.1 * inverse(22.5) + 0.05 * inverse(30));
  EXPECT_NEAR(found, exact, 1e-6 * exact);
  EXPECT_EQ(view_occlusion(scene, {{0, -1.8, 6}, {0, -2.2, 6}}), 0.0);  // away from it
}

TEST(ViewOcclusion, OfAPoleBetweenRays) {
  // 1 cm thick, 3 m away and 33.1° to the left: in the outermost ring alone, at the height of view.
  World world = test::flight_world();
  const double angle = 33.1 * math::kDegree, away_m = 3.0;
  test::add_obstacle(world, test::box_mesh({0.01F, 0.01F, 0.01F}),
                     {-away_m * std::sin(angle), away_m * std::cos(angle), 6.0}, "twig");
  const Scene scene(world);
  const double found = view_occlusion(scene, {{0, -0.2, 6}, {0, 0.2, 6}});
  EXPECT_NEAR(found, 0.05 * 4.0 / away_m, 0.005 * found);
}

TEST(ViewOcclusion, OfABall) {
  // Fine facets of a ball ahead: the middle ring sees its front, the next its flank or nothing.
  World world = test::flight_world();
  TriangleMesh ball;
  constexpr int kRows = 90, kColumns = 180;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double polar = math::kPi * row / kRows, azimuth = math::kTau * column / kColumns;
      ball.vertices.emplace_back(Vector3d(math::sin(polar) * math::cos(azimuth),
                                          math::sin(polar) * math::sin(azimuth), math::cos(polar))
                                     .cast<float>());
    }
  }
  for (unsigned row = 0; row < kRows; ++row) {
    for (unsigned column = 0; column < kColumns; ++column) {
      const unsigned next = (column + 1) % kColumns;
      const unsigned a = row * kColumns + column, b = row * kColumns + next;
      ball.triangles.push_back({a, a + kColumns, b + kColumns});
      ball.triangles.push_back({a, b + kColumns, b});
    }
  }
  test::add_obstacle(world, ball, {0, 3, 6}, "ball");
  const Scene scene(world);
  const double found = view_occlusion(scene, {{0, -0.2, 6}, {0, 0.2, 6}});
  // A ring's nearest point lies at its inner angle; a ball of 1 m 3 m away ends at 19.5°.
  const double ring = 15.0 * math::kDegree;
  const double flank_m = 3.0 * std::cos(ring) - std::sqrt(1.0 - std::pow(3.0 * std::sin(ring), 2));
  const double exact = 4.0 * (0.55 / 2.0 + 0.3 / flank_m);
  EXPECT_NEAR(found, exact, 1e-3 * exact);
}

/// The nearest of many points of all triangles, ring by ring.
double brute_force_occlusion(const Scene& scene, const Vector3d& place, const Vector3d& direction) {
  constexpr std::array<double, 5> kEdges_deg{0.0, 15.0, 22.5, 30.0, 36.0};
  constexpr std::array<double, 4> kWeights{0.55, 0.3, 0.1, 0.05};
  constexpr double kFine_m = 0.004;
  std::array<double, 4> nearest_m;
  nearest_m.fill(HUGE_VAL);
  scene.visit_triangles(place, 4.0, [&](const Triangle& corners) {
    const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
    const auto parts = [](const Vector3d& side) {
      return 1 + static_cast<int>(std::min(300.0, side.norm() / kFine_m));
    };
    const int along_u = parts(u), along_v = parts(v);
    for (int i = 0; i <= along_u; ++i) {
      const double share = static_cast<double>(i) / along_u;
      for (int k = 0; k <= along_v; ++k) {
        const Vector3d to = corners[0] + share * u + (1.0 - share) * k * v / along_v - place;
        const double far_m = to.norm();
        const double angle_deg =
            std::acos(std::clamp(to.dot(direction) / far_m, -1.0, 1.0)) / math::kDegree;
        for (std::size_t ring = 0; ring < 4; ++ring) {
          const bool is_in = angle_deg >= kEdges_deg[ring] && angle_deg <= kEdges_deg[ring + 1];
          if (is_in && far_m <= 4.0) nearest_m[ring] = std::min(nearest_m[ring], far_m);
        }
      }
    }
    return 4.0;
  });
  double sum = 0.0;
  for (std::size_t ring = 0; ring < 4; ++ring) sum += kWeights[ring] * 4.0 / nearest_m[ring];
  return sum;
}

TEST(ViewOcclusion, AgreesWithAllPointsOfATwiggyWorld) {
  const World world = make_world(PolesSpec{.area_m = {10.0, 14.0}, .poisson_radius_m = 1.4}, 3);
  const Scene scene(world);
  RandomStream draws = stream(5, "views");
  for (int i = 0; i < 4; ++i) {
    const Vector3d place(draws.uniform(2.0, 8.0), draws.uniform(3.0, 10.0),
                         draws.uniform(1.0, 3.0));
    const Vector3d direction =
        Vector3d(draws.normal(), draws.normal(), 0.3 * draws.normal()).normalized();
    const double found = view_occlusion(scene, {place - 0.1 * direction, place + 0.1 * direction});
    const double brute = brute_force_occlusion(scene, place, direction);
    EXPECT_GE(found, brute - 1e-9);
    EXPECT_LE(found, 1.01 * brute + 1e-9);
  }
}

TEST(TraversabilityObstruction, IsOneHalfInTheOpen) {
  World world = test::flight_world();
  world.bounds.extend(Vector3d(0, 0, 30));
  const Scene scene(world);
  EXPECT_NEAR(traversability_obstruction(scene, {{0, -15, 12}, {0, 15, 12}}, 0.25, 1), 0.5, 1e-12);
}

/// Between two walls `gap_m` apart every sphere has the same radius.
double between_walls(double gap_m, std::uint64_t seed) {
  World world = test::flight_world();
  for (const double side : {-1.0, 1.0}) {
    test::add_obstacle(world, test::box_mesh({1, 40, 20}), {side * (0.5 * gap_m + 0.5), 0, 5},
                       "wall");
  }
  const Scene scene(world);
  return traversability_obstruction(scene, {{0, -15, 6}, {0, 15, 6}}, 0.25, seed);
}

TEST(TraversabilityObstruction, OfACorridorFollowsItsWidth) {
  for (const double gap_m : {1.5, 2.5, 4.0}) {
    const double least = 4.0 / (2.0 * (0.5 * gap_m - 0.25));  // of spheres on the middle line
    const double found = between_walls(gap_m, 1);
    EXPECT_GE(found, least - 1e-9) << gap_m;
    EXPECT_LE(found, 1.1 * least) << gap_m;
  }
}

TEST(TraversabilityObstruction, DependsOnItsSeedAlone) {
  EXPECT_EQ(between_walls(2.0, 7), between_walls(2.0, 7));
  EXPECT_NE(between_walls(2.0, 7), between_walls(2.0, 8));
}

TEST(TraversabilityPointcloud, OfAnEmptyWorldIsItsOwnNorm) {
  const World world = test::flight_world();
  const Traversability found =
      traversability_pointcloud(world, 0.35, body_measure({0.5, 0.5, 0.1}));
  EXPECT_EQ(found.normalized_ratio, 1.0);
  // Along y from row i of 39: whole steps to the sides, 40 m in all; slantwise √2 as far at most.
  EXPECT_GT(found.value, 15.0 / std::sqrt(0.5));
  EXPECT_LT(found.value, 22.0 / std::sqrt(0.5));
}

TEST(TraversabilityPointcloud, IsALittleAboveTheExactOne) {
  World world = test::flight_world();
  world.flight_bounds = Aabb(Vector3d(-20, -20, 1.5), Vector3d(20, 20, 2.5));
  for (int i = -2; i <= 2; ++i) {
    for (int k = -2; k <= 2; ++k) {
      const Vector3d place(7.0 * i + 0.3 * k, 7.0 * k, 0.0);
      test::add_obstacle(world, test::cylinder_mesh(0.6, 9.0, 64), place, "cylinder");
    }
  }
  const Scene scene(world);
  const BodyMeasure body = body_measure({0.5, 0.5, 0.12});
  ClearanceGrid grid(scene, world.bounds, 0.2);
  const double exact = traversability(scene, grid, body).normalized_ratio;
  const double points = traversability_pointcloud(world, 0.25, body).normalized_ratio;
  // Its last step ends at the obstacle, and its points keep a smaller distance than the body.
  EXPECT_GT(points, exact);
  EXPECT_LT(points, 1.15 * exact);
  EXPECT_LT(traversability_pointcloud(world, 0.5, body).normalized_ratio, points);
}

}  // namespace
}  // namespace avoidbench
