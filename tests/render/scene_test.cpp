#include "render/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/poll.hpp"
#include "render/depth.hpp"
#include "render/scene_internals.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Every test runs on both kinds of hierarchy.
class SceneOf : public testing::TestWithParam<std::size_t> {
 protected:
  World world_ = test::scattered_world(11);
  Scene scene_{world_, GetParam()};
  std::vector<test::PlacedTriangle> triangles_ = test::all_triangles(world_);
  RandomStream random_{77};
};

INSTANTIATE_TEST_SUITE_P(Both, SceneOf, testing::Values(0, 1000000), [](const auto& suite) {
  return suite.param == 0 ? "Instanced" : "Flattened";
});

TEST_P(SceneOf, FirstHitIsThatOfAllTriangles) {
  int hits = 0;
  int different = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vector3d origin = test::random_point(random_, 8.0);
    const Vector3d direction = 3.0 * test::random_point(random_, 1.0);
    double expected = kInfinity;
    for (const auto& placed : triangles_) {
      expected = std::min(expected, test::ray_parameter(origin, direction, placed.corners));
    }
    expected *= direction.norm();
    const RayHit hit = scene_.first_hit(origin, direction);
    if (std::isinf(expected) && std::isinf(hit.distance_m)) continue;
    if (!(std::abs(hit.distance_m - expected) <= 1e-9 * (1.0 + expected))) {
      ++different;  // along an edge, where float rays may go either way
      continue;
    }
    ++hits;
    EXPECT_NEAR(hit.normal_world.norm(), 1.0, 1e-12);
    const Triangle corners = std::find_if(triangles_.begin(), triangles_.end(), [&](const auto& t) {
                               return t.instance == hit.instance && t.triangle == hit.triangle;
                             })->corners;
    const Vector3d point = origin + direction.normalized() * hit.distance_m;
    EXPECT_LT((closest_point(point, corners) - point).norm(), 1e-5);
    EXPECT_NEAR(hit.normal_world.dot(corners[1] - corners[0]), 0.0, 1e-9);
  }
  EXPECT_GT(hits, 500);
  EXPECT_LE(different, 3);
}

TEST_P(SceneOf, FirstHitRespectsItsLimit) {
  int limited = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d origin = test::random_point(random_, 8.0);
    const Vector3d direction = test::random_point(random_, 1.0);
    const double distance = scene_.first_hit(origin, direction).distance_m;
    if (std::isinf(distance)) continue;
    EXPECT_EQ(scene_.first_hit(origin, direction, 0.999 * distance).distance_m, kInfinity);
    EXPECT_EQ(scene_.first_hit(origin, direction, 1.001 * distance).distance_m, distance);
    ++limited;
  }
  EXPECT_GT(limited, 100);
}

TEST_P(SceneOf, OccludedIsAHitBetweenThePoints) {
  int occluded = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d from = test::random_point(random_, 7.0);
    const Vector3d to = test::random_point(random_, 7.0);
    const double distance = scene_.first_hit(from, to - from).distance_m;
    if (std::abs(distance - (to - from).norm()) < 1e-3) continue;
    EXPECT_EQ(scene_.occluded(from, to), distance < (to - from).norm());
    if (scene_.occluded(from, to)) ++occluded;
  }
  EXPECT_GT(occluded, 100);
  EXPECT_LT(occluded, 900);
}

TEST_P(SceneOf, NearestIsThatOfAllTriangles) {
  for (int i = 0; i < 500; ++i) {
    const Vector3d point = test::random_point(random_, 9.0);
    double square = kInfinity;
    std::uint32_t instance = 0;
    for (const auto& placed : triangles_) {
      const double here = (closest_point(point, placed.corners) - point).squaredNorm();
      if (here < square) {  // the triangles come in order, so ties go to the first
        square = here;
        instance = placed.instance;
      }
    }
    const NearestPoint nearest = scene_.nearest(point);
    EXPECT_EQ(nearest.distance_m, std::sqrt(square));
    EXPECT_EQ(nearest.instance, instance);
    EXPECT_NEAR((nearest.point_world - point).norm(), nearest.distance_m, 1e-12);
    EXPECT_EQ(scene_.nearest(point, 0.5 * nearest.distance_m).distance_m, kInfinity);
    EXPECT_EQ(scene_.nearest(point, 1.5 * nearest.distance_m).distance_m, nearest.distance_m);
  }
}

TEST_P(SceneOf, VisitsEveryTriangleWithinTheRadius) {
  const auto is_same = [](const Triangle& a, const Triangle& b) {
    return std::equal(a.begin(), a.end(), b.begin());
  };
  std::size_t within = 0;
  for (int i = 0; i < 20; ++i) {
    const Vector3d center = test::random_point(random_, 7.0);
    std::vector<Triangle> visited;
    scene_.visit_triangles(center, 1.5, [&](const Triangle& corners) {
      visited.push_back(corners);
      return 1.5;
    });
    for (const auto& placed : triangles_) {
      if ((closest_point(center, placed.corners) - center).norm() > 1.5) continue;
      ++within;
      EXPECT_TRUE(std::any_of(visited.begin(), visited.end(), [&](const Triangle& corners) {
        return is_same(corners, placed.corners);
      }));
    }
  }
  EXPECT_GT(within, 100U);
}

/// Of thousands that are within the radius at first: what the first visit gives, and no greater
/// one that a later visit gives, is what counts.
TEST_P(SceneOf, VisitsNoneBeyondTheRadiusThatAVisitGave) {
  ASSERT_GT(triangles_.size(), 1000U);
  int visits = 0;
  scene_.visit_triangles(Vector3d::Zero(), 30.0, [&](const Triangle& corners) {
    ++visits;
    // No triangle is so near.
    EXPECT_GT(closest_point(Vector3d::Zero(), corners).norm(), 0.01);
    return visits == 1 ? 0.001 : 30.0;
  });
  EXPECT_GE(visits, 1);
  EXPECT_LT(visits, 100);
}

TEST_P(SceneOf, TouchIsThatOfAllTriangles) {
  const Vector3d size(0.9, 0.7, 0.3);
  int touching = 0;
  for (int i = 0; i < 800; ++i) {
    const Pose pose = test::random_pose(random_, 6.5);
    const test::PlacedTriangle* expected = nullptr;
    for (const auto& placed : triangles_) {
      Triangle corners = placed.corners;
      for (Vector3d& corner : corners) {
        corner = pose.linear().transpose() * (corner - pose.translation());
      }
      if (overlaps(0.5 * size, corners)) {
        expected = &placed;
        break;
      }
    }
    const std::optional<BodyContact> contact = scene_.touch(size, pose);
    ASSERT_EQ(contact.has_value(), expected != nullptr);
    if (expected == nullptr) continue;
    EXPECT_EQ(contact->instance, expected->instance);
    EXPECT_EQ(contact->triangle, expected->triangle);
    ++touching;
  }
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 700);
}

TEST_P(SceneOf, BodyClearanceIsThatOfAllTriangles) {
  const Vector3d size(0.5, 0.4, 0.12);
  int apart = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose pose = test::random_pose(random_, 8.0);
    double expected = kInfinity;
    for (const auto& placed : triangles_) {
      Triangle corners = placed.corners;
      for (Vector3d& corner : corners) {
        corner = pose.linear().transpose() * (corner - pose.translation());
      }
      expected = std::min(expected, distance(0.5 * size, corners));
    }
    EXPECT_NEAR(scene_.body_clearance(size, pose, 20.0), expected, 1e-12);
    EXPECT_EQ(expected == 0.0, scene_.touch(size, pose).has_value());
    if (expected == 0.0) continue;
    EXPECT_EQ(scene_.body_clearance(size, pose, 0.99 * expected), kInfinity);
    EXPECT_NEAR(scene_.body_clearance(size, pose, 1.01 * expected), expected, 1e-12);
    ++apart;
  }
  EXPECT_GT(apart, 12);
}

TEST(Scene, BothKindsAnswerPointQueriesWithTheSameBits) {
  const World world = test::scattered_world(12);
  const Scene flattened(world);
  const Scene instanced(world, 0);
  RandomStream random(9);
  const Vector3d size(0.8, 0.8, 0.2);
  int touching = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose pose = test::random_pose(random, 7.0);
    const NearestPoint a = flattened.nearest(pose.translation());
    const NearestPoint b = instanced.nearest(pose.translation());
    EXPECT_EQ(a.distance_m, b.distance_m);
    EXPECT_EQ(a.instance, b.instance);
    EXPECT_EQ(a.point_world, b.point_world);
    const auto touch_a = flattened.touch(size, pose);
    const auto touch_b = instanced.touch(size, pose);
    ASSERT_EQ(touch_a.has_value(), touch_b.has_value());
    if (touch_a) {
      ++touching;
      EXPECT_EQ(touch_a->instance, touch_b->instance);
      EXPECT_EQ(touch_a->triangle, touch_b->triangle);
    }
    EXPECT_EQ(flattened.body_clearance(size, pose, 30.0),
              instanced.body_clearance(size, pose, 30.0));
  }
  EXPECT_GT(touching, 20);
}

/// Vertices a metre apart, `side` × `side` of them from the origin on, at heights that `height`
/// gives.
template <class Height>
TriangleMesh field_mesh(std::uint32_t side, Height height) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    mesh.vertices.emplace_back(static_cast<float>(i / side), static_cast<float>(i % side),
                               static_cast<float>(height()));
  }
  for (std::uint32_t i = 0; i + side + 1 < side * side; ++i) {
    if (i % side == side - 1) continue;
    mesh.triangles.push_back({i, i + side, i + side + 1});
    mesh.triangles.push_back({i, i + side + 1, i + 1});
  }
  return mesh;
}

TEST(Scene, BuildingIsEndedByWhoeverWaitsForIt) {
  // A hierarchy over one mesh of 320 000 triangles takes Embree 100 ms and more.
  RandomStream heights(3);
  const World world = test::world_of(field_mesh(401, [&] { return heights.uniform(); }));
  for (const std::size_t flatten_triangles : {std::size_t{0}, std::size_t{1'000'000}}) {
    int polls = 0;
    const PollScope scope([&polls] {
      if (++polls > 2) throw std::runtime_error("enough");
    });
    EXPECT_THROW(Scene(world, flatten_triangles), std::runtime_error);
    EXPECT_LT(polls, 6) << "it is asked whether to go on after it was ended";
    polls = -1'000'000;
    EXPECT_NEAR(Scene(world, flatten_triangles).nearest({50.0, 50.0, 20.0}).distance_m, 19.0, 1.0)
        << "another goes well";
  }
}

/// A floor of 7200 triangles: the plane of each is as near as the nearest one's.
TEST(Scene, OfAFloorFewAreVisitedWhereTheFirstVisitNarrowsTheSearch) {
  const World world = test::world_of(field_mesh(61, [] { return 0.0; }));
  for (const std::size_t flatten_triangles : {std::size_t{0}, std::size_t{1'000'000}}) {
    const Scene scene(world, flatten_triangles);
    int visits = 0;
    scene.visit_triangles({30.3, 30.4, 0.5}, 50.0, [&](const Triangle&) {
      ++visits;
      return 1.0;
    });
    // Within a metre is a disc of 0.87 m on the floor, of some ten triangles.
    EXPECT_GE(visits, 8);
    EXPECT_LT(visits, 500);
  }
}

TEST(Scene, ClearanceOverAFloorIsTheHeightOfTheLowestCorner) {
  const World world = test::world_of(test::plane_mesh(50.0F));
  const Scene scene(world);
  const Vector3d size(0.5, 0.5, 0.12);
  Pose pose = Pose::Identity();
  pose.translation() = Vector3d(1.0, -2.0, 1.5);
  EXPECT_NEAR(scene.body_clearance(size, pose, 9.0), 1.44, 1e-12);
  const double roll = 0.3;
  const double s = math::sin(roll);
  const double c = math::cos(roll);
  pose.linear() << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  EXPECT_NEAR(scene.body_clearance(size, pose, 9.0), 1.5 - 0.25 * s - 0.06 * c, 1e-12);
  EXPECT_FALSE(scene.touch(size, pose));
  pose.translation().z() = 0.25 * s + 0.06 * c - 1e-9;
  EXPECT_TRUE(scene.touch(size, pose));
  EXPECT_EQ(scene.body_clearance(size, pose, 9.0), 0.0);
}

TEST(Scene, MovesWithItsWorld) {
  // Moving everything by whole metres, which float takes exactly, moves the answers.
  World world = test::scattered_world(13, 20);
  const World before = world;
  const Vector3d shift(16.0, -8.0, 4.0);
  for (Instance& instance : world.instances) {
    instance.T_world_prototype.translation() += shift.cast<float>();
  }
  const Scene here(before);
  const Scene there(world);
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d point = test::random_point(random, 7.0);
    EXPECT_NEAR(here.nearest(point).distance_m, there.nearest(point + shift).distance_m, 4e-6);
  }
}

/// A hall with two lamps below its ceiling, of which the second is the lowest; a shelf is lower.
TEST(Scene, KnowsTheLowestPointOfCeilingsAndLamps) {
  World world;
  world.prototypes = {test::make_prototype(test::plane_mesh(5.0F)),
                      test::make_prototype(test::box_mesh({1, 1, 1}))};
  const auto add = [&](std::uint32_t prototype, const std::string& kind, float z) {
    Eigen::Affine3f T_world_prototype = Eigen::Affine3f::Identity();
    T_world_prototype.translation().z() = z;
    test::place(world, prototype, T_world_prototype, kind);
  };
  const auto lowest_m = [&] { return Scene(world).internals().lowest_ceiling_m; };
  add(0, "ground", 0.0F);
  add(1, "shelf", 1.0F);
  EXPECT_EQ(lowest_m(), kInfinity);
  add(0, "ceiling", 6.0F);
  EXPECT_EQ(lowest_m(), 6.0);
  add(1, "lamp", 5.75F);
  add(1, "lamp", 4.75F);
  add(1, "lamp", 5.5F);
  EXPECT_EQ(lowest_m(), 4.25);  // half a metre below its middle
}

/// A floor and a box that goes back and forth over it along x.
World moving_world() {
  World world;
  world.prototypes = {test::make_prototype(test::plane_mesh(20.0F)),
                      test::make_prototype(test::box_mesh({1, 1, 1}))};
  world.instances.resize(2);
  world.instances[1].prototype = world.instances[1].obstacle = 1;
  world.instances[1].T_world_prototype.translation() = Eigen::Vector3f(0, 5, 2);
  world.obstacles = {{.kind = "ground"}, {.kind = "box"}};
  world.motions = {
      {.instance = 1, .path = Sway{.amplitude_world = {3, 0, 0}, .period_s = 4.0, .phase = 0.0}}};
  return world;
}

TEST(Scene, WhatMovesIsWhereItsTimeSays) {
  const World world = moving_world();
  Scene scene(world);
  World still = world;
  still.motions.clear();
  for (const double time_s : {0.0, 0.4, 1.0, 2.9, 1.7, 4.0}) {
    scene.set_time(time_s);
    const Vector3d away(3.0 * std::sin(2.0 * math::kPi * time_s / 4.0), 0, 0);
    still.instances[1].T_world_prototype.translation() =
        world.instances[1].T_world_prototype.translation() +
        displacement_world(world.motions[0], time_s).cast<float>();
    const Scene expected(still, 0);
    EXPECT_NEAR(scene.nearest(Vector3d(0, 5, 2) + away).distance_m, 0.5, 1e-6);
    const Vector3d from(0, -3, 2), to = Vector3d(0, 5, 2) + away;
    const RayHit hit = scene.first_hit(from, to - from);
    EXPECT_EQ(hit.instance, 1U);
    EXPECT_EQ(hit.distance_m, expected.first_hit(from, to - from).distance_m);
    EXPECT_TRUE(scene.occluded(from, from + 2.0 * (to - from)));
    const Pose body = make_pose(Vector3d(0.0, 4.3, 2.0), Eigen::Quaterniond::Identity());
    const Vector3d size(0.5, 0.5, 0.2);
    EXPECT_EQ(scene.touch(size, body).has_value(), expected.touch(size, body).has_value());
    EXPECT_EQ(scene.body_clearance(size, body, 10.0), expected.body_clearance(size, body, 10.0));
    const Vector3d beside(1.0, 2.0, 1.0);
    EXPECT_EQ(scene.nearest(beside).point_world, expected.nearest(beside).point_world);
  }
}

TEST(Scene, DepthFollowsWhatMoves) {
  const World world = moving_world();
  Scene scene(world);
  World still = world;
  still.motions.clear();
  const Pinhole camera = make_pinhole(64, 48, 1.4, 15.0);
  Pose pose = Pose::Identity();
  pose.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // looks along +y, image up is +z
  pose.translation() = Vector3d(0, -3, 2);
  std::vector<float> seen(64 * 48), expected(64 * 48);
  for (const double time_s : {0.0, 0.7, 1.3, 3.1}) {
    scene.set_time(time_s);
    render_depth(scene, camera, pose, seen);
    still.instances[1].T_world_prototype.translation() =
        world.instances[1].T_world_prototype.translation() +
        displacement_world(world.motions[0], time_s).cast<float>();
    render_depth(Scene(still, 0), camera, pose, expected);
    EXPECT_EQ(std::memcmp(seen.data(), expected.data(), seen.size() * sizeof(float)), 0) << time_s;
  }
}

}  // namespace
}  // namespace avoidbench
