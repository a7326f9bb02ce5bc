#include "sensing/tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "avoidbench/planner.h"
#include "base/math.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// A floor, and on the x axis at 1, 2, … m balls that all sway alike along y.
World world_of(int count) {
  World world;
  world.prototypes = {test::make_prototype(test::plane_mesh(20.0F)),
                      test::make_prototype(test::box_mesh({0.4F, 0.6F, 1.0F}))};
  world.instances.resize(1);
  world.obstacles = {{.kind = "ground"}};
  for (int i = 0; i < count; ++i) {
    Instance instance;
    instance.prototype = 1;
    instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
    instance.T_world_prototype.translation() =
        Eigen::Vector3f(static_cast<float>(i + 1), 0.0F, 2.0F);
    instance.T_world_prototype.linear() *= 2.0F;
    world.motions.push_back({.instance = static_cast<std::uint32_t>(world.instances.size()),
                             .path = Sway{.amplitude_world = {0, 1, 0}, .period_s = 4.0}});
    world.instances.push_back(instance);
    world.obstacles.push_back({.kind = i % 2 == 0 ? "ball" : "crate"});
  }
  return world;
}

std::vector<Track> seen(const TracksSpec& spec, const World& world, const TracksAsked& asked,
                        std::uint64_t seed = 3) {
  return tracks_at(spec, world, tracked_things(world, seed), seed, asked);
}

TEST(Tracks, AreTrueByDefault) {
  const World world = world_of(4);
  const std::vector<Track> tracks = seen({}, world, {.now = ticks(1.0)});
  ASSERT_EQ(tracks.size(), 4U);
  std::set<std::uint32_t> ids;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    ids.insert(tracks[i].id);
    EXPECT_EQ(tracks[i].time_s, 1.0);
    EXPECT_EQ(tracks[i].kind, i % 2 == 0 ? AB_TRACK_BALL : AB_TRACK_OTHER);
    EXPECT_LT((tracks[i].center_world - Vector3d(static_cast<double>(i) + 1.0, 1.0, 2.0)).norm(),
              1e-6);
    EXPECT_LT(tracks[i].velocity_world.norm(), 1e-9);
    EXPECT_LT((tracks[i].size_m - Vector3d(0.8, 1.2, 2.0)).norm(), 1e-6);
  }
  EXPECT_EQ(ids.size(), 4U);
  const std::vector<Track> crossing = seen({}, world, {.now = ticks(2.0)});
  EXPECT_LT((crossing[0].velocity_world - Vector3d(0, -math::kPi / 2.0, 0)).norm(), 1e-9);
  EXPECT_EQ(crossing[0].id, tracks[0].id);
  EXPECT_NE(seen({}, world, {.now = ticks(2.0)}, 4)[0].id, tracks[0].id);
}

TEST(Tracks, AreOfTheNewestScanThatIsReady) {
  const World world = world_of(1);
  const TracksSpec spec{.rate_hz = 10.0, .delay_ms = 150.0};
  EXPECT_TRUE(seen(spec, world, {.now = ticks(0.149)}).empty());
  EXPECT_EQ(seen(spec, world, {.now = ticks(0.15)}).at(0).time_s, 0.0);
  EXPECT_EQ(seen(spec, world, {.now = ticks(0.249)}).at(0).time_s, 0.0);
  const Track late = seen(spec, world, {.now = ticks(1.249)}).at(0);
  EXPECT_EQ(late.time_s, 1.0);
  EXPECT_NEAR(late.center_world.y(), 1.0, 1e-6);
}

TEST(Tracks, EndAtTheRangeAndTheFieldOfView) {
  const World world = world_of(9);
  EXPECT_EQ(seen({.range_m = 5.5}, world, {}).size(), 5U);  // its own height is 2 m below
  Pose turned = Pose::Identity();
  turned.translation() = Vector3d(5.5, 0, 2);
  EXPECT_EQ(seen({}, world, {.T_world_body = turned}).size(), 9U);
  EXPECT_EQ(seen({.fov_deg = 90}, world, {.T_world_body = turned}).size(), 4U);
  turned.linear() = Eigen::AngleAxisd(math::kPi, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_EQ(seen({.fov_deg = 90}, world, {.T_world_body = turned}).size(), 5U);
  turned.linear() = Eigen::AngleAxisd(0.5 * math::kPi, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(seen({.fov_deg = 90}, world, {.T_world_body = turned}).empty());
}

TEST(Tracks, NoiseHasItsSizeAndIsNewInEachScan) {
  const World world = world_of(1);
  const TracksSpec spec{.position_noise_m = 0.2, .velocity_noise_mps = 0.5};
  double place_square = 0.0, speed_square = 0.0;
  constexpr int kScans = 4000;
  for (int i = 0; i < kScans; ++i) {
    const Tick now = i * ticks(0.05);
    const Track track = seen(spec, world, {.now = now}).at(0);
    const Track truth = seen({}, world, {.now = now}).at(0);
    place_square += (track.center_world - truth.center_world).squaredNorm();
    speed_square += (track.velocity_world - truth.velocity_world).squaredNorm();
    EXPECT_EQ(track.center_world, seen(spec, world, {.now = now + 1}).at(0).center_world);
  }
  EXPECT_NEAR(std::sqrt(place_square / (3 * kScans)), 0.2, 0.005);
  EXPECT_NEAR(std::sqrt(speed_square / (3 * kScans)), 0.5, 0.0125);
}

TEST(Tracks, AShareOfThemIsMissed) {
  const World world = world_of(10);
  std::size_t count = 0;
  for (int i = 0; i < 500; ++i) {
    count += seen({.miss_ratio = 0.3}, world, {.now = i * ticks(0.05)}).size();
  }
  EXPECT_NEAR(static_cast<double>(count) / 5000.0, 0.7, 0.03);
}

TEST(Tracks, FalseOnesStayForASecondWithinRange) {
  const World world = world_of(0);
  const TracksSpec spec{.range_m = 6.0, .false_count = 1.5};
  std::size_t count = 0;
  for (int second = 0; second < 400; ++second) {
    const Tick first = second * kTicksPerSecond;
    const std::vector<Track> tracks = seen(spec, world, {.now = first});
    count += tracks.size();
    const std::vector<Track> later = seen(spec, world, {.now = first + ticks(0.9)});
    ASSERT_EQ(tracks.size(), later.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      EXPECT_EQ(tracks[i].id, later[i].id);
      EXPECT_EQ(tracks[i].center_world, later[i].center_world);
      EXPECT_LE(tracks[i].center_world.norm(), 6.0);
    }
  }
  EXPECT_NEAR(static_cast<double>(count) / 400.0, 1.5, 0.1);
}

TEST(Tracks, OfWhatIsHeldStillHaveNoVelocity) {
  const World world = world_of(1);
  const Track track = seen({}, world, {.now = ticks(2.0), .still_at_s = 1.0}).at(0);
  EXPECT_EQ(track.velocity_world, Vector3d::Zero());
  EXPECT_NEAR(track.center_world.y(), 1.0, 1e-6);
  EXPECT_EQ(track.time_s, 2.0);
}

}  // namespace
}  // namespace avoidbench
