#include "render/tracing.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "render/device.hpp"
#include "render/ray_tracing_isa.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr unsigned kLanesOfPacket = 8;
constexpr unsigned kRays = kLanesOfPacket * embree::kStreamPackets;

const RayTestKernel& ray_test() {
  static const RayTestKernel& kernel = has_avx2() ? kAvx2RayTest : kPortableRayTest;
  return kernel;
}

/// What Embree hands to the callbacks beside a ray, whose `id` is its index here.
struct Trace {
  explicit Trace(const Placement* of_instances) : placements(of_instances) {
    embree::begin(embree);
  }

  embree::QueryContext embree;  ///< must be first: Embree's pointer to it is ours
  const Placement* placements;
  double distances[kRays];  ///< of what was met so far; before that, the ray's end
  /// Rays in the world: within an instance Embree's are turned by its own rounding.
  float origins[3][kRays], directions[3][kRays];
  float farthest_origin = 0.0F;  ///< the greatest |x| + |y| + |z|
};

static_assert(std::is_standard_layout_v<Trace>);

struct ExactRay {
  Vector3d origin, direction;
};

/// The ray with this id, in the frame of the triangles of `instance`; flattened ones' is the world.
ExactRay exact_ray(const Trace& trace, unsigned id, unsigned instance) {
  const auto of = [id](const float(&from)[3][kRays]) {
    return Vector3d(static_cast<double>(from[0][id]), static_cast<double>(from[1][id]),
                    static_cast<double>(from[2][id]));
  };
  const ExactRay ray{of(trace.origins), of(trace.directions)};
  if (instance == RTC_INVALID_GEOMETRY_ID) return ray;
  const Placement& placement = trace.placements[instance];
  return {placement.linear_prototype_world * (ray.origin - placement.position_world),
          placement.linear_prototype_world * ray.direction};
}

/// Six times the volume that the edge from p to q, both seen from the ray's origin, spans with its
/// direction. The edge's other triangle, which runs along it from q to p, gets exactly the
/// negative: no ray passes between two triangles.
double edge_side(const Vector3d& p, const Vector3d& q, const Vector3d& direction) {
  return (p.y() * q.z() - p.z() * q.y()) * direction.x() +
         (p.z() * q.x() - p.x() * q.z()) * direction.y() +
         (p.x() * q.y() - p.y() * q.x()) * direction.z();
}

bool is_inside(const TracedTriangle& triangle, const ExactRay& ray) {
  const auto seen = [&ray](const float(&corner)[3]) {
    return Vector3d(static_cast<double>(corner[0]) - ray.origin.x(),
                    static_cast<double>(corner[1]) - ray.origin.y(),
                    static_cast<double>(corner[2]) - ray.origin.z());
  };
  const Vector3d a = seen(triangle.a), b = seen(triangle.b), c = seen(triangle.c);
  const double ab = edge_side(a, b, ray.direction), bc = edge_side(b, c, ray.direction),
               ca = edge_side(c, a, ray.direction);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// As RayTestKernel::distances, of one ray.
double distance_to(const TrianglePlane& plane, const ExactRay& ray) {
  const auto along = [&plane](const Vector3d& v) {
    return plane.nx * v.x() + plane.ny * v.y() + plane.nz * v.z();
  };
  const double slope = along(ray.direction);
  const double length =
      std::abs(ray.direction.x()) + std::abs(ray.direction.y()) + std::abs(ray.direction.z());
  if (!(std::abs(slope) > kEdgeOn * length)) return std::numeric_limits<double>::quiet_NaN();
  return (plane.offset - along(ray.origin)) / slope;
}

/// A positive float that is no less: nothing at the same distance may be passed over.
float rounded_up(double distance) {
  const auto nearest = static_cast<float>(distance);
  if (static_cast<double>(nearest) >= distance) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

/// Rays as Embree hands them on: of a packet of eight, or one by one where it splits packets.
struct EmbreeRays {
  unsigned count;
  float* number(std::size_t index) const { return numbers + index * count; }
  unsigned* integer(std::size_t index) const { return reinterpret_cast<unsigned*>(number(index)); }
  float* numbers;
};

// Where RTCRayN and RTCHitN keep what, in arrays of as many numbers as there are rays.
constexpr std::size_t kOrigin = offsetof(RTCRay, org_x) / sizeof(float);
constexpr std::size_t kDirection = offsetof(RTCRay, dir_x) / sizeof(float);
constexpr std::size_t kEnd = offsetof(RTCRay, tfar) / sizeof(float);
constexpr std::size_t kId = offsetof(RTCRay, id) / sizeof(float);

/// A triangle that Embree offers to rays.
struct Offer {
  const Trace& trace;
  EmbreeRays rays;
  unsigned instance;  ///< in whose frame it is; RTC_INVALID_GEOMETRY_ID: the world's
  const TracedTriangle& triangle;
  const TrianglePlane& plane;
};

float origin_error(const Offer& offer) {
  if (offer.instance == RTC_INVALID_GEOMETRY_ID) return 0.0F;
  const Placement& placement = offer.trace.placements[offer.instance];
  const auto size = static_cast<float>(placement.position_world.cwiseAbs().sum());
  // Embree's way into the instance takes fewer than 16 roundings.
  return 16.0F * 0x1p-24F * (offer.trace.farthest_origin + size) /
         static_cast<float>(placement.scale);
}

/// A bit for each lane that Embree asks for.
unsigned asked_lanes(const int* valid, unsigned count) {
  if (count == kLanesOfPacket) {
    const auto four = [valid](int first) {
      return static_cast<unsigned>(
          _mm_movemask_ps(_mm_loadu_ps(reinterpret_cast<const float*>(valid) + first)));
    };
    return four(0) | four(4) << 4U;
  }
  unsigned asked = 0;
  for (unsigned i = 0; i < count; ++i) asked |= valid[i] != 0 ? 1U << i : 0U;
  return asked;
}

/// Calls `meet(lane, id, distance)` for each ray that meets the triangle no farther than its end.
template <class Meet>
void offer_to_rays(const Offer& offer, const int* valid, Meet meet) {
  // In forests most of the time here is waiting for memory. For the triangle and, where a ray meets
  // it, for its plane: asked for together, they are one wait.
  __builtin_prefetch(&offer.plane);
  const EmbreeRays& rays = offer.rays;
  const bool is_packet = rays.count == kLanesOfPacket;
  // Within an instance, Embree's rays are turned by its own rounding.
  const bool is_exact = is_packet && offer.instance == RTC_INVALID_GEOMETRY_ID;
  RayTest lanes{asked_lanes(valid, rays.count), 0};
  double distances[kLanesOfPacket];
  if (is_packet) {
    const PacketOfRays packet{
        {rays.number(kOrigin), rays.number(kOrigin + 1), rays.number(kOrigin + 2)},
        {rays.number(kDirection), rays.number(kDirection + 1), rays.number(kDirection + 2)},
        rays.number(kEnd),
        origin_error(offer)};
    const RayTest all = ray_test().test(packet, offer.triangle);
    lanes = {lanes.possible & all.possible, all.sure};
    if (lanes.possible == 0) return;
    if (is_exact) ray_test().distances(packet, offer.plane, distances);
  }
  for (unsigned left = lanes.possible; left != 0; left &= left - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(left));
    const unsigned id = rays.integer(kId)[lane];
    const double distance =
        is_exact ? distances[lane]
                 : distance_to(offer.plane, exact_ray(offer.trace, id, offer.instance));
    if (!(distance > 0.0 && distance <= offer.trace.distances[id])) continue;
    if ((lanes.sure >> lane & 1U) == 0 &&
        !is_inside(offer.triangle, exact_ray(offer.trace, id, offer.instance))) {
      continue;
    }
    meet(lane, id, distance);
  }
}

void intersect_triangle(const RTCIntersectFunctionNArguments* asked) {
  auto& trace = *reinterpret_cast<Trace*>(asked->context);
  const auto& mesh = *static_cast<const TracedMesh*>(asked->geometryUserPtr);
  const EmbreeRays rays{asked->N, reinterpret_cast<float*>(asked->rayhit)};
  const unsigned instance = asked->context->instID[0];
  RTCHitN* const hits = RTCRayHitN_HitN(asked->rayhit, asked->N);
  const Offer offer{trace, rays, instance, mesh.triangles[asked->primID],
                    mesh.planes[asked->primID]};
  offer_to_rays(offer, asked->valid, [&](unsigned lane, unsigned id, double distance) {
    unsigned& geometry = RTCHitN_geomID(hits, asked->N, lane);
    unsigned& met_instance = RTCHitN_instID(hits, asked->N, lane, 0);
    unsigned& number = RTCHitN_primID(hits, asked->N, lane);
    if (distance == trace.distances[id] && geometry != RTC_INVALID_GEOMETRY_ID) {
      const std::pair met(instance_of(met_instance, geometry), number);
      if (met < std::pair(instance_of(instance, asked->geomID), asked->primID)) return;
    }
    trace.distances[id] = distance;
    rays.number(kEnd)[lane] = rounded_up(distance);
    geometry = asked->geomID;
    met_instance = instance;
    number = asked->primID;
  });
}

void occlude_triangle(const RTCOccludedFunctionNArguments* asked) {
  const auto& trace = *reinterpret_cast<const Trace*>(asked->context);
  const auto& mesh = *static_cast<const TracedMesh*>(asked->geometryUserPtr);
  const EmbreeRays rays{asked->N, reinterpret_cast<float*>(asked->ray)};
  const Offer offer{trace, rays, asked->context->instID[0], mesh.triangles[asked->primID],
                    mesh.planes[asked->primID]};
  offer_to_rays(offer, asked->valid, [&](unsigned lane, unsigned, double) {
    rays.number(kEnd)[lane] = -std::numeric_limits<float>::infinity();
  });
}

void bounds(const RTCBoundsFunctionArguments* asked) {
  const auto& mesh = *static_cast<const TracedMesh*>(asked->geometryUserPtr);
  const TracedTriangle& t = mesh.triangles[asked->primID];
  float low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min({t.a[k], t.b[k], t.c[k]}) - mesh.box_slack;
    high[k] = std::max({t.a[k], t.b[k], t.c[k]}) + mesh.box_slack;
  }
  *asked->bounds_o = {low[0], low[1], low[2], 0.0F, high[0], high[1], high[2], 0.0F};
}

/// Numbers the rays and keeps what is needed of them.
void add_rays(Trace& trace, RTCRay8& rays, unsigned packet) {
  const unsigned first = packet * kLanesOfPacket;
  const float* const numbers[6] = {rays.org_x, rays.org_y, rays.org_z,
                                   rays.dir_x, rays.dir_y, rays.dir_z};
  for (int k = 0; k < 3; ++k) {
    std::copy_n(numbers[k], kLanesOfPacket, trace.origins[k] + first);
    std::copy_n(numbers[3 + k], kLanesOfPacket, trace.directions[k] + first);
  }
  for (unsigned lane = 0; lane < kLanesOfPacket; ++lane) {
    rays.id[lane] = first + lane;
    trace.distances[first + lane] = static_cast<double>(rays.tfar[lane]);
    const float size =
        std::abs(rays.org_x[lane]) + std::abs(rays.org_y[lane]) + std::abs(rays.org_z[lane]);
    trace.farthest_origin = std::max(trace.farthest_origin, size);
  }
}

}  // namespace

TracedTriangle traced_triangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                               const Eigen::Vector3f& c) {
  const Vector3d ab = b.cast<double>() - a.cast<double>(), bc = c.cast<double>() - b.cast<double>(),
                 ca = a.cast<double>() - c.cast<double>();
  const Vector3d normal = ca.cross(ab);
  const auto size = [](const Vector3d& edge) { return edge.cwiseAbs().sum(); };
  TracedTriangle triangle{};
  for (int k = 0; k < 3; ++k) {
    triangle.a[k] = a[k];
    triangle.b[k] = b[k];
    triangle.c[k] = c[k];
    triangle.normal[k] = static_cast<float>(normal[k]);
  }
  triangle.edge = rounded_up(std::max({size(ab), size(bc), size(ca)}));
  return triangle;
}

embree::GeometryHandle make_traced_geometry(const TracedMesh& mesh) {
  embree::GeometryHandle geometry(rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_USER));
  embree::check_errors("making a mesh");
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(mesh.triangles.size()));
  rtcSetGeometryUserData(geometry.get(), const_cast<TracedMesh*>(&mesh));
  rtcSetGeometryBoundsFunction(geometry.get(), bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect_triangle);
  rtcSetGeometryOccludedFunction(geometry.get(), occlude_triangle);
  rtcCommitGeometry(geometry.get());
  embree::check_errors("making a mesh");
  return geometry;
}

void trace(RTCScene scene, const Placement* placements, RTCRayHit8& packet) {
  Trace trace(placements);
  add_rays(trace, packet.ray, 0);
  embree::intersect(scene, trace.embree, packet);
}

void trace(RTCScene scene, const Placement* placements,
           RTCRayHit8 (&packets)[embree::kStreamPackets]) {
  Trace trace(placements);
  unsigned index = 0;
  for (RTCRayHit8& packet : packets) add_rays(trace, packet.ray, index++);
  embree::intersect_stream(scene, trace.embree, packets);
}

void occlude(RTCScene scene, const Placement* placements, RTCRay8& packet) {
  Trace trace(placements);
  add_rays(trace, packet, 0);
  embree::occlude(scene, trace.embree, packet);
}

void occlude(RTCScene scene, const Placement* placements,
             RTCRay8 (&packets)[embree::kStreamPackets]) {
  Trace trace(placements);
  unsigned index = 0;
  for (RTCRay8& packet : packets) add_rays(trace, packet, index++);
  embree::occlude_stream(scene, trace.embree, packets);
}

}  // namespace avoidbench
