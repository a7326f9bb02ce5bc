#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/box_triangle.hpp"
#include "geometry/pose.hpp"
#include "world/world.hpp"

/// Small worlds made by hand, of shapes whose depths and distances are known.
namespace avoidbench::test {

inline Prototype make_prototype(TriangleMesh mesh, Material material = Material::concrete) {
  Prototype prototype;
  prototype.name = "hand-made";
  prototype.triangle_materials.assign(mesh.triangles.size(), material);
  prototype.mesh = std::move(mesh);
  return prototype;
}

/// Two triangles in z = 0, |x| and |y| up to `half_size`, seen from above.
inline TriangleMesh plane_mesh(float half_size) {
  TriangleMesh mesh;
  mesh.vertices = {{-half_size, -half_size, 0.0F},
                   {half_size, -half_size, 0.0F},
                   {half_size, half_size, 0.0F},
                   {-half_size, half_size, 0.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A box around the origin.
inline TriangleMesh box_mesh(const Eigen::Vector3f& size) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(((i & 1U) != 0 ? 0.5F : -0.5F) * size.x(),
                               ((i & 2U) != 0 ? 0.5F : -0.5F) * size.y(),
                               ((i & 4U) != 0 ? 0.5F : -0.5F) * size.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The unit sphere from an icosahedron, each triangle split in four `splits` times; vertices on the
/// sphere.
inline TriangleMesh sphere_mesh(int splits) {
  const float g = 1.6180339887F;
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.normalize();
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        const Eigen::Vector3f sum = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(sum.normalized());
      }
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      for (const auto& triangle :
           {std::array<std::uint32_t, 3>{a, ab, ca}, std::array<std::uint32_t, 3>{b, bc, ab},
            std::array<std::uint32_t, 3>{c, ca, bc}, std::array<std::uint32_t, 3>{ab, bc, ca}}) {
        finer.push_back(triangle);
      }
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// Adds an instance and an obstacle of its own.
inline void place(World& world, std::uint32_t prototype, const Eigen::Affine3f& T_world_prototype,
                  const std::string& kind = "thing") {
  Instance instance;
  instance.prototype = prototype;
  instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
  instance.T_world_prototype = T_world_prototype;
  world.instances.push_back(instance);
  Obstacle obstacle;
  obstacle.kind = kind;
  obstacle.position_world = T_world_prototype.translation().cast<double>();
  world.obstacles.push_back(obstacle);
}

/// One mesh where it was made.
inline World world_of(TriangleMesh mesh) {
  World world;
  world.prototypes.push_back(make_prototype(std::move(mesh)));
  place(world, 0, Eigen::Affine3f::Identity());
  return world;
}

/// A random rotation.
inline Eigen::Quaterniond random_rotation(RandomStream& random) {
  const double w = random.normal();
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

inline Eigen::Vector3d random_point(RandomStream& random, double half_size) {
  const double x = random.uniform(-half_size, half_size);
  const double y = random.uniform(-half_size, half_size);
  const double z = random.uniform(-half_size, half_size);
  return {x, y, z};
}

inline Pose random_pose(RandomStream& random, double half_size) {
  const Eigen::Quaterniond rotation = random_rotation(random);
  return make_pose(random_point(random, half_size), rotation);
}

/// Boxes and spheres in any attitude and of scales from 0.5 to 2, in a cube of 12 m, over a floor
/// at z = −6 m.
inline World scattered_world(std::uint64_t seed, int count = 60) {
  World world;
  world.prototypes.push_back(make_prototype(plane_mesh(20.0F)));
  world.prototypes.push_back(make_prototype(box_mesh({0.6F, 1.0F, 0.3F}), Material::brick));
  world.prototypes.push_back(make_prototype(sphere_mesh(2), Material::leaf));
  Eigen::Affine3f floor = Eigen::Affine3f::Identity();
  floor.translation().z() = -6.0F;
  place(world, 0, floor, "ground");
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Pose pose = random_pose(random, 6.0);
    const double scale = random.uniform(0.5, 2.0);
    Eigen::Affine3f T_world_prototype = Eigen::Affine3f::Identity();
    T_world_prototype.linear() = (scale * pose.linear()).cast<float>();
    T_world_prototype.translation() = pose.translation().cast<float>();
    place(world, i % 2 == 0 ? 1 : 2, T_world_prototype);
  }
  return world;
}

/// A triangle in the world's frame, and whose it is.
struct PlacedTriangle {
  std::uint32_t instance = 0, triangle = 0;
  Triangle corners;
};

/// Every triangle of the world: the float vertices through the float transforms in double.
inline std::vector<PlacedTriangle> all_triangles(const World& world) {
  std::vector<PlacedTriangle> placed;
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    const Instance& instance = world.instances[i];
    const Eigen::Matrix4d matrix = instance.T_world_prototype.matrix().cast<double>();
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    const Eigen::Vector3d position = matrix.topRightCorner<3, 1>();
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      PlacedTriangle& added = placed.emplace_back();
      added.instance = i;
      added.triangle = t;
      for (std::size_t k = 0; k < 3; ++k) {
        added.corners[k] = linear * mesh.vertices[mesh.triangles[t][k]].cast<double>() + position;
      }
    }
  }
  return placed;
}

/// Parameter where the ray meets the triangle, by its plane and its three edges; +inf where it does
/// not.
inline double ray_parameter(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                            const Triangle& triangle) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double t = normal.dot(triangle[0] - origin) / normal.dot(direction);
  if (!(t >= 0.0)) return kInfinity;
  const Eigen::Vector3d point = origin + t * direction;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = triangle[(k + 1) % 3] - triangle[k];
    if (edge.cross(point - triangle[k]).dot(normal) < 0.0) return kInfinity;
  }
  return t;
}

/// A camera at `position` that looks along `forward`, its image upright where it can be.
inline Pose looking(const Eigen::Vector3d& position, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d z = forward.normalized();
  const Eigen::Vector3d up =
      std::abs(z.z()) < 0.99 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  Pose pose = Pose::Identity();
  pose.linear().col(2) = z;
  pose.linear().col(0) = z.cross(up).normalized();
  pose.linear().col(1) = z.cross(Eigen::Vector3d(pose.linear().col(0)));
  pose.translation() = position;
  return pose;
}

}  // namespace avoidbench::test
