#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "geometry/box_triangle.hpp"
#include "render/embree.hpp"
#include "render/scene.hpp"
#include "render/tracing.hpp"
#include "render/triangle_plane.hpp"

namespace avoidbench {

/// Maps of at most this many triangles, counted over all instances, are flattened into one
/// hierarchy: a forest's depth image then takes half the time of the instanced one, for 0.8 µs of
/// building and 180 bytes per triangle. Larger maps keep one hierarchy per prototype.
inline constexpr std::size_t kFlattenTriangles = 1'000'000;

/// How one instance stands in the world, in double.
struct Placement {
  Eigen::Matrix3d linear_world_prototype = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d linear_prototype_world = Eigen::Matrix3d::Identity();
  double scale = 1.0;
};

/// Instances of a world in Embree's scenes.
struct Hierarchy {
  bool flattened = false;  ///< whether its triangles are in the world's frame, all in `top`
  embree::SceneHandle top;
  std::vector<embree::SceneHandle> prototypes;  ///< empty where flattened
  std::deque<TracedMesh> meshes;                ///< as planes; a deque, since they must not move
  std::vector<std::vector<TrianglePlane>>
      planes;  ///< one list an instance where flattened, else a prototype
};

/// The hierarchy of a map. Shared by the scenes of its trials as long as nothing of it moves.
struct MapHierarchy : Hierarchy {
  embree::SceneHandle
      instance_boxes;  ///< an instance a primitive, for point queries; none where flattened
  std::vector<RTCBounds> bounds;  ///< its boxes
};

/// A ball that holds a mover: who looks for something elsewhere passes it by.
struct MoverBall {
  Eigen::Vector3d center_prototype = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  Eigen::Vector3d center_world = Eigen::Vector3d::Zero();  ///< at placed_s
};

/// In Embree's scenes an instance's index is the hit's geomID where flattened, else its instID.
/// Movers are the instances from first_mover on: they stand in a small hierarchy of their own, so
/// that a map is built once, and not again at each step. A map whose own instances move is not
/// flattened and nobody else's.
/// Invariants: placements, planes_of and prototype_scenes have one entry an instance; placements
/// and, where the map itself moves, its boxes stand at placed_s, the top hierarchies at traced_s:
/// place() and place_for_rays() bring them to time_s.
struct Scene::Internals {
  const World* world = nullptr;
  std::shared_ptr<MapHierarchy> map;
  std::uint32_t first_mover = 0;
  Hierarchy movers;                   ///< its `top` is null where there are none
  std::vector<MoverBall> balls;       ///< one a mover
  std::uint32_t flattened_count = 0;  ///< instances below it have their planes in the world's frame
  /// One an instance: its triangles' planes, in the world's frame or in the prototype's.
  std::vector<const TrianglePlane*> planes_of;
  std::vector<RTCScene> prototype_scenes;  ///< one an instance; null where flattened
  std::vector<Placement> placements;       ///< one an instance
  /// The lowest point of all ceilings and lamps, where they stand at first; +inf: there are none.
  /// In shaded images the sun shines through them, else halls would be dark.
  double lowest_ceiling_m = std::numeric_limits<double>::infinity();
  double time_s = 0.0;
  double placed_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: never
  double traced_s = std::numeric_limits<double>::quiet_NaN();

  bool has_movers() const { return movers.top != nullptr; }
};

/// Builds the hierarchy. `flatten_triangles` is a parameter so that tests can compare both kinds on
/// one world.
std::unique_ptr<Scene::Internals> build_internals(const World& world,
                                                  std::size_t flatten_triangles);

/// The same for a world whose first instances are those of `map`: what comes after them moves.
std::unique_ptr<Scene::Internals> build_internals(const World& world, const Scene::Internals& map);

/// Puts what moves where it stands at time_s, for point queries, and for rays, too.
void place(Scene::Internals& scene);
void place_for_rays(Scene::Internals& scene);

/// Which instance was hit: an instance's own number, or that of flattened triangles.
inline std::uint32_t instance_of(unsigned instance, unsigned geometry) {
  return instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
}

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

/// `plane`, the distance to the plane of the ray in double, where it is about that of the traced
/// ray, which is rounded to float; else the ray grazes the triangle, and `traced` stands.
inline double settled_distance(double plane, double traced) {
  return std::abs(plane - traced) <= 1e-3 * traced ? plane : traced;
}

}  // namespace avoidbench
