#pragma once

#include "render/depth_kernel.hpp"
#include "render/lanes.hpp"

/// The source of both builds of the depth kernel; see depth_kernel.hpp.
namespace avoidbench {
namespace {

constexpr int kLanes = 8;
constexpr std::uint32_t kNothing = ~0U;

/// The lanes that see the same triangle.
struct Facet {
  const TrianglePlane* plane;
  std::uint32_t instance;
  unsigned lanes;  ///< a bit a lane
};

/// What the lanes of a packet see: one triangle on smooth ground, up to eight in foliage.
struct Facets {
  int count;
  Facet all[kLanes];
};

/// Embree leaves the geometry of a ray that meets nothing at ~0.
AB_LANE Mask missed(const PacketOfHits& packet) {
  return load(packet.geometries) == all_lanes(kNothing);
}

/// Has the planes fetched, too, which are all over the memory where triangles are small.
AB_LANE void find_facets(const DepthFrame& frame, const PacketOfHits& packet, Facets& found) {
  const Ints instances = load(packet.instances);
  const Ints triangles = load(packet.triangles);
  found.count = 0;
  for (unsigned left = 0xffU & ~lane_bits(missed(packet)); left != 0;) {
    const int lane = __builtin_ctz(left);
    const std::uint32_t instance = packet.instances[lane];
    const std::uint32_t triangle = packet.triangles[lane];
    const TrianglePlane* plane = frame.planes[instance] + triangle;
    __builtin_prefetch(plane);
    const unsigned lanes =
        left & lane_bits((instances == all_lanes(instance)) & (triangles == all_lanes(triangle)));
    left &= ~lanes;
    found.all[found.count++] = {plane, instance, lanes};
  }
}

/// h and a·u + b·v + c of the lanes' planes.
struct Fractions {
  Floats numerators, denominators;
};

AB_LANE Fractions fractions(const DepthFrame& frame, const Facet& facet, Doubles u, const double* v,
                            LastPlane& last) {
  if (facet.plane != last.plane || facet.instance != last.instance) {
    last.plane = facet.plane;
    last.instance = facet.instance;
    last.in_camera =
        as_plane(seen_by(frame.cameras[frame.has_one_camera ? 0 : facet.instance], *facet.plane));
  }
  const PlaneInCamera& plane = last.in_camera;
  const Doubles along = all_lanes(plane.a) * u;
  return {all_lanes(static_cast<float>(plane.h)),
          to_floats(along + all_lanes(plane.b * v[0] + plane.c),
                    along + all_lanes(plane.b * v[1] + plane.c))};
}

/// The plane's depth where it agrees with Embree's own, as settled_distance() has it; at most the
/// farthest; NaN below the nearest.
AB_LANE Floats settled(const Fractions& lanes, Floats embree, const DepthFrame& frame) {
  const Floats plane = lanes.numerators / lanes.denominators;
  const Mask agrees = magnitude(plane - embree) <= all_lanes(1e-3F) * embree;
  const Floats depth = select(agrees, plane, embree);
  const Mask too_near = depth < all_lanes(frame.nearest_m);
  // A NaN of all bits but the sign, as images have had it.
  const Floats not_a_number = bits_as_floats(all_lanes(0x7fffffffU));
  return select(too_near, not_a_number, least(depth, all_lanes(frame.farthest_m)));
}

void read_depths(const DepthFrame& frame, std::size_t x, std::size_t y, const DepthPixels& to,
                 LastPlane& last) {
  Facets facets[kDepthPackets];
  for (int i = 0; i < kDepthPackets; ++i) find_facets(frame, frame.packets[i], facets[i]);
  const Doubles u = load_four(frame.u + x);
  const double* v = frame.v + y;
  const Floats infinite = bits_as_floats(all_lanes(0x7f800000U));
  std::size_t at = 0;
  for (int i = 0; i < kDepthPackets; ++i, at += 2 * to.width, v += 2) {
    const PacketOfHits& packet = frame.packets[i];
    const Mask nothing = missed(packet);
    Floats depths = infinite;
    if (facets[i].count > 0) {
      Fractions lanes = fractions(frame, facets[i].all[0], u, v, last);
      for (int k = 1; k < facets[i].count; ++k) {
        const Fractions one = fractions(frame, facets[i].all[k], u, v, last);
        const Mask mask = mask_of(facets[i].all[k].lanes);
        lanes.numerators = select(mask, one.numerators, lanes.numerators);
        lanes.denominators = select(mask, one.denominators, lanes.denominators);
      }
      depths = select(nothing, infinite, settled(lanes, load(packet.embree_depths), frame));
    }
    store_halves(to.depths + at, to.depths + at + to.width, depths);
    if (to.instances != nullptr) {
      const Ints instances = select(nothing, all_lanes(kNothing), load(packet.instances));
      store_halves(to.instances + at, to.instances + at + to.width, instances);
    }
  }
}

}  // namespace
}  // namespace avoidbench
