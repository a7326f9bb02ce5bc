#include <algorithm>
#include <cstring>
#include <exception>
#include <limits>

#include "base/check.hpp"
#include "base/poll.hpp"
#include "render/device.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TrianglePlane make_plane(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector3d origin = a.cast<double>();
  const Vector3d cross = (b.cast<double>() - origin).cross(c.cast<double>() - origin);
  const double length = cross.norm();
  // A triangle without an area has no plane: all its numbers are 0.
  const Vector3d normal = length > 0.0 ? Vector3d(cross / length) : Vector3d::Zero();
  return {normal.x(), normal.y(), normal.z(), normal.dot(origin)};
}

std::vector<TrianglePlane> make_planes(const std::vector<Vector3f>& vertices,
                                       const TriangleMesh& mesh) {
  std::vector<TrianglePlane> planes;
  planes.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    planes.push_back(make_plane(vertices[a], vertices[b], vertices[c]));
  }
  return planes;
}

/// Inverse by cofactors.
Eigen::Matrix3d inverse(const Eigen::Matrix3d& m) {
  const Vector3d a = m.col(0), b = m.col(1), c = m.col(2);
  Eigen::Matrix3d result;
  result.row(0) = b.cross(c);
  result.row(1) = c.cross(a);
  result.row(2) = a.cross(b);
  const double determinant = a.dot(b.cross(c));
  // An instance squeezed to a plane has no inverse. 1e-12 is the determinant of a scale of 0.0001.
  AB_CHECK(std::abs(determinant) > 1e-12, determinant);
  return result / determinant;
}

Placement make_placement(const Instance& instance) {
  Placement placement;
  const Eigen::Matrix4f& matrix = instance.T_world_prototype.matrix();
  AB_CHECK(matrix.allFinite());
  placement.linear_world_prototype = matrix.topLeftCorner<3, 3>().cast<double>();
  placement.position_world = matrix.topRightCorner<3, 1>().cast<double>();
  placement.linear_prototype_world = inverse(placement.linear_world_prototype);
  placement.scale = placement.linear_world_prototype.col(0).norm();
  return placement;
}

std::vector<Vector3f> flattened_vertices(const TriangleMesh& mesh, const Placement& placement) {
  std::vector<Vector3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vector3f& vertex : mesh.vertices) {
    const Vector3d in_world =
        placement.linear_world_prototype * vertex.cast<double>() + placement.position_world;
    vertices.push_back(in_world.cast<float>());
  }
  return vertices;
}

template <class T>
void set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                const std::vector<T>& values) {
  // Copied, not shared: Embree reads 16 bytes at a vertex, and pads its own buffers for that.
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
  embree::check_errors("copying a map's triangles");
  std::memcpy(buffer, static_cast<const void*>(values.data()), values.size() * sizeof(T));
}

embree::GeometryHandle make_geometry(const std::vector<Vector3f>& vertices,
                                     const TriangleMesh& mesh) {
  static_assert(sizeof(Vector3f) == 12);
  embree::GeometryHandle geometry(rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_TRIANGLE));
  embree::check_errors("making a mesh");
  set_buffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  set_buffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

embree::SceneHandle make_scene() {
  embree::SceneHandle scene(rtcNewScene(embree::device()));
  embree::check_errors("making a scene");
  return scene;
}

void commit(RTCScene scene) {
  rtcCommitScene(scene);
  embree::check_errors("building the map's bounding volume hierarchy");
}

/// As commit(), but whoever waits for it may end it: what poll_caller() throws is thrown.
void commit_polled(RTCScene scene) {
  if (!is_polled()) return commit(scene);
  std::exception_ptr thrown;
  const auto goes_on = [](void* where, double) {
    // No exception may pass through Embree.
    try {
      poll_caller();
    } catch (...) {
      *static_cast<std::exception_ptr*>(where) = std::current_exception();
      return false;
    }
    return true;
  };
  rtcSetSceneProgressMonitorFunction(scene, goes_on, &thrown);
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  if (thrown) {
    rtcGetDeviceError(embree::device());  // that it was ended
    std::rethrow_exception(thrown);
  }
  embree::check_errors("building the map's bounding volume hierarchy");
}

/// Every instance as triangles of the world, in one hierarchy.
void build_flattened(Scene::Internals& scene) {
  const World& world = *scene.world;
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    poll_caller();
    const TriangleMesh& mesh = world.prototypes[world.instances[i].prototype].mesh;
    const std::vector<Vector3f> vertices = flattened_vertices(mesh, scene.placements[i]);
    scene.planes.push_back(make_planes(vertices, mesh));
    scene.planes_of.push_back(scene.planes.back().data());
    // Its planes, none, are there all the same: they are found by the instance's number.
    if (mesh.triangles.empty()) continue;
    const embree::GeometryHandle geometry = make_geometry(vertices, mesh);
    // By the instance's own number, which Embree gives back with each hit.
    rtcAttachGeometryByID(scene.top.get(), geometry.get(), i);
  }
}

/// Each prototype once, with a hierarchy of its own, and instances that place it.
void build_instanced(Scene::Internals& scene) {
  const World& world = *scene.world;
  for (const Prototype& prototype : world.prototypes) {
    scene.planes.push_back(make_planes(prototype.mesh.vertices, prototype.mesh));
    scene.prototypes.push_back(make_scene());
    if (!prototype.mesh.triangles.empty()) {
      const embree::GeometryHandle geometry =
          make_geometry(prototype.mesh.vertices, prototype.mesh);
      rtcAttachGeometryByID(scene.prototypes.back().get(), geometry.get(), 0);
    }
    commit_polled(scene.prototypes.back().get());
  }
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    const std::uint32_t prototype = world.instances[i].prototype;
    scene.planes_of.push_back(scene.planes[prototype].data());
    if (world.prototypes[prototype].mesh.triangles.empty()) continue;
    const embree::GeometryHandle geometry(
        rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), scene.prototypes[prototype].get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            world.instances[i].T_world_prototype.matrix().data());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.top.get(), geometry.get(), i);
  }
}

/// The instance's box, widened by more than float rounding; inside out, as Embree wants it, where
/// it is empty.
RTCBounds instance_bounds(const TriangleMesh& mesh, const Placement& placement) {
  Aabb box;
  for (const Vector3f& vertex : mesh.vertices) {
    box.extend(placement.linear_world_prototype * vertex.cast<double>() + placement.position_world);
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  if (mesh.triangles.empty()) {
    return {kFar, kFar, kFar, 0.0F, -kFar, -kFar, -kFar, 0.0F};
  }
  const double slack = 1e-5 + 1e-6 * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  // The cast rounds to the nearest float, which may be inside the box: hence the slack.
  const Vector3f low = (box.min().array() - slack).matrix().cast<float>();
  const Vector3f high = (box.max().array() + slack).matrix().cast<float>();
  return {low.x(), low.y(), low.z(), 0.0F, high.x(), high.y(), high.z(), 0.0F};
}

/// Boxes of all instances for point queries, which look into an instance only where its box is near
/// enough.
void build_instance_boxes(Scene::Internals& scene) {
  const World& world = *scene.world;
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    poll_caller();
    const TriangleMesh& mesh = world.prototypes[world.instances[i].prototype].mesh;
    scene.bounds.push_back(instance_bounds(mesh, scene.placements[i]));
  }
  scene.instance_boxes = make_scene();
  const embree::GeometryHandle boxes(rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(boxes.get(), static_cast<unsigned>(scene.bounds.size()));
  rtcSetGeometryUserData(boxes.get(), scene.bounds.data());
  rtcSetGeometryBoundsFunction(
      boxes.get(),
      [](const RTCBoundsFunctionArguments* asked) {
        *asked->bounds_o = static_cast<const RTCBounds*>(asked->geometryUserPtr)[asked->primID];
      },
      nullptr);
  rtcCommitGeometry(boxes.get());
  rtcAttachGeometryByID(scene.instance_boxes.get(), boxes.get(), 0);
  commit(scene.instance_boxes.get());
}

double lowest_ceiling_m(const Scene::Internals& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  const World& world = *scene.world;
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    const Instance& instance = world.instances[i];
    if (instance.obstacle >= world.obstacles.size()) continue;
    const std::string& kind = world.obstacles[instance.obstacle].kind;
    // Of the whole map, not of the place: one height is enough for the sun's rays to end at.
    if (kind != "ceiling" && kind != "lamp") continue;
    const Placement& placement = scene.placements[i];
    for (const Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      lowest = std::min(lowest, (placement.linear_world_prototype * vertex.cast<double>() +
                                 placement.position_world)
                                    .z());
    }
  }
  return lowest;
}

/// Indices are used unchecked from here on.
void check_world(const World& world) {
  for (const Prototype& prototype : world.prototypes) {
    AB_CHECK(prototype.triangle_materials.size() == prototype.mesh.triangles.size(),
             prototype.name);
    for (const auto& triangle : prototype.mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        AB_CHECK(corner < prototype.mesh.vertices.size(), prototype.name);
      }
    }
  }
  for (const Instance& instance : world.instances) {
    AB_CHECK(instance.prototype < world.prototypes.size(), instance.prototype);
  }
  for (const Motion& motion : world.motions) {
    AB_CHECK(motion.instance < world.instances.size() && motion.period_s > 0.0, motion.instance);
  }
}

}  // namespace

std::unique_ptr<Scene::Internals> build_internals(const World& world,
                                                  std::size_t flatten_triangles) {
  check_world(world);
  auto scene = std::make_unique<Scene::Internals>();
  scene->world = &world;
  // What moves stays an instance, of which only the place changes.
  scene->flattened = world.motions.empty() && triangle_count(world) <= flatten_triangles;
  scene->top = make_scene();
  if (!world.motions.empty()) {
    rtcSetSceneFlags(scene->top.get(), RTC_SCENE_FLAG_DYNAMIC);
    // Built again at each physics step: a quick build over few instances beats a good one.
    rtcSetSceneBuildQuality(scene->top.get(), RTC_BUILD_QUALITY_LOW);
  }
  for (const Instance& instance : world.instances) {
    poll_caller();
    scene->placements.push_back(make_placement(instance));
  }
  scene->lowest_ceiling_m = lowest_ceiling_m(*scene);
  if (scene->flattened) {
    build_flattened(*scene);
  } else {
    build_instanced(*scene);
    build_instance_boxes(*scene);
  }
  commit_polled(scene->top.get());
  return scene;
}

void move_instances(Scene::Internals& scene, double time_s) {
  const World& world = *scene.world;
  for (const Motion& motion : world.motions) {
    Instance moved = world.instances[motion.instance];
    moved.T_world_prototype.translation() += displacement_world(motion, time_s).cast<float>();
    Placement& placement = scene.placements[motion.instance];
    placement = make_placement(moved);  // planes are in the prototype's frame, which does not move
    const TriangleMesh& mesh = world.prototypes[moved.prototype].mesh;
    if (mesh.triangles.empty()) continue;
    const RTCGeometry geometry = rtcGetGeometry(scene.top.get(), motion.instance);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            moved.T_world_prototype.matrix().data());
    rtcCommitGeometry(geometry);
    scene.bounds[motion.instance] = instance_bounds(mesh, placement);
  }
  // Boxes and instances have moved: both hierarchies are built again.
  rtcCommitGeometry(rtcGetGeometry(scene.instance_boxes.get(), 0));
  commit(scene.instance_boxes.get());
  commit(scene.top.get());
}

}  // namespace avoidbench
