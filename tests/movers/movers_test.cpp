#include "movers/movers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "maps/map_spec.hpp"
#include "movers/mover_shapes.hpp"
#include "support/flight_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kLimit_s = 40.0;

MoverCourse course(std::uint64_t seed = 5) {
  return {.seed = seed,
          .start_world = {0, -15, 2},
          .goal_world = {0, 15, 2},
          .speed_limit_mps = 3.0,
          .time_limit_s = kLimit_s};
}

/// Where a mover is, one after the map's instances.
Vector3d place_at(const World& world, std::size_t instance, double time_s) {
  Vector3d place = world.instances[instance].T_world_prototype.translation().cast<double>();
  for (const Motion& motion : world.motions) {
    if (motion.instance == instance) place += displacement_world(motion, time_s);
  }
  return place;
}

const Motion& motion_of(const World& world, std::size_t instance) {
  return *std::find_if(world.motions.begin(), world.motions.end(),
                       [&](const Motion& m) { return m.instance == instance; });
}

World forest(std::uint64_t seed = 1) {
  ForestSpec spec;
  spec.poisson_radius_m = 3.5;
  return make_world(spec, seed);
}

/// Every motion of every kind, on a flat hall and an uneven forest.
struct Case {
  MoverMotion motion;
  bool is_forest;
};

class EveryMotion : public testing::TestWithParam<Case> {
 protected:
  World map_ = GetParam().is_forest ? forest() : test::flight_world();
  Scene scene_{map_};
  MoverCourse course_ = [this] {
    if (!GetParam().is_forest) return course();
    const Vector3d middle = map_.flight_bounds.center();
    const double ground_m = ground_height_m(map_, middle.x(), middle.y());
    return MoverCourse{.seed = 5,
                       .start_world = {middle.x(), 4.0, ground_m + 2.0},
                       .goal_world = {middle.x(), 36.0, ground_m + 2.0},
                       .speed_limit_mps = 3.0,
                       .time_limit_s = kLimit_s};
  }();
  MoversSpec spec_{.count = 40, .kind = MoverKind::mixed, .motion = GetParam().motion};
};

INSTANTIATE_TEST_SUITE_P(
    All, EveryMotion,
    testing::Values(Case{MoverMotion::stand, false}, Case{MoverMotion::walk, false},
                    Case{MoverMotion::cross, false}, Case{MoverMotion::trefoil, false},
                    Case{MoverMotion::chase, false}, Case{MoverMotion::stand, true},
                    Case{MoverMotion::walk, true}, Case{MoverMotion::cross, true},
                    Case{MoverMotion::trefoil, true}, Case{MoverMotion::chase, true}),
    [](const auto& suite) {
      return std::string(text(suite.param.motion)) + (suite.param.is_forest ? "Forest" : "Hall");
    });

TEST_P(EveryMotion, KeepsToTheFlightBoxTheGroundAndItsSpeed) {
  const World world = with_movers(scene_, spec_, course_);
  ASSERT_EQ(world.instances.size(), map_.instances.size() + 40);
  const Aabb& box = world.flight_bounds;
  const bool is_standing = GetParam().motion == MoverMotion::stand;
  EXPECT_EQ(world.motions.size(), is_standing ? 0U : 40U);
  std::set<std::string> kinds;
  for (std::size_t i = map_.instances.size(); i < world.instances.size(); ++i) {
    const std::string& kind = world.obstacles[world.instances[i].obstacle].kind;
    kinds.insert(kind);
    const bool is_grounded = kind == "person" || kind == "pole";
    const double half_m = 0.5 * world.obstacles[world.instances[i].obstacle].width_m;
    const Vector3d first = place_at(world, i, 0.0);
    EXPECT_GE((first - course_.start_world).head<2>().norm(), 3.0 + half_m - 1e-5);
    for (int k = 0; k <= 400; ++k) {
      const Vector3d place = place_at(world, i, kLimit_s * k / 400.0);
      EXPECT_TRUE(box.contains(Vector3d(place.x(), place.y(), box.center().z()))) << kind;
      const double ground_m = ground_height_m(world, place.x(), place.y());
      if (is_grounded) {
        EXPECT_NEAR(place.z(), ground_m, 0.1) << kind;  // straight between knots
      } else {
        EXPECT_GE(place.z() + 1e-5, ground_m) << kind;
        EXPECT_LE(place.z(), box.max().z()) << kind;
      }
    }
    if (is_standing) continue;
    const double greatest_mps = greatest_speed_mps(motion_of(world, i));
    EXPECT_GE(greatest_mps, 0.5 * 0.7) << kind;
    // Up a slope it is faster than along its shadow.
    EXPECT_LE(greatest_mps, 2.0 * (is_grounded && GetParam().is_forest ? 1.5 : 1.0 + 1e-6)) << kind;
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"ball", "box", "person", "pole"}));
}

TEST_P(EveryMotion, IsAFunctionOfItsSeedAndEachMoverOfItsOwn) {
  const World world = with_movers(scene_, spec_, course_);
  EXPECT_EQ(world_digest(world), world_digest(with_movers(scene_, spec_, course_)));
  EXPECT_EQ(world.digest, map_.digest);
  MoverCourse other = course_;
  other.seed = 6;
  EXPECT_NE(world_digest(world), world_digest(with_movers(scene_, spec_, other)));
  // More of them leave the first where they are.
  MoversSpec fewer = spec_;
  fewer.count = 15;
  const World few = with_movers(scene_, fewer, course_);
  for (std::size_t i = map_.instances.size(); i < few.instances.size(); ++i) {
    for (const double time_s : {0.0, 3.0, 17.0}) {
      EXPECT_EQ(place_at(few, i, time_s), place_at(world, i, time_s));
    }
  }
}

TEST(Movers, WalkersTouchNothingThatStands) {
  const World map = forest(3);
  const Scene scene(map);
  MoversSpec spec{.count = 30};
  MoverCourse flight = course();
  flight.start_world = {20, 4, 2};
  flight.goal_world = {20, 36, 2};
  const World world = with_movers(scene, spec, flight);
  double way_m = 0.0;
  for (std::size_t i = map.instances.size(); i < world.instances.size(); ++i) {
    for (int k = 0; k < 400; ++k) {
      const Vector3d place = place_at(world, i, 0.1 * k);
      way_m += (place_at(world, i, 0.1 * k + 0.1) - place).norm();
      EXPECT_GT(scene.nearest(place + Vector3d(0, 0, 0.5), 1.0).distance_m, 0.1);
      EXPECT_GT(scene.nearest(place + Vector3d(0, 0, 1.5), 1.0).distance_m, 0.1);
    }
  }
  EXPECT_GT(way_m / 30.0, 10.0) << "they do walk";
}

TEST(Movers, WhoCrossesIsWhereTheVehicleWouldBe) {
  const World map = test::flight_world();
  const Scene scene(map);
  MoversSpec spec{.count = 20, .kind = MoverKind::ball, .motion = MoverMotion::cross};
  const World world = with_movers(scene, spec, course());
  for (std::size_t i = 1; i < world.instances.size(); ++i) {
    double nearest_m = 1e9;
    for (int k = 0; k <= 10000; ++k) {
      const double time_s = 0.001 * k;
      const Vector3d vehicle(0.0, -15.0 + 3.0 * time_s, 2.0);
      nearest_m = std::min(nearest_m, (place_at(world, i, time_s) - vehicle).norm());
    }
    EXPECT_LT(nearest_m, 0.01);
    // At right angles to the line.
    EXPECT_NEAR(state_at(motion_of(world, i), 1.234).velocity_world.y(), 0.0, 1e-9);
  }
}

TEST(Movers, WhoChasesWaitsAndComesToTheGoal) {
  const World map = test::flight_world();
  const Scene scene(map);
  MoversSpec spec{
      .count = 10, .kind = MoverKind::box, .motion = MoverMotion::chase, .speed_mps = {2.0, 2.0}};
  const World world = with_movers(scene, spec, course());
  for (std::size_t i = 1; i < world.instances.size(); ++i) {
    const Motion& motion = motion_of(world, i);
    const double delay_s = std::get<Route>(motion.path).knots.front().time_s;
    EXPECT_LE(delay_s, 3.0);
    const Vector3d from = place_at(world, i, 0.0);
    EXPECT_EQ(place_at(world, i, delay_s), from);
    const double length_m = (course().goal_world - from).norm();
    EXPECT_LT((place_at(world, i, delay_s + length_m / 2.0) - course().goal_world).norm(), 1e-5);
    EXPECT_LT(
        (place_at(world, i, delay_s + length_m / 4.0) - 0.5 * (from + course().goal_world)).norm(),
        1e-5);
  }
}

TEST(Movers, PeopleFaceWhereTheyGo) {
  const World map = test::flight_world();
  const Scene scene(map);
  for (const MoverMotion kind : {MoverMotion::walk, MoverMotion::cross, MoverMotion::chase}) {
    const World world = with_movers(scene, {.count = 10, .motion = kind}, course());
    int seen = 0;
    for (const Motion& motion : world.motions) {
      for (int k = 0; k < 390; ++k) {
        const MotionState state = state_at(motion, 0.1 * k);
        if (state.velocity_world.norm() < 0.1) continue;
        const Eigen::Affine3f T =
            moved(world.instances[motion.instance].T_world_prototype, motion, 0.1 * k);
        const Vector3d forward = T.linear().col(0).cast<double>();
        EXPECT_GT(forward.dot(state.velocity_world.normalized()), 0.999);
        ++seen;
      }
    }
    EXPECT_GT(seen, 500);
  }
}

TEST(Movers, ShapesHaveTheirSizes) {
  const auto size_of = [](MoverKind kind) {
    Aabb box;
    for (const Eigen::Vector3f& vertex : mover_prototype(kind).mesh.vertices) {
      box.extend(vertex.cast<double>());
    }
    return Vector3d(box.sizes());
  };
  EXPECT_LT((size_of(MoverKind::person) - Vector3d(0.3, 0.5, 1.75)).norm(), 1e-6);
  EXPECT_LT((size_of(MoverKind::box) - Vector3d(1, 1, 1)).norm(), 1e-6);
  EXPECT_LT((size_of(MoverKind::ball) - Vector3d(1, 1, 1)).norm(), 1e-3);
  EXPECT_LT((size_of(MoverKind::pole) - Vector3d(0.2, 0.2, 4.0)).norm(), 1e-6);
  EXPECT_EQ(mover_shape(MoverKind::ball, 0.6).scale, 0.6);
}

TEST(Movers, MixedOnesHaveEachKindInEachMotion) {
  const World map = test::flight_world();
  const Scene scene(map);
  const World world = with_movers(
      scene, {.count = 16, .kind = MoverKind::mixed, .motion = MoverMotion::mixed}, course());
  std::map<std::pair<std::string, std::size_t>, int> counts;
  for (const Motion& motion : world.motions) {
    const std::string& kind = world.obstacles[world.instances[motion.instance].obstacle].kind;
    ++counts[{kind, motion.path.index()}];
  }
  for (const std::string kind : {"person", "box", "ball", "pole"}) {
    EXPECT_EQ((counts[{kind, 1}]), 3) << kind;  // walk, cross and chase are routes
    EXPECT_EQ((counts[{kind, 2}]), 1) << kind;
  }
}

TEST(Movers, ADensityIsOfTheFlightBox) {
  const World map = test::flight_world();  // 40 m × 40 m
  EXPECT_EQ(mover_count({.density_1pm2 = 0.05}, map), 80);
  EXPECT_EQ(mover_count({.count = 7}, map), 7);
  EXPECT_FALSE(has_movers({}));
  EXPECT_TRUE(has_movers({.density_1pm2 = 0.01}));
}

TEST(Movers, AMapWithoutPlaceForThemIsSaidSo) {
  const World map = test::flight_world();
  const Scene scene(map);
  try {
    with_movers(scene, {.count = 3, .start_clearance_m = 90.0}, course());
    FAIL() << "no place is that far away";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "movers: no place for number 0, person that is to walk, in the flight box at least "
              "start_clearance_m, 90 m, from the start: take smaller ones, a smaller "
              "start_clearance_m or a larger map");
  }
}

TEST(Movers, ContradictionsAreFound) {
  EXPECT_TRUE(mover_problems({}).empty());
  const std::vector<std::string> found =
      mover_problems({.count = 3, .density_1pm2 = 0.1, .speed_mps = {2.0, 1.0}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], "density_1pm2: replaces count, but both are given");
  EXPECT_EQ(found[1], "speed_mps: the least, 2, is above the greatest, 1");
}

}  // namespace
}  // namespace avoidbench
