#include "render/rays.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "render/flush_to_zero.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPacket = 8, kStream = kPacket * embree::kStreamPackets;

void set_ray(RTCRayHit8& packet, std::size_t lane, const Ray& from, float limit_m) {
  RTCRay8& ray = packet.ray;
  ray.org_x[lane] = static_cast<float>(from.origin_world.x());
  ray.org_y[lane] = static_cast<float>(from.origin_world.y());
  ray.org_z[lane] = static_cast<float>(from.origin_world.z());
  ray.dir_x[lane] = static_cast<float>(from.direction_world.x());
  ray.dir_y[lane] = static_cast<float>(from.direction_world.y());
  ray.dir_z[lane] = static_cast<float>(from.direction_world.z());
  ray.tnear[lane] = 0.0F;
  ray.tfar[lane] = limit_m;
  ray.time[lane] = 0.0F;
  ray.mask[lane] = ~0U;
  ray.id[lane] = 0;
  ray.flags[lane] = 0;
  packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

/// Embree names the triangle; the distance is that to its plane in double, which no instruction
/// set changes. In the frame of the plane, where a direction keeps the ray's parameter.
RayHit hit_of(const Scene::Internals& scene, const RTCRayHit8& packet, std::size_t lane,
              const Ray& ray, double limit_m) {
  RayHit hit;
  if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return hit;
  // What is flattened has no instance.
  const unsigned instance = packet.hit.instID[0][lane];
  hit.instance = instance == RTC_INVALID_GEOMETRY_ID ? packet.hit.geomID[lane] : instance;
  hit.triangle = packet.hit.primID[lane];
  const TrianglePlane& plane = scene.planes_of[hit.instance][hit.triangle];
  const Vector3d normal(plane.nx, plane.ny, plane.nz);
  Vector3d origin = ray.origin_world, direction = ray.direction_world;
  hit.normal_world = normal;
  if (hit.instance >= scene.flattened_count) {
    const Placement& placement = scene.placements[hit.instance];
    origin = placement.linear_prototype_world * (origin - placement.position_world);
    direction = placement.linear_prototype_world * direction;
    // The linear part is a rotation times a uniform scale.
    hit.normal_world = placement.linear_world_prototype * normal / placement.scale;
  }
  const double to_plane = (plane.offset - normal.dot(origin)) / normal.dot(direction);
  const auto by_embree = static_cast<double>(packet.ray.tfar[lane]);
  hit.distance_m = std::min(settled_distance(to_plane, by_embree), limit_m);
  return hit;
}

}  // namespace

void first_hits(const Scene& scene, std::span<const Ray> rays, double limit_m,
                std::span<RayHit> hits) {
  AB_CHECK(hits.size() == rays.size(), hits.size(), rays.size());
  const Scene::Internals& internals = scene.internals();
  const ScopedFlushToZero flush;
  RTCRayHit8 packets[embree::kStreamPackets];
  const auto far_m = static_cast<float>(limit_m);
  for (std::size_t first = 0; first < rays.size(); first += kStream) {
    const std::size_t count = std::min(kStream, rays.size() - first);
    for (std::size_t i = 0; i < kStream; ++i) {
      // Lanes beyond the last ray are inactive: their end lies before their beginning.
      const bool is_ray = i < count;
      set_ray(packets[i / kPacket], i % kPacket, rays[first + (is_ray ? i : 0)],
              is_ray ? far_m : -1.0F);
    }
    embree::intersect_stream(internals.map->top.get(), packets);
    // Rays end where they have met the map: what is met now is nearer.
    if (internals.has_movers()) embree::intersect_stream(internals.movers.top.get(), packets);
    for (std::size_t i = 0; i < count; ++i) {
      hits[first + i] =
          hit_of(internals, packets[i / kPacket], i % kPacket, rays[first + i], limit_m);
    }
  }
}

}  // namespace avoidbench
