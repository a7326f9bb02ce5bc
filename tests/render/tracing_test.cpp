#include "render/tracing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "render/ray_tracing_isa.hpp"
#include "render/rays.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Integers = Eigen::Matrix<std::int64_t, 3, 1>;

/// Where a ray meets a triangle: the ray's parameter as an exact fraction.
struct Fraction {
  std::int64_t numerator, denominator;  ///< the latter is positive
};

bool operator<(const Fraction& a, const Fraction& b) {
  return a.numerator * b.denominator < b.numerator * a.denominator;
}

using ExactTriangle = std::array<Integers, 3>;

/// In integers, so that nothing is rounded. Its boundary belongs to the triangle.
std::optional<Fraction> meeting(const Integers& origin, const Integers& direction,
                                const ExactTriangle& triangle) {
  const Integers a = triangle[0] - origin, b = triangle[1] - origin, c = triangle[2] - origin;
  const Integers normal = (b - a).cross(c - a);
  const std::int64_t slope = normal.dot(direction);
  if (slope == 0) return std::nullopt;
  const std::int64_t sign = slope > 0 ? 1 : -1;
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    if (sign * p.cross(q).dot(direction) < 0) return std::nullopt;
  }
  const Fraction at{sign * normal.dot(a), sign * slope};
  if (at.numerator <= 0) return std::nullopt;
  return at;
}

constexpr int kCells = 6;    ///< of the terrain each way
constexpr int kCell = 4;     ///< [m]
constexpr int kCopies = 3;   ///< in one place
constexpr int kHighest = 8;  ///< corner [m]

/// A terrain of triangles with integer corners, several times in one place: each ray meets several
/// triangles at one distance, and where it goes through a corner, all around it.
struct Terrain {
  explicit Terrain(std::uint64_t seed) {
    RandomStream random(seed);
    TriangleMesh mesh;
    for (int y = 0; y <= kCells; ++y) {
      for (int x = 0; x <= kCells; ++x) {
        const Integers corner(kCell * x, kCell * y,
                              static_cast<int>(random.uniform(0.0, kHighest)));
        corners.push_back(corner);
        mesh.vertices.push_back(corner.cast<float>());
      }
    }
    const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * (kCells + 1) + x); };
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
        mesh.triangles.push_back({at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)});
      }
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      triangles.push_back({corners[a], corners[b], corners[c]});
    }
    world.prototypes.push_back(test::make_prototype(mesh));
    for (int i = 0; i < kCopies; ++i) world.instances.push_back(Instance{});
  }

  std::vector<Integers> corners;
  std::vector<ExactTriangle> triangles;
  World world;
};

struct ExactRay {
  Integers origin, direction;
};

/// From above and from the sides to corners, to middles of edges, and beside them.
std::vector<ExactRay> rays_to(const Terrain& terrain, RandomStream& random) {
  const auto whole = [&random](int low, int high) {
    return static_cast<std::int64_t>(random.uniform(low, high));
  };
  std::vector<ExactRay> rays;
  for (int i = 0; i < 4000; ++i) {
    const auto pick =
        static_cast<std::size_t>(whole(0, static_cast<int>(terrain.triangles.size())));
    const ExactTriangle& triangle = terrain.triangles[pick];
    // Above all triangles or below, not on one.
    const std::int64_t height = i % 2 == 0 ? whole(kHighest + 1, 20) : whole(-4, 0) - 1;
    const Integers origin(whole(-10, 34), whole(-10, 34), height);
    // Twice the way to the middle of an edge, or of a corner (an edge from it to itself).
    const auto first = static_cast<std::size_t>(whole(0, 3)),
               second = static_cast<std::size_t>(whole(0, 3));
    Integers direction = triangle[first] + triangle[second] - 2 * origin;
    if (i % 3 == 0) direction.x() += whole(0, 3) - 1;
    if (direction.squaredNorm() > 0) rays.push_back({origin, direction});
  }
  return rays;
}

class ExactHits : public testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(Both, ExactHits, testing::Values(0, 1000000), [](const auto& suite) {
  return suite.param == 0 ? "Instanced" : "Flattened";
});

/// Embree's float arithmetic misses some of these rays or takes any of the copies.
TEST_P(ExactHits, AreThoseOfIntegerArithmetic) {
  const Terrain terrain(3);
  const Scene scene(terrain.world, GetParam());
  RandomStream random(4);
  const std::vector<ExactRay> exact = rays_to(terrain, random);
  std::vector<Ray> rays;
  for (const ExactRay& ray : exact) {
    rays.push_back({ray.origin.cast<double>(), ray.direction.cast<double>()});
  }
  std::vector<RayHit> hits(rays.size());
  first_hits(scene, rays, 1e3, hits);
  int through_corners = 0, missed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::optional<Fraction> nearest;
    std::vector<std::uint32_t> met;
    for (std::uint32_t k = 0; k < terrain.triangles.size(); ++k) {
      const auto at = meeting(exact[i].origin, exact[i].direction, terrain.triangles[k]);
      if (!at || (nearest && *nearest < *at)) continue;
      if (!nearest || *at < *nearest) met.clear();
      nearest = at;
      met.push_back(k);
    }
    ASSERT_EQ(std::isfinite(hits[i].distance_m), nearest.has_value()) << i;
    missed += nearest ? 0 : 1;
    if (!nearest) continue;
    EXPECT_EQ(hits[i].instance, 0U) << "of copies the first";
    EXPECT_NE(std::find(met.begin(), met.end(), hits[i].triangle), met.end()) << i;
    through_corners += met.size() > 2 ? 1 : 0;
    const double distance =
        static_cast<double>(nearest->numerator) / static_cast<double>(nearest->denominator);
    EXPECT_NEAR(hits[i].distance_m, distance, 1e-12 * distance);
    // Whole numbers again, or the ray would be another one in float.
    const Vector3d beyond = rays[i].origin_world + std::ceil(distance) * rays[i].direction_world;
    EXPECT_TRUE(scene.occluded(rays[i].origin_world, beyond)) << i;
  }
  EXPECT_GT(through_corners, 300);
  EXPECT_GT(missed, 50);
}

/// Nothing passes between triangles, wherever it is aimed.
TEST_P(ExactHits, LeaveNoGapInASphere) {
  World world;
  world.prototypes.push_back(test::make_prototype(test::sphere_mesh(4)));
  world.instances.push_back(Instance{});
  const Scene scene(world, GetParam());
  RandomStream random(8);
  const TriangleMesh& mesh = world.prototypes[0].mesh;
  std::vector<Ray> rays;
  for (const auto& triangle : mesh.triangles) {
    const Vector3d inside = test::random_point(random, 0.3);
    const Vector3d a = mesh.vertices[triangle[0]].cast<double>(),
                   b = mesh.vertices[triangle[1]].cast<double>();
    const double part = random.uniform();
    for (const Vector3d& to : {a, Vector3d(a + part * (b - a)), test::random_point(random, 5.0)}) {
      rays.push_back({inside, to - inside});
    }
  }
  std::vector<RayHit> hits(rays.size());
  first_hits(scene, rays, 1e3, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(std::isfinite(hits[i].distance_m)) << i;
    EXPECT_NEAR((rays[i].origin_world + hits[i].distance_m * rays[i].direction_world).norm(), 1.0,
                0.01);
  }
}

/// Eight rays as kernels take them.
struct Packet {
  alignas(32) float origin[3][8], direction[3][8], limit[8];

  PacketOfRays rays(float origin_error) const {
    return {{origin[0], origin[1], origin[2]},
            {direction[0], direction[1], direction[2]},
            limit,
            origin_error};
  }
};

TEST(RayTest, BothKernelsGiveTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  RandomStream random(9);
  unsigned possible = 0, sure = 0, sides = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto corner = [&random] { return test::random_point(random, 3.0).cast<float>().eval(); };
    const Eigen::Vector3f a = corner(), b = corner(), c = i % 50 == 0 ? a : corner();
    const TracedTriangle triangle = traced_triangle(a, b, c);
    Packet packet;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const Vector3d origin = test::random_point(random, 6.0);
      // To a corner and to a point of an edge: what float can't decide.
      const double part = lane % 3 == 0 ? 0.0 : random.uniform();
      const Vector3d to = lane == 7 ? test::random_point(random, 3.0)
                                    : Vector3d(a.cast<double>() + part * (b - a).cast<double>());
      for (int k = 0; k < 3; ++k) {
        packet.origin[k][lane] = static_cast<float>(origin[k]);
        packet.direction[k][lane] = static_cast<float>(to[k] - origin[k]);
      }
      packet.limit[lane] = lane == 6 ? std::numeric_limits<float>::infinity() : 1.5F;
    }
    const PacketOfRays rays = packet.rays(i % 2 == 0 ? 0.0F : 1e-5F);
    const RayTest portable = kPortableRayTest.test(rays, triangle);
    const RayTest avx2 = kAvx2RayTest.test(rays, triangle);
    ASSERT_EQ(portable.possible, avx2.possible);
    ASSERT_EQ(portable.possible & portable.sure, avx2.possible & avx2.sure);
    // All rays to the edge may meet it, and float must not be sure of it.
    if (i % 50 != 0) {
      EXPECT_EQ(portable.possible & 0x7fU, 0x7fU);
    }
    EXPECT_EQ(portable.possible & portable.sure & 0x7fU, 0U);
    possible += portable.possible >> 7U;
    sure += (portable.possible & portable.sure) >> 7U;
    sides += static_cast<unsigned>(i % 50 != 0);
    const TrianglePlane plane{0.6, 0.0, 0.8, random.uniform(-2.0, 2.0)};
    double by_portable[8], by_avx2[8];
    kPortableRayTest.distances(rays, plane, by_portable);
    kAvx2RayTest.distances(rays, plane, by_avx2);
    ASSERT_EQ(std::memcmp(by_portable, by_avx2, sizeof by_avx2), 0);
  }
  EXPECT_GT(sure, 100U);
  EXPECT_LT(possible, sides);
}

/// A ray along the plane meets nothing; one degree off, it does.
TEST(RayTest, ATriangleSeenEdgeOnCoversNothing) {
  World world;
  world.prototypes.push_back(test::make_prototype(test::plane_mesh(2.0F)));
  world.instances.push_back(Instance{});
  const Scene scene(world);
  EXPECT_TRUE(std::isinf(scene.first_hit({-5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}).distance_m));
  EXPECT_FALSE(scene.occluded({-5.0, 0.0, 0.0}, {5.0, 0.0, 0.0}));
  EXPECT_NEAR(scene.first_hit({-5.0, 0.0, 0.1}, {5.0, 0.0, -0.1}).distance_m, std::hypot(5.0, 0.1),
              1e-6);
}

}  // namespace
}  // namespace avoidbench
