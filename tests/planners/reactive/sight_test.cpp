#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "depth_view.hpp"
#include "obstacle_memory.hpp"
#include "polar_histogram.hpp"
#include "rollout.hpp"
#include "sight.hpp"

namespace reactive {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A level camera at `position` that looks along +x: 64 × 48 pixels, 90°.
struct Image {
  Image(float depth_m, const Vector3& position) : pixels(64 * 48, depth_m) {
    image.struct_size = static_cast<std::uint32_t>(sizeof image);
    image.width_px = 64;
    image.height_px = 48;
    image.fx_px = image.fy_px = 32.0;
    image.cx_px = 31.5;
    image.cy_px = 23.5;
    const double half = 0.5;
    const double q[4] = {half, -half, half, -half};  // camera z is world x, camera x is world -y
    std::copy(std::begin(q), std::end(q), image.q_world_camera);
    image.position_world_m[0] = position.x;
    image.position_world_m[1] = position.y;
    image.position_world_m[2] = position.z;
    image.depth_m = pixels.data();
  }
  /// 320 × 240 pixels of free space: a cell is 5 × 5 of them.
  void make_large() {
    pixels.assign(320 * 240, kInfinity);
    image.width_px = 320;
    image.height_px = 240;
    image.fx_px = image.fy_px = 160.0;
    image.cx_px = 159.5;
    image.cy_px = 119.5;
    image.depth_m = pixels.data();
  }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  std::vector<float> pixels;
  ab_depth_image image{};
};

TEST(DepthView, PutsAWallWhereItIs) {
  const Image wall(4.0F, {1.0, 2.0, 3.0});
  DepthView view;
  view.take(wall.image);
  std::vector<Vector3> points;
  view.append_points(10.0, points);
  ASSERT_EQ(points.size(), 64U * 48U);
  double leftmost = 0.0, highest = 0.0;
  for (const Vector3& point : points) {
    EXPECT_NEAR(point.x, 5.0, 1e-12);
    leftmost = std::max(leftmost, point.y);
    highest = std::max(highest, point.z);
  }
  EXPECT_NEAR(leftmost, 2.0 + 4.0 * 31.5 / 32.0, 1e-12);
  EXPECT_NEAR(highest, 3.0 + 4.0 * 23.5 / 32.0, 1e-12);
  points.clear();
  view.append_points(3.9, points);
  EXPECT_TRUE(points.empty());
}

TEST(DepthView, InvalidIsNotSeenAndFreeIs) {
  DepthView view;
  EXPECT_FALSE(view.has_seen({1.0, 0.0, 0.0}));
  const Image invalid(kNaN, {}), free(kInfinity, {});
  view.take(invalid.image);
  EXPECT_FALSE(view.has_seen({1.0, 0.0, 0.0}));
  view.take(free.image);
  EXPECT_TRUE(view.has_seen({1.0, 0.0, 0.0}));
  EXPECT_TRUE(view.has_seen({1.0, 0.8, 0.0}));
  EXPECT_FALSE(view.has_seen({1.0, 0.97, 0.0}));  // at the edge
  EXPECT_FALSE(view.has_seen({1.0, 1.2, 0.0}));
  EXPECT_FALSE(view.has_seen({-1.0, 0.0, 0.0}));
}

/// The points that `image` shows up to 5 m.
std::vector<Vector3> points_of(const ab_depth_image& image) {
  DepthView view;
  view.take(image);
  std::vector<Vector3> points;
  view.append_points(5.0, points);
  return points;
}

TEST(DepthView, APixelWithoutItsLikeIsNoSurface) {
  Image open(kInfinity, {});
  const auto pixel = [&](int column, int row) -> float& {
    return open.pixels[static_cast<std::size_t>(row * 64 + column)];
  };
  pixel(32, 24) = 2.0F;
  pixel(10, 10) = 1.0F;  // a pair
  pixel(11, 10) = 1.0F;
  pixel(50, 20) = 1.0F;  // three at different depths
  pixel(51, 20) = 1.5F;
  pixel(52, 20) = 3.0F;
  EXPECT_TRUE(points_of(open.image).empty());
  DepthView view;
  view.take(open.image);
  EXPECT_TRUE(view.has_seen({1.0, 0.0, 0.0}));
  // But it is no proof either that a twig remembered there is gone.
  EXPECT_FALSE(view.sees_through({2.0, -0.03, -0.03}));
  EXPECT_TRUE(view.sees_through({2.0, 0.3, 0.3}));
  for (int row = 0; row < 48; ++row) pixel(32, row) = 2.0F;
  EXPECT_GE(points_of(open.image).size(), 46U);  // a pole of one pixel: all but its ends
}

TEST(DepthView, ThinThingsStayInLargeImagesToo) {
  for (const int slant : {0, 1}) {  // upright, diagonal
    Image line(kInfinity, {});
    line.make_large();
    const auto pixel = [&](int row) -> float& {
      return line.pixels[static_cast<std::size_t>(row * 320 + 40 + slant * row)];
    };
    for (int row = 0; row < 240; ++row) pixel(row) = 3.0F;
    EXPECT_GE(points_of(line.image).size(), 46U) << "slant " << slant;
    line.make_large();
    for (int row = 2; row < 240; row += 4) pixel(row) = 3.0F;  // as many cells, each one pixel
    EXPECT_TRUE(points_of(line.image).empty());
  }
}

/// What a matcher makes up in the sky looks a few millimetres thick close to the camera.
TEST(DepthView, NearStreaksAreNoSurface) {
  for (const auto& [thickness_px, is_surface] : {std::pair{2, false}, std::pair{5, true}}) {
    Image streak(kInfinity, {});
    streak.make_large();
    for (int i = 0; i < thickness_px * 320; ++i) {
      streak.pixels[static_cast<std::size_t>(60 * 320 + i)] = 0.35F;
    }
    EXPECT_EQ(!points_of(streak.image).empty(), is_surface) << thickness_px << " px";
  }
}

TEST(DepthView, SeesThroughWhatIsGone) {
  const Image wall(4.0F, {});
  DepthView view;
  view.take(wall.image);
  EXPECT_TRUE(view.sees_through({2.0, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({3.9, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({6.0, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({2.0, 5.0, 0.0}));
  EXPECT_TRUE(view.shows({4.2, 0.0, 0.0}));
  EXPECT_FALSE(view.shows({2.0, 0.0, 0.0}));
  EXPECT_FALSE(view.shows({6.0, 0.0, 0.0}));
  EXPECT_FALSE(view.shows({-4.0, 0.0, 0.0}));
}

Sight sight_of(const std::vector<const Image*>& images) {
  Sight sight;
  for (const Image* image : images) sight.take(image->image);
  return sight;
}

std::size_t count_of(const Sight& sight) {
  std::vector<Vector3> points;
  sight.append_points(5.0, points);
  return points.size();
}

TEST(Sight, BelievesWhatMostImagesShow) {
  const Image wall(4.0F, {}), nothing(kInfinity, {}), nearer(2.0F, {});
  EXPECT_FALSE(sight_of({&wall, &wall}).is_ready());
  EXPECT_EQ(count_of(sight_of({&wall, &wall})), 0U);
  EXPECT_EQ(count_of(sight_of({&wall, &wall, &wall})), 64U * 48U);
  EXPECT_EQ(count_of(sight_of({&wall, &wall, &nothing, &wall})), 64U * 48U);
  EXPECT_EQ(count_of(sight_of({&wall, &wall, &wall, &nothing})), 0U);
  // A surface that only one image shows is made up.
  EXPECT_EQ(count_of(sight_of({&wall, &wall, &wall, &nearer})), 0U);
  EXPECT_EQ(count_of(sight_of({&nothing, &nothing, &wall, &wall})), 0U);
}

TEST(Sight, KnowsASurfaceThatItFliesTo) {
  Sight sight;
  for (int i = 0; i < 4; ++i) {  // at 3 m/s and 10 images per second
    const Image wall(static_cast<float>(4.0 - 0.3 * i), {0.3 * i, 0.0, 0.0});
    sight.take(wall.image);
  }
  std::vector<Vector3> points;
  sight.append_points(5.0, points);
  ASSERT_GT(points.size(), 2000U);
  for (const Vector3& point : points) EXPECT_NEAR(point.x, 4.0, 1e-6);
}

TEST(Sight, SeesAndSeesThroughByMajority) {
  const Image wall(4.0F, {}), nothing(kInfinity, {}), invalid(kNaN, {}), nearer(1.0F, {});
  const Vector3 ahead{1.0, 0.0, 0.0}, place{2.0, 0.0, 0.0};
  EXPECT_TRUE(sight_of({&wall, &nothing, &invalid, &wall}).has_seen(ahead));
  EXPECT_FALSE(sight_of({&wall, &invalid, &invalid, &wall}).has_seen(ahead));
  EXPECT_TRUE(sight_of({&wall, &nothing, &nearer, &wall}).sees_through(place));
  EXPECT_FALSE(sight_of({&wall, &nearer, &nearer, &wall}).sees_through(place));
}

/// Two cameras back to back, of which each shows its own wall.
TEST(Sight, HasEachCameraForItself) {
  const Image ahead(4.0F, {0.0, 0.0, 2.0});
  Image behind(4.0F, {0.0, 0.0, 2.0});
  behind.image.camera = 1;
  const double q[4] = {0.5, -0.5, -0.5, 0.5};  // camera z is world -x, camera x is world y
  std::copy(std::begin(q), std::end(q), behind.image.q_world_camera);
  Sight sight;
  for (int i = 0; i < Sight::kNeeded; ++i) {
    EXPECT_FALSE(sight.is_ready());
    sight.take(behind.image);
    // Of the other camera fewer images are there than it needs.
    if (i > 0) sight.take(ahead.image);
  }
  EXPECT_TRUE(sight.is_ready());
  EXPECT_TRUE(sight.has_seen({-1.0, 0.0, 0.0}));
  EXPECT_FALSE(sight.has_seen({1.0, 0.0, 0.0}));
  EXPECT_EQ(count_of(sight), 64U * 48U);
  sight.take(ahead.image);
  EXPECT_TRUE(sight.has_seen({1.0, 0.0, 0.0}));
  EXPECT_EQ(count_of(sight), 2U * 64U * 48U);
  EXPECT_TRUE(sight.sees_through({-3.0, 0.0, 2.0}));
  EXPECT_TRUE(sight.sees_through({3.0, 0.0, 2.0}));
  EXPECT_FALSE(sight.sees_through({-6.0, 0.0, 2.0}));
  EXPECT_NEAR(sight.looked_along({1.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(sight.looked_along({-0.6, 0.8, 0.0}), 0.6, 1e-12);
}

TEST(ObstacleMemory, ForgetsByAgeDistanceAndSight) {
  ObstacleMemory memory;
  const Sight blind;
  const auto count = [&](double except_time_s = -1.0) {
    std::vector<Vector3> points;
    memory.append_points(except_time_s, points);
    return points.size();
  };
  memory.add({2.0, 0.0, 0.0}, 1.0);
  memory.add({2.01, 0.01, 0.01}, 1.5);  // the same cell: replaces it
  memory.add({0.0, 6.0, 0.0}, 1.0);
  memory.add({std::nan(""), 0.0, 0.0}, 1.0);
  EXPECT_EQ(count(), 2U);
  EXPECT_EQ(count(1.5), 1U);
  memory.prune({}, 8.0, 6.0, 10.0, blind);
  EXPECT_EQ(count(), 2U);
  memory.prune({}, 5.0, 6.0, 10.0, blind);
  EXPECT_EQ(count(), 1U);
  const Image wall(4.0F, {});
  memory.prune({}, 5.0, 6.0, 10.0, sight_of({&wall, &wall, &wall}));
  EXPECT_EQ(count(), 0U);
  memory.add({2.0, 0.0, 0.0}, 1.0);
  memory.prune({}, 5.0, 12.0, 10.0, blind);
  EXPECT_EQ(count(), 0U);
}

/// To the very second and the very metre.
TEST(ObstacleMemory, KeepsWhatIsJustWithinAgeAndRange) {
  ObstacleMemory memory;
  const Sight blind;
  memory.add({3.0, 4.0, 0.0}, 1.0);
  memory.prune({}, 5.0, 11.0, 10.0, blind);
  std::vector<Vector3> points;
  memory.append_points(-1.0, points);
  EXPECT_EQ(points.size(), 1U);
}

TEST(PolarHistogram, MeasuresToTheTouchOfABall) {
  PolarHistogram histogram;
  histogram.clear(10.0);
  histogram.add({5.0, 0.0, 0.0}, 1.0);
  const auto free_along = [&](double azimuth_deg, double elevation_deg) {
    const int azimuth = static_cast<int>(azimuth_deg / 5.0),
              elevation = static_cast<int>(elevation_deg / 5.0) + 5;
    return histogram.free_m(azimuth * PolarHistogram::kElevations + elevation);
  };
  EXPECT_NEAR(free_along(0.0, 0.0), 4.0, 1e-9);
  // At 5°: 5 cos - sqrt(1 - 25 sin²).
  const double sine = avoidbench::math::sin(5.0 * avoidbench::math::kDegree);
  EXPECT_NEAR(free_along(5.0, 0.0),
              5.0 * std::sqrt(1.0 - sine * sine) - std::sqrt(1.0 - 25.0 * sine * sine), 1e-9);
  EXPECT_NEAR(free_along(0.0, 5.0), free_along(5.0, 0.0), 1e-9);
  EXPECT_NEAR(free_along(355.0, 0.0), free_along(5.0, 0.0), 1e-9);
  EXPECT_EQ(free_along(15.0, 0.0), 10.0);  // asin(1/5) is 11.5°
  EXPECT_EQ(free_along(180.0, 0.0), 10.0);
}

TEST(PolarHistogram, AgreesWithEveryPointTriedAlone) {
  avoidbench::RandomStream random = avoidbench::stream(3, "polar");
  PolarHistogram histogram;
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<Vector3> points;
    histogram.clear(8.0);
    for (int i = 0; i < 30; ++i) {
      const double x = random.uniform(-6.0, 6.0);
      const double y = random.uniform(-6.0, 6.0);
      const double z = random.uniform(-3.0, 3.0);
      points.push_back({x, y, z});
      histogram.add(points.back(), 0.6);
    }
    for (int i = 0; i < PolarHistogram::kDirections; ++i) {
      EXPECT_NEAR(histogram.free_m(i), free_distance(points, {}, histogram.direction(i), 0.6, 8.0),
                  1e-9);
    }
  }
}

TEST(PolarHistogram, ATooNearPointBlocksOnlyTheWayToIt) {
  PolarHistogram histogram;
  histogram.clear(8.0);
  histogram.add({0.3, 0.0, 0.0}, 0.6);
  EXPECT_LT(histogram.free_m(5), 0.05);                                    // at it
  EXPECT_EQ(histogram.free_m(18 * PolarHistogram::kElevations + 5), 8.0);  // beside it
  EXPECT_EQ(histogram.free_m(36 * PolarHistogram::kElevations + 5), 8.0);  // away
}

TEST(Rollout, BrakesInTheKnownDistance) {
  Response response;
  response.latency_s = 0.1;
  response.acceleration_mps2 = 4.0;
  response.step_count = 200;
  response.step_s = 0.01;
  // 3 m/s: 0.3 m by latency and 9 / 8 m of braking.
  const std::vector<Vector3> wall{{3.0, 0.0, 0.0}};
  EXPECT_NEAR(rollout_clearance(wall, {3.0, 0.0, 0.0}, {}, response, 10.0), 3.0 - 0.3 - 1.125,
              1e-3);
  EXPECT_NEAR(rollout_clearance(wall, {}, {1.0, 0.0, 0.0}, response, 10.0), 3.0 - (2.0 - 0.125),
              0.011);
  EXPECT_EQ(rollout_clearance({}, {}, {}, response, 10.0), 10.0);
}

}  // namespace
}  // namespace reactive
