#include "render/scene.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "render/flush_to_zero.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// The first lane of a packet; all others are inactive.
void set_only_ray(RTCRay8& packet, const Vector3d& origin, const Vector3d& direction,
                  double limit) {
  std::fill_n(packet.tfar, 8, -1.0F);
  packet.org_x[0] = static_cast<float>(origin.x());
  packet.org_y[0] = static_cast<float>(origin.y());
  packet.org_z[0] = static_cast<float>(origin.z());
  packet.dir_x[0] = static_cast<float>(direction.x());
  packet.dir_y[0] = static_cast<float>(direction.y());
  packet.dir_z[0] = static_cast<float>(direction.z());
  packet.tfar[0] = static_cast<float>(limit);
  packet.mask[0] = ~0U;
}

/// Where the ray meets the triangle's plane, from the world-space triangle that all exact queries
/// use.
double plane_distance(const Triangle& triangle, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return normal.dot(triangle[0] - origin) / normal.dot(direction);
}

}  // namespace

Scene::Scene(const World& world) : Scene(world, kFlattenTriangles) {}
Scene::Scene(const World& world, std::size_t flatten_triangles)
    : internals_(build_internals(world, flatten_triangles)) {}
Scene::Scene(const World& world, const Scene& map)
    : internals_(build_internals(world, *map.internals_)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const World& Scene::world() const { return *internals_->world; }

void Scene::set_time(double time_s) { internals_->time_s = time_s; }

const Scene::Internals& Scene::internals() const {
  place_for_rays(*internals_);
  return *internals_;
}

RayHit Scene::first_hit(const Vector3d& origin_world, const Vector3d& direction_world,
                        double limit_m) const {
  const double length = direction_world.norm();
  AB_CHECK(length > 0.0 && origin_world.allFinite(), direction_world.transpose());
  const Vector3d direction = direction_world / length;
  RTCRayHit8 packet{};
  set_only_ray(packet.ray, origin_world, direction, limit_m);
  packet.hit.geomID[0] = RTC_INVALID_GEOMETRY_ID;
  const Internals& scene = internals();
  {
    const ScopedFlushToZero flush;
    trace(scene.map->top.get(), scene.placements.data(), packet);
    // The ray ends at what it has met: of the movers, nearer ones take its place.
    if (scene.has_movers()) trace(scene.movers.top.get(), scene.placements.data(), packet);
  }
  RayHit hit;
  if (packet.hit.geomID[0] == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.instance = instance_of(packet.hit.instID[0][0], packet.hit.geomID[0]);
  hit.triangle = packet.hit.primID[0];
  // Of the ray in double, which was traced rounded to float.
  const Triangle triangle = world_triangle(scene, hit.instance, hit.triangle);
  const auto traced = static_cast<double>(packet.ray.tfar[0]);
  hit.distance_m = std::min(
      settled_distance(plane_distance(triangle, origin_world, direction), traced), limit_m);
  hit.normal_world = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  return hit;
}

bool Scene::occluded(const Vector3d& from_world, const Vector3d& to_world) const {
  RTCRay8 packet{};
  // The direction is the whole way: 1 is its end.
  set_only_ray(packet, from_world, to_world - from_world, 1.0);
  const Internals& scene = internals();
  const ScopedFlushToZero flush;
  occlude(scene.map->top.get(), scene.placements.data(), packet);
  if (scene.has_movers()) occlude(scene.movers.top.get(), scene.placements.data(), packet);
  // It ends at -inf where something is met.
  return packet.tfar[0] < 0.0F;
}

}  // namespace avoidbench
