#include "world/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "world/world.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Motion sway() {
  return {.instance = 0,
          .path = Sway{.amplitude_world = {3.0, -1.0, 0.5}, .period_s = 7.0, .phase = 0.3}};
}

Motion trefoil() {
  return {.instance = 0,
          .path = Trefoil{
              .reach_m = 3.0, .rise_m = 0.5, .period_s = 11.0, .phase = 0.2, .heading_rad = 0.7}};
}

/// Two legs with a turn on the spot between them.
Motion route() {
  return {.instance = 0,
          .path = Route{{{1.0, {0.0, 0.0, 0.0}, 0.0},
                         {3.0, {4.0, 0.0, 0.0}, 0.0},
                         {3.5, {4.0, 0.0, 0.0}, math::kPi / 2.0},
                         {5.5, {4.0, 3.0, 1.0}, math::kPi / 2.0}}}};
}

TEST(Motion, VelocitiesAreThoseOfTheOffsets) {
  constexpr double kStep_s = 1e-5;
  for (const Motion& motion : {sway(), trefoil(), route()}) {
    double greatest_mps = 0.0;
    for (int i = 0; i < 1100; ++i) {
      const double time_s = 0.01 * i + 0.005;
      const Vector3d before = displacement_world(motion, time_s - kStep_s);
      const Vector3d after = displacement_world(motion, time_s + kStep_s);
      const MotionState now = state_at(motion, time_s);
      EXPECT_LT(((after - before) / (2.0 * kStep_s) - now.velocity_world).norm(), 1e-5) << time_s;
      greatest_mps = std::max(greatest_mps, now.velocity_world.norm());
    }
    EXPECT_LE(greatest_mps, greatest_speed_mps(motion) * (1.0 + 1e-12));
    EXPECT_GE(greatest_mps, greatest_speed_mps(motion) * 0.9999);
  }
}

TEST(Motion, ATrefoilIsOne) {
  const Trefoil knot = std::get<Trefoil>(trefoil().path);
  const Motion straight{.instance = 0, .path = Trefoil{.reach_m = 3.0, .rise_m = 0.5}};
  EXPECT_TRUE(displacement_world(straight, 0.0).isApprox(Vector3d(0.0, -1.0, 0.0), 1e-12));
  // At a quarter: (1 + 0, 0 + 2) · reach/3 and sin(3π/2).
  EXPECT_TRUE(displacement_world(straight, 0.25).isApprox(Vector3d(1.0, 2.0, -0.5), 1e-12));
  for (int i = 0; i < 100; ++i) {
    EXPECT_LE(displacement_world(trefoil(), 0.11 * i).head<2>().norm(), knot.reach_m + 1e-12);
  }
  EXPECT_LT((displacement_world(trefoil(), 2.0) - displacement_world(trefoil(), 13.0)).norm(),
            1e-12);
}

TEST(Motion, ARouteGoesFromKnotToKnot) {
  const Motion motion = route();
  EXPECT_EQ(displacement_world(motion, 0.0), Vector3d::Zero());
  EXPECT_EQ(state_at(motion, 0.5).velocity_world, Vector3d::Zero());
  EXPECT_EQ(displacement_world(motion, 2.0), Vector3d(2.0, 0.0, 0.0));
  EXPECT_EQ(state_at(motion, 2.0).velocity_world, Vector3d(2.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(state_at(motion, 3.25).turn_rad, math::kPi / 4.0);
  EXPECT_EQ(displacement_world(motion, 3.25), Vector3d(4.0, 0.0, 0.0));
  EXPECT_EQ(displacement_world(motion, 99.0), Vector3d(4.0, 3.0, 1.0));
  EXPECT_EQ(state_at(motion, 99.0).velocity_world, Vector3d::Zero());
  EXPECT_DOUBLE_EQ(greatest_speed_mps(motion), 2.0);
  EXPECT_DOUBLE_EQ(greatest_turn_radps(motion), math::kPi);
}

/// A world of one instance with a vertex 2 m to its side and one above it.
World world_of(const Motion& motion) {
  World world;
  Prototype prototype;
  prototype.mesh.vertices = {{0.0F, 0.0F, 9.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  prototype.mesh.triangles = {{0, 1, 2}};
  prototype.triangle_materials = {Material::brick};
  world.prototypes = {prototype};
  world.instances.resize(1);
  world.instances[0].T_world_prototype.translation() = Eigen::Vector3f(10.0F, 0.0F, 1.0F);
  world.obstacles = {{.kind = "thing", .position_world = {10.0, 0.0, 1.0}}};
  world.motions = {motion};
  return world;
}

TEST(Motion, NoPointIsFasterThanTheGreatestSurfaceSpeed) {
  for (const Motion& motion : {sway(), trefoil(), route()}) {
    const World world = world_of(motion);
    const Instance& instance = world.instances[0];
    const double greatest_mps = greatest_surface_speed_mps(world, motion);
    for (int i = 0; i < 600; ++i) {
      const double time_s = 0.01 * i;
      for (const Eigen::Vector3f& vertex : world.prototypes[0].mesh.vertices) {
        const auto at = [&](double t_s) {
          return (moved(instance.T_world_prototype, motion, t_s) * vertex).cast<double>().eval();
        };
        EXPECT_LE((at(time_s + 0.01) - at(time_s)).norm(), 0.01 * greatest_mps + 1e-5) << time_s;
      }
    }
  }
  EXPECT_DOUBLE_EQ(greatest_surface_speed_mps(world_of(route()), route()), 2.0 + 2.0 * math::kPi);
}

TEST(Motion, AWorldStandsAsItIsAtAMoment) {
  const World world = world_of(route());
  const World still = standing_at(world, 4.5);
  EXPECT_TRUE(still.motions.empty());
  const Vector3d expected = Vector3d(10.0, 0.0, 1.0) + displacement_world(route(), 4.5);
  EXPECT_LT((still.instances[0].T_world_prototype.translation().cast<double>() - expected).norm(),
            1e-6);
  EXPECT_LT((still.obstacles[0].position_world - expected).norm(), 1e-12);
  // Turned by a quarter: what was at +x is at +y.
  const Eigen::Vector3f side =
      still.instances[0].T_world_prototype.linear() * Eigen::Vector3f(2.0F, 0.0F, 0.0F);
  EXPECT_LT((side - Eigen::Vector3f(0.0F, 2.0F, 0.0F)).norm(), 1e-6F);
}

TEST(Motion, EveryNumberOfAWayIsInTheDigest) {
  const auto digest = [](const auto& path) {
    return world_digest(world_of({.instance = 0, .path = path}));
  };
  const Trefoil knot = std::get<Trefoil>(trefoil().path);
  for (double Trefoil::*number : {&Trefoil::reach_m, &Trefoil::rise_m, &Trefoil::period_s,
                                  &Trefoil::phase, &Trefoil::heading_rad}) {
    Trefoil other = knot;
    other.*number += 0.01;
    EXPECT_NE(digest(other), digest(knot));
  }
  const Route way = std::get<Route>(route().path);
  Route other = way;
  other.knots[2].time_s += 0.01;
  EXPECT_NE(digest(other), digest(way));
  other = way;
  other.knots[2].turn_rad += 0.01;
  EXPECT_NE(digest(other), digest(way));
  other = way;
  other.knots[2].offset_world.z() += 0.01;
  EXPECT_NE(digest(other), digest(way));
}

}  // namespace
}  // namespace avoidbench
