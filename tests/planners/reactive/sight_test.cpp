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

TEST(DepthView, SeesThroughWhatIsGone) {
  const Image wall(4.0F, {});
  DepthView view;
  view.take(wall.image);
  EXPECT_TRUE(view.sees_through({2.0, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({3.9, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({6.0, 0.0, 0.0}));
  EXPECT_FALSE(view.sees_through({2.0, 5.0, 0.0}));
}

TEST(ObstacleMemory, ForgetsByAgeDistanceAndSight) {
  ObstacleMemory memory;
  const DepthView blind;
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
  DepthView view;
  view.take(wall.image);
  memory.prune({}, 5.0, 6.0, 10.0, view);
  EXPECT_EQ(count(), 0U);
  memory.add({2.0, 0.0, 0.0}, 1.0);
  memory.prune({}, 5.0, 12.0, 10.0, blind);
  EXPECT_EQ(count(), 0U);
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
  response.horizon_s = 2.0;
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
