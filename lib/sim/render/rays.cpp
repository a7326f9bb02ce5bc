#include "render/rays.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/check.hpp"
#include "render/flush_to_zero.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPacket = 8, kStream = kPacket * embree::kStreamPackets;

using Packets = RTCRayHit8[embree::kStreamPackets];

/// What is the same for all rays; Embree leaves it as it is.
void begin(Packets& packets) {
  std::memset(static_cast<void*>(packets), 0, sizeof(packets));
  for (RTCRayHit8& packet : packets) std::fill_n(packet.ray.mask, kPacket, ~0U);
}

/// Four rays side by side: their numbers two by two, rounded to float and transposed. Conversions
/// one by one take twice as long.
void set_four(RTCRay8& to, const Ray* rays, std::size_t lane) {
  static_assert(std::is_standard_layout_v<Ray> && sizeof(Ray) == 6 * sizeof(double));
  float* const to_numbers[6] = {to.org_x, to.org_y, to.org_z, to.dir_x, to.dir_y, to.dir_z};
  const auto pair = [&](std::size_t ray, std::size_t number) {
    const auto* numbers = reinterpret_cast<const double*>(rays + lane + ray);
    return _mm_cvtpd_ps(_mm_loadu_pd(numbers + number));
  };
  for (std::size_t number = 0; number < 6; number += 2) {
    const __m128 low = _mm_unpacklo_ps(pair(0, number), pair(1, number));
    const __m128 high = _mm_unpacklo_ps(pair(2, number), pair(3, number));
    _mm_storeu_ps(to_numbers[number] + lane, _mm_movelh_ps(low, high));
    _mm_storeu_ps(to_numbers[number + 1] + lane, _mm_movehl_ps(high, low));
  }
}

void set_rays(RTCRayHit8& packet, const Ray* rays, std::size_t count, float limit_m) {
  RTCRay8& to = packet.ray;
  std::size_t lane = 0;
  for (; lane + 4 <= count; lane += 4) set_four(to, rays, lane);
  for (; lane < count; ++lane) {
    const Ray& ray = rays[lane];
    to.org_x[lane] = static_cast<float>(ray.origin_world[0]);
    to.org_y[lane] = static_cast<float>(ray.origin_world[1]);
    to.org_z[lane] = static_cast<float>(ray.origin_world[2]);
    to.dir_x[lane] = static_cast<float>(ray.direction_world[0]);
    to.dir_y[lane] = static_cast<float>(ray.direction_world[1]);
    to.dir_z[lane] = static_cast<float>(ray.direction_world[2]);
  }
  // Lanes beyond the last ray are inactive: their end lies before their beginning.
  std::fill_n(to.tfar, count, limit_m);
  std::fill(to.tfar + count, to.tfar + kPacket, -1.0F);
  std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
}

/// The distance is that of the ray in double, which was traced rounded to float.
void read_hit(const Scene::Internals& scene, const RTCRayHit8& packet, std::size_t lane,
              const Ray& ray, double limit_m, RayHit& hit) {
  if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
    hit = {};
    return;
  }
  // What is flattened has none; written with each hit.
  const unsigned instance = packet.hit.instID[0][lane];
  hit.instance = instance == RTC_INVALID_GEOMETRY_ID ? packet.hit.geomID[lane] : instance;
  hit.triangle = packet.hit.primID[lane];
  const TrianglePlane& plane = scene.planes_of[hit.instance][hit.triangle];
  hit.normal_world = {plane.nx, plane.ny, plane.nz};
  double along_normal = hit.normal_world.dot(ray.direction_world);
  double to_origin = hit.normal_world.dot(ray.origin_world);
  if (hit.instance >= scene.flattened_count) {
    // In the frame of the plane, where a direction keeps the ray's parameter. The linear part is a
    // rotation times a uniform scale.
    const Placement& placement = scene.placements[hit.instance];
    const Vector3d& normal = hit.normal_world;
    along_normal = normal.dot(placement.linear_prototype_world * ray.direction_world);
    to_origin = normal.dot(placement.linear_prototype_world *
                           (ray.origin_world - placement.position_world));
    hit.normal_world = placement.linear_world_prototype * normal / placement.scale;
  }
  const double to_plane_m = (plane.offset - to_origin) / along_normal;
  const auto traced_m = static_cast<double>(packet.ray.tfar[lane]);
  const double distance_m = settled_distance(to_plane_m, traced_m);
  hit.distance_m = std::min(distance_m, limit_m);
}

}  // namespace

void first_hits(const Scene& scene, std::span<const Ray> rays, double limit_m,
                std::span<RayHit> hits) {
  AB_CHECK(hits.size() == rays.size(), hits.size(), rays.size());
  const Scene::Internals& internals = scene.internals();
  const ScopedFlushToZero flush;
  Packets packets;
  begin(packets);
  const auto far_m = static_cast<float>(limit_m);
  for (std::size_t first = 0; first < rays.size(); first += kStream) {
    const std::size_t count = std::min(kStream, rays.size() - first);
    for (std::size_t i = 0; i < embree::kStreamPackets; ++i) {
      const std::size_t done = std::min(i * kPacket, count);
      set_rays(packets[i], rays.data() + first + done, std::min(kPacket, count - done), far_m);
    }
    const Placement* placements = internals.placements.data();
    trace(internals.map->top.get(), placements, packets);
    // Rays end where they have met the map: what is met now is nearer.
    if (internals.has_movers()) trace(internals.movers.top.get(), placements, packets);
    for (std::size_t i = 0; i < count; ++i) {
      read_hit(internals, packets[i / kPacket], i % kPacket, rays[first + i], limit_m,
               hits[first + i]);
    }
  }
}

}  // namespace avoidbench
