#pragma once

#include "support/test_worlds.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"

/// Worlds to fly in: a floor at z = 0 in a box of space, with obstacles where a test wants them.
namespace avoidbench::test {

/// 40 m × 40 m around the origin, 10 m high, empty but for the floor.
inline World flight_world() {
  World world;
  world.bounds = Aabb(Eigen::Vector3d(-20, -20, -0.5), Eigen::Vector3d(20, 20, 10));
  world.flight_bounds = Aabb(Eigen::Vector3d(-20, -20, 0), Eigen::Vector3d(20, 20, 10));
  world.start_region = {{-5, -18, 2}, {5, -14, 2}};
  world.goal_region = {{-5, 14, 2}, {5, 18, 2}};
  world.prototypes.push_back(make_prototype(plane_mesh(30.0F)));
  world.instances.push_back({});
  world.obstacles.push_back({.kind = "ground"});
  return world;
}

/// Adds a mesh of its own kind of obstacle.
inline void add_obstacle(World& world, TriangleMesh mesh, const Eigen::Vector3d& position,
                         const std::string& kind) {
  Instance instance;
  instance.prototype = static_cast<std::uint32_t>(world.prototypes.size());
  instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
  instance.T_world_prototype.translation() = position.cast<float>();
  world.prototypes.push_back(make_prototype(std::move(mesh)));
  world.instances.push_back(instance);
  world.obstacles.push_back({.kind = kind, .position_world = position});
}

/// An upright closed prism of many sides around the z axis, from z = 0 to `height_m`.
inline TriangleMesh cylinder_mesh(double radius_m, double height_m, unsigned sides) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < sides; ++i) {
    const double angle = math::kTau * i / sides;
    const auto x = static_cast<float>(radius_m * math::cos(angle));
    const auto y = static_cast<float>(radius_m * math::sin(angle));
    mesh.vertices.emplace_back(x, y, 0.0F);
    mesh.vertices.emplace_back(x, y, static_cast<float>(height_m));
  }
  for (unsigned i = 0; i < sides; ++i) {
    const unsigned low = 2 * i, next = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
    if (i == 0 || i + 1 == sides) continue;  // caps as fans around the first vertex
    mesh.triangles.push_back({1, low + 1, next + 1});
    mesh.triangles.push_back({0, next, low});
  }
  return mesh;
}

/// From (0, -15, 2) to (0, 15, 2).
inline Mission straight_mission() {
  return {.start_world = {0, -15, 2}, .goal_world = {0, 15, 2}, .start_yaw_rad = 0.5 * math::kPi};
}

}  // namespace avoidbench::test
