#include <algorithm>
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

Placement make_placement(const Eigen::Affine3f& T_world_prototype) {
  Placement placement;
  const Eigen::Matrix4f& matrix = T_world_prototype.matrix();
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

/// The hierarchy's next list of planes, and its mesh if it has triangles.
TracedMesh& add_mesh(const std::vector<Vector3f>& vertices, const TriangleMesh& mesh,
                     Hierarchy& hierarchy) {
  hierarchy.planes.push_back(make_planes(vertices, mesh));
  TracedMesh& traced = hierarchy.meshes.emplace_back();
  traced.planes = hierarchy.planes.back().data();
  traced.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    traced.triangles.push_back(traced_triangle(vertices[a], vertices[b], vertices[c]));
  }
  return traced;
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
void build_flattened(const World& world, const std::vector<Placement>& placements,
                     Hierarchy& hierarchy) {
  float reach_m = 0.0F;
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    poll_caller();
    const TriangleMesh& mesh = world.prototypes[world.instances[i].prototype].mesh;
    const std::vector<Vector3f> vertices = flattened_vertices(mesh, placements[i]);
    // Where there are none, their empty lists are: they are found by the instance's number.
    const TracedMesh& traced = add_mesh(vertices, mesh, hierarchy);
    if (mesh.triangles.empty()) continue;
    for (const Vector3f& vertex : vertices) {
      reach_m = std::max(reach_m, vertex.cwiseAbs().maxCoeff());
    }
    const embree::GeometryHandle geometry = make_traced_geometry(traced);
    // By the instance's own number, which Embree gives back with each hit.
    rtcAttachGeometryByID(hierarchy.top.get(), geometry.get(), i);
  }
  for (TracedMesh& mesh : hierarchy.meshes) {
    mesh.box_slack = box_slack(static_cast<double>(reach_m), 1.0);
  }
}

/// How much larger the boxes of each prototype's triangles are: enough for its smallest instance,
/// wherever instances are or move to within a kilometre.
std::vector<float> prototype_slacks(const World& world, const std::vector<Placement>& placements) {
  double reach_m = 1000.0;
  std::vector<double> least_scales(world.prototypes.size(), 1.0);
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    double& scale = least_scales[world.instances[i].prototype];
    scale = std::min(scale, placements[i].scale);
    reach_m = std::max(reach_m, 2.0 * placements[i].position_world.cwiseAbs().maxCoeff());
  }
  std::vector<float> slacks;
  for (const double scale : least_scales) slacks.push_back(box_slack(reach_m, scale));
  return slacks;
}

/// Prototypes from `first` on, each once, with a hierarchy of its own.
void build_prototypes(const World& world, const std::vector<Placement>& placements,
                      std::size_t first, Hierarchy& hierarchy) {
  const std::vector<float> slacks = prototype_slacks(world, placements);
  for (std::size_t i = first; i < world.prototypes.size(); ++i) {
    const TriangleMesh& mesh = world.prototypes[i].mesh;
    TracedMesh& traced = add_mesh(mesh.vertices, mesh, hierarchy);
    traced.box_slack = slacks[i];
    hierarchy.prototypes.push_back(make_scene());
    if (!mesh.triangles.empty()) {
      const embree::GeometryHandle geometry = make_traced_geometry(traced);
      rtcAttachGeometryByID(hierarchy.prototypes.back().get(), geometry.get(), 0);
    }
    commit_polled(hierarchy.prototypes.back().get());
  }
}

/// Instances from `first` to `end` that place the hierarchy's prototypes, the first of which is the
/// world's `first_prototype`.
void attach_instances(const World& world, std::uint32_t first, std::size_t end,
                      std::size_t first_prototype, Hierarchy& hierarchy) {
  for (std::uint32_t i = first; i < end; ++i) {
    const std::uint32_t prototype = world.instances[i].prototype;
    if (world.prototypes[prototype].mesh.triangles.empty()) continue;
    const embree::GeometryHandle geometry(
        rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(),
                                 hierarchy.prototypes[prototype - first_prototype].get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            world.instances[i].T_world_prototype.matrix().data());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(hierarchy.top.get(), geometry.get(), i);
  }
}

/// For a hierarchy in which things move: built again at many moments, where a quick build over few
/// instances beats a good one.
embree::SceneHandle make_moving_scene() {
  embree::SceneHandle scene = make_scene();
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  return scene;
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
void build_instance_boxes(const World& world, const std::vector<Placement>& placements,
                          MapHierarchy& map) {
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    poll_caller();
    const TriangleMesh& mesh = world.prototypes[world.instances[i].prototype].mesh;
    map.bounds.push_back(instance_bounds(mesh, placements[i]));
  }
  map.instance_boxes = make_scene();
  const embree::GeometryHandle boxes(rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(boxes.get(), static_cast<unsigned>(map.bounds.size()));
  rtcSetGeometryUserData(boxes.get(), map.bounds.data());
  rtcSetGeometryBoundsFunction(
      boxes.get(),
      [](const RTCBoundsFunctionArguments* asked) {
        *asked->bounds_o = static_cast<const RTCBounds*>(asked->geometryUserPtr)[asked->primID];
      },
      nullptr);
  rtcCommitGeometry(boxes.get());
  rtcAttachGeometryByID(map.instance_boxes.get(), boxes.get(), 0);
  commit(map.instance_boxes.get());
}

MoverBall ball_of(const TriangleMesh& mesh, double scale) {
  Aabb box;
  for (const Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  MoverBall ball{.center_prototype = box.center(), .radius_m = 0.0};
  for (const Vector3f& vertex : mesh.vertices) {
    ball.radius_m =
        std::max(ball.radius_m, scale * (vertex.cast<double>() - ball.center_prototype).norm());
  }
  return ball;
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

void check_path(const Sway& sway) { AB_CHECK(sway.period_s > 0.0, sway.period_s); }
void check_path(const Trefoil& knot) { AB_CHECK(knot.period_s > 0.0, knot.period_s); }
void check_path(const Route& route) {
  AB_CHECK(!route.knots.empty());
  for (std::size_t i = 1; i < route.knots.size(); ++i) {
    AB_CHECK(route.knots[i - 1].time_s < route.knots[i].time_s, i);
  }
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
    AB_CHECK(motion.instance < world.instances.size(), motion.instance);
    std::visit([](const auto& path) { check_path(path); }, motion.path);
  }
}

std::vector<Placement> placements_of(const World& world) {
  std::vector<Placement> placements;
  for (const Instance& instance : world.instances) {
    poll_caller();
    placements.push_back(make_placement(instance.T_world_prototype));
  }
  return placements;
}

/// From a map's hierarchy: where each instance's planes and triangles are.
void find_map_instances(Scene::Internals& scene, std::size_t count) {
  const MapHierarchy& map = *scene.map;
  scene.first_mover = static_cast<std::uint32_t>(count);
  scene.flattened_count = map.flattened ? scene.first_mover : 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t prototype = scene.world->instances[i].prototype;
    scene.planes_of.push_back(map.planes[map.flattened ? i : prototype].data());
    scene.prototype_scenes.push_back(map.flattened ? nullptr : map.prototypes[prototype].get());
  }
}

RTCGeometry geometry_of(const Scene::Internals& scene, std::uint32_t instance) {
  const Hierarchy& hierarchy =
      instance < scene.first_mover ? static_cast<const Hierarchy&>(*scene.map) : scene.movers;
  return rtcGetGeometry(hierarchy.top.get(), instance);
}

/// Whether the map's own instances move, not only movers.
bool has_moving_map(const Scene::Internals& scene) {
  return !scene.world->motions.empty() && scene.world->motions.front().instance < scene.first_mover;
}

}  // namespace

std::unique_ptr<Scene::Internals> build_internals(const World& world,
                                                  std::size_t flatten_triangles) {
  check_world(world);
  auto scene = std::make_unique<Scene::Internals>();
  scene->world = &world;
  scene->placements = placements_of(world);
  scene->lowest_ceiling_m = lowest_ceiling_m(*scene);
  scene->map = std::make_shared<MapHierarchy>();
  MapHierarchy& map = *scene->map;
  // What moves stays an instance, of which only the place changes.
  map.flattened = world.motions.empty() && triangle_count(world) <= flatten_triangles;
  map.top = world.motions.empty() ? make_scene() : make_moving_scene();
  if (map.flattened) {
    build_flattened(world, scene->placements, map);
  } else {
    build_prototypes(world, scene->placements, 0, map);
    attach_instances(world, 0, world.instances.size(), 0, map);
    build_instance_boxes(world, scene->placements, map);
  }
  commit_polled(map.top.get());
  find_map_instances(*scene, world.instances.size());
  place_for_rays(*scene);
  return scene;
}

std::unique_ptr<Scene::Internals> build_internals(const World& world, const Scene::Internals& map) {
  const World& map_world = *map.world;
  AB_CHECK(!map.has_movers() && map_world.instances.size() <= world.instances.size());
  // A map in which things move is built again for each flight.
  if (!map_world.motions.empty()) return build_internals(world, kFlattenTriangles);
  check_world(world);
  auto scene = std::make_unique<Scene::Internals>();
  scene->world = &world;
  scene->placements = placements_of(world);
  scene->lowest_ceiling_m = map.lowest_ceiling_m;
  scene->map = map.map;
  find_map_instances(*scene, map_world.instances.size());
  const std::size_t first_prototype = map_world.prototypes.size();
  Hierarchy& movers = scene->movers;
  movers.top = make_moving_scene();
  build_prototypes(world, scene->placements, first_prototype, movers);
  attach_instances(world, scene->first_mover, world.instances.size(), first_prototype, movers);
  for (std::size_t i = scene->first_mover; i < world.instances.size(); ++i) {
    const std::uint32_t prototype = world.instances[i].prototype;
    AB_CHECK(prototype >= first_prototype, prototype);
    scene->planes_of.push_back(movers.planes[prototype - first_prototype].data());
    scene->prototype_scenes.push_back(movers.prototypes[prototype - first_prototype].get());
    scene->balls.push_back(ball_of(world.prototypes[prototype].mesh, scene->placements[i].scale));
  }
  place_for_rays(*scene);
  return scene;
}

void place(Scene::Internals& scene) {
  if (scene.placed_s == scene.time_s) return;
  const World& world = *scene.world;
  MapHierarchy& map = *scene.map;
  for (const Motion& motion : world.motions) {
    const Instance& instance = world.instances[motion.instance];
    Placement& placement = scene.placements[motion.instance];
    // Planes are in the prototype's frame, which does not move.
    placement = make_placement(moved(instance.T_world_prototype, motion, scene.time_s));
    if (motion.instance >= scene.first_mover) continue;
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    map.bounds[motion.instance] = instance_bounds(mesh, placement);
  }
  for (std::size_t i = 0; i < scene.balls.size(); ++i) {
    MoverBall& ball = scene.balls[i];
    const Placement& placement = scene.placements[scene.first_mover + i];
    ball.center_world =
        placement.linear_world_prototype * ball.center_prototype + placement.position_world;
  }
  if (has_moving_map(scene)) {
    rtcCommitGeometry(rtcGetGeometry(map.instance_boxes.get(), 0));
    commit(map.instance_boxes.get());
  }
  scene.placed_s = scene.time_s;
}

void place_for_rays(Scene::Internals& scene) {
  place(scene);
  if (scene.traced_s == scene.time_s) return;
  const World& world = *scene.world;
  for (const Motion& motion : world.motions) {
    const std::uint32_t prototype = world.instances[motion.instance].prototype;
    if (world.prototypes[prototype].mesh.triangles.empty()) continue;
    const Placement& placement = scene.placements[motion.instance];
    Eigen::Affine3f T_world_prototype = Eigen::Affine3f::Identity();
    // Floats made these doubles: nothing is lost.
    T_world_prototype.linear() = placement.linear_world_prototype.cast<float>();
    T_world_prototype.translation() = placement.position_world.cast<float>();
    const RTCGeometry geometry = geometry_of(scene, motion.instance);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            T_world_prototype.matrix().data());
    rtcCommitGeometry(geometry);
  }
  if (has_moving_map(scene)) commit(scene.map->top.get());
  if (scene.has_movers()) commit(scene.movers.top.get());
  scene.traced_s = scene.time_s;
}

}  // namespace avoidbench
