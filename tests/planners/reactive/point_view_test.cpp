#include "point_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sight.hpp"

namespace reactive {
namespace {

/// A sweep of a level lidar at (1, 2, 3).
struct Cloud {
  std::vector<ab_lidar_point> points;
  std::vector<float> misses;
  ab_cloud cloud{};

  Cloud() {
    cloud.struct_size = static_cast<std::uint32_t>(sizeof cloud);
    const double place[3] = {1.0, 2.0, 3.0};
    for (int i = 0; i < 3; ++i) cloud.position_world_m[i] = place[i];
    cloud.q_world_lidar[0] = 1.0;
  }
  void add(float x, float y, float z) { points.push_back({{x, y, z}, 0.0F, 0.5F}); }
  void miss(float x, float y, float z) { misses.insert(misses.end(), {x, y, z}); }
  const ab_cloud& seen() {
    cloud.points = points.data();
    cloud.point_count = static_cast<std::uint32_t>(points.size());
    cloud.misses_lidar = misses.data();
    cloud.miss_count = static_cast<std::uint32_t>(misses.size() / 3);
    return cloud;
  }
};

TEST(PointView, KeepsTheNearestPointOfEachSector) {
  Cloud cloud;
  cloud.add(4.0F, 0.02F, 0.02F);
  cloud.add(3.0F, 0.03F, 0.03F);  // the same sector
  cloud.add(0.0F, 5.0F, 0.0F);
  cloud.add(0.0F, -9.0F, 0.0F);
  PointView view;
  view.take(cloud.seen());
  std::vector<Vector3> points;
  view.append_points(6.0, points);
  ASSERT_EQ(points.size(), 2U);
  double sum_x = 0.0, sum_y = 0.0;
  for (const Vector3& point : points) {
    sum_x += point.x;
    sum_y += point.y;
  }
  EXPECT_NEAR(sum_x, 4.0 + 1.0, 1e-6);
  EXPECT_NEAR(sum_y, 2.03 + 7.0, 1e-6);
}

TEST(PointView, SeesWhereShotsWentWhateverTheyMet) {
  Cloud cloud;
  cloud.add(4.0F, 0.02F, 0.02F);
  cloud.miss(0.0F, 1.0F, 0.02F);
  PointView view;
  EXPECT_TRUE(view.is_empty());
  EXPECT_FALSE(view.has_seen({1.0, 0.0, 0.0}));
  view.take(cloud.seen());
  EXPECT_TRUE(view.has_seen({1.0, 0.005, 0.005}));
  EXPECT_TRUE(view.has_seen({0.0, 1.0, 0.01}));
  EXPECT_FALSE(view.has_seen({-1.0, 0.0, 0.0}));
  // A gap of one sweep is filled by the last ones, up to four.
  for (int i = 0; i < 3; ++i) view.take(Cloud().seen());
  EXPECT_TRUE(view.has_seen({1.0, 0.005, 0.005}));
  view.take(Cloud().seen());
  EXPECT_FALSE(view.has_seen({1.0, 0.005, 0.005}));
}

TEST(PointView, SeesThroughWhereEnoughShotsGoOn) {
  Cloud cloud;
  for (int i = 0; i < 2; ++i) cloud.add(6.0F, 0.1F, 0.1F);
  PointView view;
  view.take(cloud.seen());
  const Vector3 before{4.0, 2.05, 3.05}, beyond{7.9, 2.1, 3.1};
  EXPECT_FALSE(view.sees_through(before));  // two shots may both have missed a twig
  view.take(cloud.seen());
  EXPECT_TRUE(view.sees_through(before));
  EXPECT_FALSE(view.sees_through(beyond));
  Cloud near;
  near.add(2.9F, 0.05F, 0.05F);
  view.take(near.seen());
  EXPECT_FALSE(view.sees_through(before));
}

TEST(PointView, NumbersThatAreNoneSayNothing) {
  Cloud cloud;
  cloud.add(std::nanf(""), 0.0F, 0.0F);
  cloud.miss(std::nanf(""), 0.0F, 0.0F);
  PointView view;
  view.take(cloud.seen());
  std::vector<Vector3> points;
  view.append_points(100.0, points);
  EXPECT_TRUE(points.empty());
  cloud.cloud.position_world_m[0] = std::nan("");
  PointView empty;
  empty.take(cloud.seen());
  EXPECT_TRUE(empty.is_empty());
}

/// With cameras a lidar adds to what is seen; by itself it is enough.
TEST(SightOfLidars, IsReadyAfterOneSweep) {
  Sight sight;
  EXPECT_FALSE(sight.is_ready());
  Cloud cloud;
  cloud.add(4.0F, 0.02F, 0.02F);
  sight.take(cloud.seen());
  EXPECT_TRUE(sight.is_ready());
  std::vector<Vector3> points;
  sight.append_points(6.0, points);
  EXPECT_EQ(points.size(), 1U);
  EXPECT_TRUE(sight.has_seen({1.0, 0.005, 0.005}));
  EXPECT_EQ(sight.looked_along({1.0, 0.005, 0.005}), 1.0);
  sight.forget();
  EXPECT_FALSE(sight.is_ready());
}

}  // namespace
}  // namespace reactive
