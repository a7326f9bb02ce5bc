#include "render/depth.hpp"

#include <gtest/gtest.h>
#include <immintrin.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "render/depth_kernel.hpp"
#include "render/ray_tracing_isa.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr float kFree_m = std::numeric_limits<float>::infinity();

std::vector<float> depth_image(const Scene& scene, const Pinhole& camera, const Pose& pose) {
  // Filled with a value that no depth takes, so that a pixel left out is seen.
  std::vector<float> image(static_cast<std::size_t>(camera.width_px * camera.height_px), -7.0F);
  render_depth(scene, camera, pose, image);
  return image;
}

/// A pixel's ray in the camera's frame, forward component 1, straight from the definition.
Vector3d pixel_ray(const Pinhole& camera, int x, int y) {
  return {(x - camera.cx_px) / camera.fx_px, (y - camera.cy_px) / camera.fy_px, 1.0};
}

double at(const std::vector<float>& image, const Pinhole& camera, int x, int y) {
  return static_cast<double>(image[static_cast<std::size_t>(y * camera.width_px + x)]);
}

TEST(Camera, FocalLengthFollowsFromTheFieldOfView) {
  const Pinhole camera = make_pinhole(640, 480, 90.0 * math::kDegree, 10.0);
  EXPECT_NEAR(camera.fx_px, 320.0, 1e-9);
  EXPECT_EQ(camera.fy_px, camera.fx_px);
  EXPECT_EQ(camera.cx_px, 319.5);
  EXPECT_EQ(camera.cy_px, 239.5);
}

TEST(Depth, OfAFrontalPlaneIsItsDistanceAtEveryPixel) {
  const World world = test::world_of(test::plane_mesh(100.0F));
  const Scene scene(world);
  const Pinhole camera = make_pinhole(64, 48, 90.0 * math::kDegree, 100.0);
  const Pose pose = test::looking({0.3, -0.2, 7.25}, -Vector3d::UnitZ());
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_FLOAT_EQ(depth, 7.25F);
}

TEST(Depth, OfATiltedPlaneFollowsItsEquation) {
  const World world = test::world_of(test::plane_mesh(4000.0F));
  const Scene scene(world);
  const Pinhole camera = make_pinhole(160, 120, 70.0 * math::kDegree, 1e5);
  for (const double down : {0.2, 0.5, 1.0, 4.0}) {
    const Pose pose = test::looking({0.0, 0.0, 3.0}, {1.0, 0.4, -down});
    const std::vector<float> image = depth_image(scene, camera, pose);
    int on_plane = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const double sink = (pose.linear() * pixel_ray(camera, x, y)).z();
        if (3.0 / -sink > 2000.0 || sink > -1e-6) continue;
        ASSERT_NEAR(at(image, camera, x, y) * -sink / 3.0, 1.0, 4e-7) << x << ' ' << y;
        ++on_plane;
      }
    }
    EXPECT_GT(on_plane, camera.width_px * camera.height_px / 2) << down;
  }
}

TEST(Depth, OfASphereIsTheClosedFormWithinTheTessellation) {
  const World world = test::world_of(test::sphere_mesh(5));
  const Scene scene(world);
  // A chord of 0.04 rad sinks by 0.04² / 8 · 4/3 below the sphere at a triangle's middle.
  constexpr double kSag = 4e-4;
  const Pinhole camera = make_pinhole(101, 101, 60.0 * math::kDegree, 100.0);
  const Pose pose = test::looking({3.0, 0.0, 0.0}, -Vector3d::UnitX());
  const std::vector<float> image = depth_image(scene, camera, pose);
  int inside = 0;
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      const Vector3d ray = pixel_ray(camera, x, y);
      // |t·ray − (0, 0, 3)| = 1.
      const double a = ray.squaredNorm();
      const double root = 9.0 - 8.0 * a;
      if (root < 0.0) {
        EXPECT_TRUE(std::isinf(at(image, camera, x, y)));
      } else if (root > 0.5) {
        const double expected = (3.0 - std::sqrt(root)) / a;
        EXPECT_GE(at(image, camera, x, y), expected - 1e-6);
        EXPECT_LE(at(image, camera, x, y), expected + 4.0 * kSag);
        ++inside;
      }
    }
  }
  EXPECT_GT(inside, 1200);
  EXPECT_NEAR(at(image, camera, 50, 50), 2.0, kSag);
}

TEST(Depth, IsThatOfTheHitTriangleToFloatRounding) {
  const World world = test::scattered_world(3);
  const Pinhole camera = make_pinhole(48, 36, 90.0 * math::kDegree, 30.0);
  const std::vector<test::PlacedTriangle> triangles = test::all_triangles(world);
  const Pose pose = test::looking({-9.0, 1.0, 0.5}, {1.0, -0.1, 0.05});
  for (const std::size_t flatten : {std::size_t{0}, std::size_t{1000000}}) {
    const Scene scene(world, flatten);
    const std::vector<float> image = depth_image(scene, camera, pose);
    int hits = 0, different = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Vector3d ray = pose.linear() * pixel_ray(camera, x, y);
        double expected = std::numeric_limits<double>::infinity();
        for (const auto& placed : triangles) {
          expected =
              std::min(expected, test::ray_parameter(pose.translation(), ray, placed.corners));
        }
        const double depth = at(image, camera, x, y);
        if (std::isinf(expected) && std::isinf(depth)) continue;
        ++hits;
        // Flattened vertices are rounded to float; a ray along an edge may go either way.
        if (!(std::abs(depth - expected) <= 1e-5 * (1.0 + depth))) ++different;
      }
    }
    EXPECT_GT(hits, 200);
    EXPECT_LE(different, 3);
  }
}

TEST(Depth, PixelCentresAreAtWholeCoordinates) {
  // A wall at 4 m that covers x > 0 only: with cx = 10.5 the edge lies midway between columns 10
  // and 11.
  TriangleMesh mesh;
  mesh.vertices = {
      {0.0F, -9.0F, 4.0F}, {9.0F, -9.0F, 4.0F}, {9.0F, 9.0F, 4.0F}, {0.0F, 9.0F, 4.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const World world = test::world_of(std::move(mesh));
  const Scene scene(world);
  Pinhole camera{.width_px = 22,
                 .height_px = 5,
                 .fx_px = 20.0,
                 .fy_px = 20.0,
                 .cx_px = 10.5,
                 .cy_px = 2.0,
                 .max_range_m = 50.0};
  for (const double shift : {-0.4, 0.4}) {  // the edge stays between the two columns
    camera.cx_px = 10.5 + shift;
    const std::vector<float> image = depth_image(scene, camera, Pose::Identity());
    for (int y = 0; y < 5; ++y) {
      EXPECT_TRUE(std::isinf(at(image, camera, 10, y)));
      EXPECT_NEAR(at(image, camera, 11, y), 4.0, 1e-6);
    }
  }
  camera.cx_px = 11.1;  // column 11 is left of the edge now
  EXPECT_TRUE(std::isinf(at(depth_image(scene, camera, Pose::Identity()), camera, 11, 2)));
}

TEST(Depth, OddSizesGiveTheSamePixelsAsARoundOne) {
  const World world = test::scattered_world(4);
  const Scene scene(world);
  const Pose pose = test::looking({-9.0, 0.0, 0.0}, Vector3d::UnitX());
  Pinhole whole = make_pinhole(64, 64, 90.0 * math::kDegree, 30.0);
  const std::vector<float> expected = depth_image(scene, whole, pose);
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {5, 9}, {63, 61}, {4, 7}, {6, 8}}) {
    Pinhole part = whole;
    part.width_px = width;
    part.height_px = height;
    const std::vector<float> image = depth_image(scene, part, pose);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(at(image, part, x, y), at(expected, whole, x, y)) << width << ' ' << height;
      }
    }
  }
}

TEST(Depth, RangeIsAlongTheAxisFarIsInfiniteAndNearInvalid) {
  const World world = test::world_of(test::plane_mesh(100.0F));
  const Scene scene(world);
  Pinhole camera = make_pinhole(64, 48, 100.0 * math::kDegree, 5.001);
  const Pose pose = test::looking({0.0, 0.0, 5.0}, -Vector3d::UnitZ());
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_FLOAT_EQ(depth, 5.0F);
  camera.max_range_m = 4.999;
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_EQ(depth, kFree_m);
  camera.max_range_m = std::numeric_limits<double>::infinity();
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_FLOAT_EQ(depth, 5.0F);
  camera.min_range_m = 4.999;
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_FLOAT_EQ(depth, 5.0F);
  camera.min_range_m = 5.001;
  for (const float depth : depth_image(scene, camera, pose)) ASSERT_TRUE(std::isnan(depth));
}

TEST(Depth, GrazingRaysStayBetweenZeroAndTheRange) {
  const World world = test::world_of(test::plane_mesh(50.0F));
  const Scene scene(world);
  const Pinhole camera = make_pinhole(64, 48, 90.0 * math::kDegree, 20.0);
  for (const double height : {0.0, 1e-7, 1e-5, 1e-3}) {
    const Pose pose = test::looking({-10.0, 0.0, height}, {1.0, 0.0, -1e-6});
    for (const float depth : depth_image(scene, camera, pose)) {
      ASSERT_TRUE(depth == kFree_m || (depth >= 0.0F && depth <= 20.0F)) << depth;
    }
  }
}

TEST(Depth, InstancedAndFlattenedAgree) {
  const World world = test::scattered_world(5);
  const Scene flattened(world);
  const Scene instanced(world, 0);
  const Pinhole camera = make_pinhole(160, 120, 90.0 * math::kDegree, 40.0);
  RandomStream random(2);
  std::size_t different = 0;
  for (int i = 0; i < 10; ++i) {
    const Pose pose = test::random_pose(random, 8.0);
    const std::vector<float> a = depth_image(flattened, camera, pose);
    const std::vector<float> b = depth_image(instanced, camera, pose);
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (a[k] == b[k]) continue;
      if (!(std::abs(a[k] - b[k]) <= 1e-5F * (1.0F + a[k]))) ++different;
    }
  }
  EXPECT_LE(different, 10U);  // of 192,000: rays along edges
}

TEST(Depth, IsTheSameBitsAfterARebuild) {
  const World world = test::scattered_world(6);
  const World copy = world;
  const Pinhole camera = make_pinhole(160, 120, 90.0 * math::kDegree, 40.0);
  const Pose pose = test::looking({-8.0, 0.0, 0.0}, {1.0, 0.2, 0.0});
  for (const std::size_t flatten : {std::size_t{0}, std::size_t{1000000}}) {
    const Scene first(world, flatten);
    const Scene second(copy, flatten);
    const std::vector<float> a = depth_image(first, camera, pose);
    const std::vector<float> b = depth_image(second, camera, pose);
    EXPECT_EQ(0, std::memcmp(a.data(), b.data(), a.size() * sizeof(float)));
  }
}

void expect_same_bits_of_both_kernels(const Scene& scene, const Pinhole& camera, const Pose& pose) {
  const auto pixels = static_cast<std::size_t>(camera.width_px * camera.height_px);
  std::vector<float> portable(pixels, -7.0F), avx2(pixels, -7.0F);
  std::vector<std::uint32_t> seen_by_portable(pixels, 7U), seen_by_avx2(pixels, 7U);
  render_depth_by(kPortableDepth, scene, camera, pose, portable, seen_by_portable);
  render_depth_by(kAvx2Depth, scene, camera, pose, avx2, seen_by_avx2);
  EXPECT_EQ(std::memcmp(portable.data(), avx2.data(), pixels * sizeof(float)), 0);
  EXPECT_EQ(seen_by_portable, seen_by_avx2);
  std::size_t hits = 0, near = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    ASSERT_EQ(portable[i] == kFree_m, seen_by_portable[i] == kNoInstance);
    hits += static_cast<std::size_t>(std::isfinite(portable[i]));
    near += static_cast<std::size_t>(std::isnan(portable[i]));
  }
  EXPECT_GT(hits, pixels / 20);
  EXPECT_GT(near, pixels / 100);
}

TEST(Depth, BothKernelsGiveTheSameBits) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  EXPECT_EQ(&depth_kernel(), &kAvx2Depth);
  const World world = test::scattered_world(7);
  // Whole blocks and parts of some; packets of small triangles, of one, and of none.
  for (const auto& [width, height] : {std::pair{160, 120}, std::pair{51, 37}, std::pair{3, 5}}) {
    Pinhole camera = make_pinhole(width, height, 90.0 * math::kDegree, 12.0);
    camera.min_range_m = 4.0;
    const Pose pose = test::looking({-8.0, 0.0, 0.0}, {1.0, 0.2, 0.0});
    for (const std::size_t flatten : {std::size_t{0}, std::size_t{1000000}}) {
      expect_same_bits_of_both_kernels(Scene(world, flatten), camera, pose);
    }
  }
}

TEST(Depth, LeavesTheArithmeticModeAsItWas) {
  const World world = test::world_of(test::plane_mesh(10.0F));
  const Scene scene(world);
  const Pinhole camera = make_pinhole(16, 16, 1.0, 40.0);
  const unsigned before = _mm_getcsr();
  EXPECT_EQ(before & 0x8040U, 0U);
  depth_image(scene, camera, test::looking({0.0, 0.0, 3.0}, -Vector3d::UnitZ()));
  scene.first_hit({0.0, 0.0, 3.0}, -Vector3d::UnitZ());
  scene.occluded({0.0, 0.0, 3.0}, {0.0, 0.0, -3.0});
  scene.nearest({0.0, 0.0, 3.0});
  EXPECT_EQ(_mm_getcsr() & ~0x3fU, before & ~0x3fU);  // all but the flags of what has happened
  volatile double tiny = std::numeric_limits<double>::min();
  EXPECT_GT(tiny / 4.0, 0.0);
}

TEST(Depth, OfAnEmptyWorldIsInfinite) {
  const World world;
  const Scene scene(world);
  const Pinhole camera = make_pinhole(33, 17, 1.0, 40.0);
  for (const float depth : depth_image(scene, camera, Pose::Identity())) {
    ASSERT_EQ(depth, kFree_m);
  }
  EXPECT_TRUE(std::isinf(scene.first_hit(Vector3d::Zero(), Vector3d::UnitX()).distance_m));
  EXPECT_FALSE(scene.occluded(Vector3d::Zero(), Vector3d::UnitX()));
  EXPECT_TRUE(std::isinf(scene.nearest(Vector3d::Zero()).distance_m));
  EXPECT_FALSE(scene.touch({1.0, 1.0, 1.0}, Pose::Identity()).has_value());
  EXPECT_TRUE(std::isinf(scene.body_clearance({1.0, 1.0, 1.0}, Pose::Identity(), 9.0)));
}

}  // namespace
}  // namespace avoidbench
