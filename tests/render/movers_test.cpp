#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "render/depth.hpp"
#include "render/rays.hpp"
#include "render/scene.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// Scattered things, and among them a few more that move, one of them scaled, one that turns.
World world_with_movers(const World& map) {
  World world = map;
  const auto first = static_cast<std::uint32_t>(world.prototypes.size());
  world.prototypes.push_back(test::make_prototype(test::box_mesh({1, 0.4F, 1.6F})));
  world.prototypes.push_back(test::make_prototype(test::sphere_mesh(2)));
  for (std::uint32_t i = 0; i < 12; ++i) {
    Instance instance;
    instance.prototype = first + i % 2;
    instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
    instance.T_world_prototype.translation() = Eigen::Vector3f(
        static_cast<float>(i % 4) * 3.0F - 5.0F, static_cast<float>(i / 4) * 3.0F - 4.0F, 0.5F);
    instance.T_world_prototype.linear() *= 0.5F + 0.1F * static_cast<float>(i);
    Motion motion{.instance = static_cast<std::uint32_t>(world.instances.size()), .path = {}};
    if (i % 3 == 0) {
      motion.path = Sway{.amplitude_world = {0.5, 2.0, 0.3}, .period_s = 3.0 + i, .phase = 0.1 * i};
    } else if (i % 3 == 1) {
      motion.path = Trefoil{.reach_m = 2.0, .rise_m = 0.5, .period_s = 5.0, .phase = 0.1 * i};
    } else {
      motion.path = Route{{{0.0, {0, 0, 0}, 0.0}, {2.0, {2, 1, 0}, 1.0}, {5.0, {-2, 2, 1}, 4.0}}};
    }
    world.motions.push_back(motion);
    world.instances.push_back(instance);
    world.obstacles.push_back({.kind = "mover"});
  }
  return world;
}

/// Over a map in both kinds of hierarchy.
class MovingScene : public testing::TestWithParam<std::size_t> {
 protected:
  World map_ = test::scattered_world(11);
  Scene map_scene_{map_, GetParam()};
  World world_ = world_with_movers(map_);
  Scene scene_{world_, map_scene_};
  RandomStream random_{78};
};

INSTANTIATE_TEST_SUITE_P(Both, MovingScene, testing::Values(0, 1000000), [](const auto& suite) {
  return suite.param == 0 ? "Instanced" : "Flattened";
});

constexpr double kTimes_s[] = {0.0, 0.7, 4.9, 2.2, 2.2, 0.0};

/// Rays by the packet, as lidars', see what single ones see.
TEST_P(MovingScene, ManyRaysAreEachOne) {
  std::size_t mover_count = 0;
  for (const double time_s : kTimes_s) {
    scene_.set_time(time_s);
    std::vector<Ray> rays(333);
    for (Ray& ray : rays) {
      ray.origin_world = test::random_point(random_, 8.0);
      ray.direction_world = (test::random_point(random_, 4.0) - ray.origin_world).normalized();
    }
    std::vector<RayHit> hits(rays.size());
    first_hits(scene_, rays, 9.0, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayHit one = scene_.first_hit(rays[i].origin_world, rays[i].direction_world, 9.0);
      ASSERT_EQ(std::isinf(hits[i].distance_m), std::isinf(one.distance_m));
      if (std::isinf(one.distance_m)) continue;
      EXPECT_EQ(hits[i].instance, one.instance);
      EXPECT_EQ(hits[i].triangle, one.triangle);
      EXPECT_NEAR(hits[i].distance_m, one.distance_m, 1e-5);
      EXPECT_LT((hits[i].normal_world - one.normal_world).norm(), 1e-5);
      if (hits[i].instance >= map_.instances.size()) ++mover_count;
    }
  }
  EXPECT_GT(mover_count, 20U);
}

TEST_P(MovingScene, AnswersAsAWorldThatStandsSo) {
  int on_movers = 0;
  for (const double time_s : kTimes_s) {
    scene_.set_time(time_s);
    const World still = standing_at(world_, time_s);
    const Scene expected(still, 0);
    for (int i = 0; i < 300; ++i) {
      const Vector3d place = test::random_point(random_, 8.0);
      const NearestPoint nearest = scene_.nearest(place);
      EXPECT_EQ(nearest.distance_m, expected.nearest(place).distance_m);
      EXPECT_EQ(nearest.instance, expected.nearest(place).instance);
      EXPECT_EQ(scene_.nearest(place, 0.5).distance_m, expected.nearest(place, 0.5).distance_m);
      if (nearest.instance >= map_.instances.size()) ++on_movers;
      const Pose body = make_pose(place, Eigen::Quaterniond(0.9, 0.1, 0.3, 0.2).normalized());
      const Vector3d size(0.8, 0.6, 0.4);
      EXPECT_EQ(scene_.body_clearance(size, body, 5.0), expected.body_clearance(size, body, 5.0));
      const auto touch = scene_.touch(size, body), expected_touch = expected.touch(size, body);
      ASSERT_EQ(touch.has_value(), expected_touch.has_value());
      if (touch) {
        EXPECT_EQ(touch->instance, expected_touch->instance);
      }
      std::size_t offered = 0, expected_offered = 0;
      scene_.visit_triangles(place, 1.0, [&](const Triangle& corners) {
        if ((closest_point(place, corners) - place).norm() <= 1.0) ++offered;
        return 1.0;
      });
      expected.visit_triangles(place, 1.0, [&](const Triangle& corners) {
        if ((closest_point(place, corners) - place).norm() <= 1.0) ++expected_offered;
        return 1.0;
      });
      EXPECT_EQ(offered, expected_offered);
    }
  }
  EXPECT_GT(on_movers, 100);
}

TEST_P(MovingScene, RaysMeetTheNearerOfMapAndMovers) {
  int on_movers = 0, different = 0, all = 0;
  for (const double time_s : kTimes_s) {
    scene_.set_time(time_s);
    const World still = standing_at(world_, time_s);
    const Scene expected(still, 0);
    for (int i = 0; i < 500; ++i, ++all) {
      const Vector3d from = test::random_point(random_, 8.0);
      const Vector3d to = test::random_point(random_, 8.0);
      const RayHit hit = scene_.first_hit(from, to - from);
      const RayHit wanted = expected.first_hit(from, to - from);
      const bool is_equal = std::abs(hit.distance_m - wanted.distance_m) < 1e-4 ||
                            hit.distance_m == wanted.distance_m;
      const bool is_blocked = scene_.occluded(from, to) == expected.occluded(from, to);
      if (!is_equal || !is_blocked) ++different;  // along an edge
      if (std::isfinite(hit.distance_m) && hit.instance >= map_.instances.size()) ++on_movers;
    }
  }
  EXPECT_LE(different, all / 200);
  EXPECT_GT(on_movers, 200);
}

/// Of one view: how many pixels differ by more than a tenth of a millimetre, and how many show
/// movers.
TEST_P(MovingScene, PicturesShowTheNearerOfMapAndMovers) {
  const Pinhole camera = make_pinhole(90, 70, 1.9, 15.0);
  constexpr std::size_t kPixels = 90 * 70;
  std::vector<float> seen(kPixels), wanted(kPixels);
  std::vector<std::uint32_t> shown(kPixels), wanted_shown(kPixels);
  int different = 0, on_movers = 0;
  for (int i = 0; i < 12; ++i) {
    const double time_s = 0.4 * i;
    scene_.set_time(time_s);
    const World still = standing_at(world_, time_s);
    // From among them, so that some reach behind the camera.
    const Pose pose = make_pose(
        test::random_point(random_, 5.0),
        Eigen::Quaterniond(Eigen::Vector4d(test::random_point(random_, 1.0).homogeneous()))
            .normalized());
    render_depth(scene_, camera, pose, seen, shown);
    render_depth(Scene(still, 0), camera, pose, wanted, wanted_shown);
    for (std::size_t k = 0; k < kPixels; ++k) {
      const bool is_equal =
          std::abs(seen[k] - wanted[k]) < 1e-4F || std::memcmp(&seen[k], &wanted[k], 4) == 0;
      if (!is_equal || shown[k] != wanted_shown[k]) ++different;
      if (shown[k] != kNoInstance && shown[k] >= map_.instances.size()) ++on_movers;
    }
  }
  EXPECT_LE(different, 12 * static_cast<int>(kPixels) / 1000);
  EXPECT_GT(on_movers, 2000);
}

TEST_P(MovingScene, LeavesTheMapsOwnSceneAsItWas) {
  const Scene fresh(map_, GetParam());
  const Pinhole camera = make_pinhole(64, 48, 1.6, 15.0);
  std::vector<float> before(64 * 48), after(64 * 48);
  Pose pose = Pose::Identity();
  pose.translation() = Vector3d(0, 0, -5);
  render_depth(fresh, camera, pose, before);
  scene_.set_time(3.0);
  render_depth(scene_, camera, pose, after);
  EXPECT_NE(std::memcmp(before.data(), after.data(), before.size() * sizeof(float)), 0);
  render_depth(map_scene_, camera, pose, after);
  EXPECT_EQ(std::memcmp(before.data(), after.data(), before.size() * sizeof(float)), 0);
}

TEST_P(MovingScene, LivesLongerThanTheMapsScene) {
  auto map_scene = std::make_unique<Scene>(map_, GetParam());
  Scene scene(world_, *map_scene);
  map_scene.reset();
  scene.set_time(1.0);
  scene_.set_time(1.0);
  const Vector3d from(-9, -9, 1), to(1, 1, 1);
  EXPECT_EQ(scene.first_hit(from, to - from).distance_m,
            scene_.first_hit(from, to - from).distance_m);
}

TEST(MovingScenes, OfAMapThatMovesItselfAreWholes) {
  World map = test::scattered_world(11);
  map.motions = {{.instance = 2, .path = Sway{.amplitude_world = {1, 2, 0}, .period_s = 5.0}}};
  const Scene map_scene(map);
  const World world = world_with_movers(map);
  Scene scene(world, map_scene);
  scene.set_time(1.1);
  const World still = standing_at(world, 1.1);
  const Scene expected(still, 0);
  RandomStream random(9);
  for (int i = 0; i < 300; ++i) {
    const Vector3d place = test::random_point(random, 8.0);
    EXPECT_EQ(scene.nearest(place).distance_m, expected.nearest(place).distance_m);
  }
}

}  // namespace
}  // namespace avoidbench
