#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/box_triangle.hpp"
#include "render/embree.hpp"
#include "render/scene.hpp"
#include "render/triangle_plane.hpp"

namespace avoidbench {

/// Maps of at most this many triangles, counted over all instances, are flattened into one
/// hierarchy: a forest's depth image then takes 0.6 of the time of the instanced one, for 0.9 µs of
/// building and 105 bytes per triangle. Larger maps keep one hierarchy per prototype.
inline constexpr std::size_t kFlattenTriangles = 1'000'000;

/// How one instance stands in the world, in double.
struct Placement {
  Eigen::Matrix3d linear_world_prototype = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d linear_prototype_world = Eigen::Matrix3d::Identity();
  double scale = 1.0;
};

/// In Embree's scene an instance's index is the hit's geomID where flattened, else its instID.
/// Invariants: placements and planes_of have one entry an instance, the latter's point into planes;
/// where anything moves, `flattened` is false; `top`, instance_boxes and bounds stand at the same
/// time, that of the last set_time().
struct Scene::Internals {
  const World* world = nullptr;
  bool flattened = true;
  embree::SceneHandle top;
  std::vector<embree::SceneHandle> prototypes;  ///< empty where flattened
  embree::SceneHandle
      instance_boxes;  ///< an instance a primitive, for point queries; none where flattened
  std::vector<RTCBounds> bounds;  ///< its boxes
  std::vector<std::vector<TrianglePlane>>
      planes;  ///< one list an instance where flattened, else a prototype
  /// One an instance: its triangles' planes, in the world's frame where flattened, else in the
  /// prototype's.
  std::vector<const TrianglePlane*> planes_of;
  std::vector<Placement> placements;  ///< one an instance
  /// The lowest point of all ceilings and lamps, where they stand at first; +inf: there are none.
  /// In shaded images the sun shines through them, else halls would be dark.
  double lowest_ceiling_m = std::numeric_limits<double>::infinity();
};

/// Builds the hierarchy. `flatten_triangles` is a parameter so that tests can compare both kinds on
/// one world.
std::unique_ptr<Scene::Internals> build_internals(const World& world,
                                                  std::size_t flatten_triangles);

/// Puts the world's moving instances where they stand at `time_s`.
void move_instances(Scene::Internals& scene, double time_s);

/// The triangle of an instance in the world's frame: the float vertices through the float transform
/// in double. All exact queries use it, whether the hierarchy is flattened or not, so that both
/// give the same answers.
inline Triangle world_triangle(const Scene::Internals& scene, std::uint32_t instance,
                               std::uint32_t triangle) {
  const TriangleMesh& mesh =
      scene.world->prototypes[scene.world->instances[instance].prototype].mesh;
  const Placement& placement = scene.placements[instance];
  const auto& corners = mesh.triangles[triangle];
  Triangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = placement.linear_world_prototype * mesh.vertices[corners[i]].cast<double>() +
                placement.position_world;
  }
  return result;
}

/// `plane` where the ray meets the plane there, about as Embree found it; else the ray grazes the
/// triangle, its plane says little, and Embree's word stands. In both float and double.
template <class Real>
Real settled_distance(Real plane, Real embree) {
  constexpr Real kAgreement = static_cast<Real>(1e-3);
  return std::abs(plane - embree) <= kAgreement * embree ? plane : embree;
}

}  // namespace avoidbench
