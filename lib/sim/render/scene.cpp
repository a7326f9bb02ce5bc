#include "render/scene.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "render/flush_to_zero.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

RTCRay make_ray(const Vector3d& origin, const Vector3d& direction, double limit) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = 0.0F;
  ray.tfar = static_cast<float>(limit);
  ray.mask = ~0U;
  return ray;
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
  RTCRayHit ray{};
  ray.ray = make_ray(origin_world, direction, limit_m);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  const Internals& scene = internals();
  {
    const ScopedFlushToZero flush;
    embree::intersect(scene.map->top.get(), ray);
    // Embree shortened the ray to what it has hit: of the movers, nearer ones take its place.
    if (scene.has_movers()) embree::intersect(scene.movers.top.get(), ray);
  }
  RayHit hit;
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.instance = instance_of(ray.hit);
  hit.triangle = ray.hit.primID;
  // Embree only names the triangle. The distance is that to its plane in double, which no
  // instruction set changes.
  const Triangle triangle = world_triangle(scene, hit.instance, hit.triangle);
  const double embree_distance = static_cast<double>(ray.ray.tfar);
  hit.distance_m =
      std::min(settled_distance(plane_distance(triangle, origin_world, direction), embree_distance),
               limit_m);
  hit.normal_world = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  return hit;
}

bool Scene::occluded(const Vector3d& from_world, const Vector3d& to_world) const {
  // The direction is the whole way: 1 is its end.
  RTCRay ray = make_ray(from_world, to_world - from_world, 1.0);
  const Internals& scene = internals();
  const ScopedFlushToZero flush;
  embree::occlude(scene.map->top.get(), ray);
  // Embree says -inf where something is met.
  const auto is_met = [&ray] { return ray.tfar < 0.0F; };
  if (!is_met() && scene.has_movers()) embree::occlude(scene.movers.top.get(), ray);
  return is_met();
}

}  // namespace avoidbench
