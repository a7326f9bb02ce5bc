#pragma once

#include "render/depth_kernel.hpp"
#include "render/lanes.hpp"

/// The source of both builds of the depth kernel; see depth_kernel.hpp.
namespace avoidbench {
namespace {

constexpr std::uint32_t kNothing = ~0U;

/// The lanes that see the same triangle.
struct Facet {
  const TrianglePlane* plane;
  std::uint32_t instance;
  unsigned lanes;  ///< a bit a lane
};

/// What one register's rays see: one triangle on smooth ground, each its own in foliage.
struct Facets {
  int count;
  Facet all[kLanes];
};

/// The rays of a packet that fill a register: all of it, or one row.
struct Rays {
  PacketOfHits hits;  ///< from the first of them
  const double* v;    ///< of their rows
};

constexpr int kRows = kLanes / kPacketColumns;
constexpr int kRegisters = kDepthPackets * kPacketRows / kRows;

AB_LANE Rays rays_of(const DepthFrame& frame, int index, std::size_t y) {
  const int row = index * kRows;
  const PacketOfHits& packet = frame.packets[row / kPacketRows];
  const int lane = row % kPacketRows * kPacketColumns;
  return {{packet.traced_depths + lane, packet.geometries + lane, packet.instances + lane,
           packet.triangles + lane},
          frame.v + y + row};
}

/// The geometry of a ray that meets nothing stays ~0.
AB_LANE Mask missed(const PacketOfHits& packet) {
  return load<Ints>(packet.geometries) == kNothing;
}

/// Has the planes fetched, too, which are all over the memory where triangles are small.
AB_LANE void find_facets(const DepthFrame& frame, const PacketOfHits& packet, Facets& found) {
  const auto instances = load<Ints>(packet.instances);
  const auto triangles = load<Ints>(packet.triangles);
  found.count = 0;
  for (unsigned left = lane_bits(~missed(packet)); left != 0;) {
    const int lane = __builtin_ctz(left);
    const std::uint32_t instance = packet.instances[lane];
    const std::uint32_t triangle = packet.triangles[lane];
    const TrianglePlane* plane = frame.planes[instance] + triangle;
    __builtin_prefetch(plane);
    const unsigned lanes = left & lane_bits((instances == instance) & (triangles == triangle));
    left &= ~lanes;
    found.all[found.count++] = {plane, instance, lanes};
  }
}

/// h and a·u + b·v + c of the lanes' planes.
struct Fractions {
  Floats numerators, denominators;
};

AB_LANE Fractions fractions(const DepthFrame& frame, const Facet& facet, const double* u,
                            const double* v, LastPlane& last) {
  if (facet.plane != last.plane || facet.instance != last.instance) {
    last.plane = facet.plane;
    last.instance = facet.instance;
    last.in_camera =
        seen_by(frame.cameras[camera_of(facet.instance, frame.flattened_count)], *facet.plane);
  }
  const PlaneInCamera& plane = last.in_camera;
  const auto denominators = [&](int lane) {
    return plane.a * load<Doubles>(u + lane % kPacketColumns) +
           (plane.b * v[lane / kPacketColumns] + plane.c);
  };
  return {all_lanes(static_cast<float>(plane.h)),
          to_floats(denominators(0), denominators(kDoubles))};
}

/// The plane's depth where it agrees with that of the traced ray, as settled_distance() has it; at
/// most the farthest; NaN below the nearest.
AB_LANE Floats settled(const Fractions& lanes, Floats traced, const DepthFrame& frame) {
  const Floats plane = lanes.numerators / lanes.denominators;
  const Mask agrees = magnitude(plane - traced) <= 1e-3F * traced;
  const Floats depth = select(agrees, plane, traced);
  const Mask too_near = depth < frame.nearest_m;
  // A NaN of all bits but the sign, as images have had it.
  const auto not_a_number = bits_as<Floats>(all_lanes(0x7fffffffU));
  return select(too_near, not_a_number, least(depth, frame.farthest_m));
}

/// Row by row.
template <class Number, class Vector>
AB_LANE void store_rows(Number* to, std::size_t width, Vector lanes) {
  for (std::size_t row = 0; row < kRows; ++row) {
    __builtin_memcpy(to + row * width,
                     reinterpret_cast<const Number*>(&lanes) + row * kPacketColumns,
                     kPacketColumns * sizeof(Number));
  }
}

void read_depths(const DepthFrame& frame, std::size_t x, std::size_t y, const DepthPixels& to,
                 LastPlane& last) {
  Facets facets[kRegisters];
  for (int i = 0; i < kRegisters; ++i) {
    find_facets(frame, rays_of(frame, i, y).hits, facets[i]);
  }
  const double* u = frame.u + x;
  const auto infinite = bits_as<Floats>(all_lanes(0x7f800000U));
  std::size_t at = 0;
  for (int i = 0; i < kRegisters; ++i, at += kRows * to.width) {
    const Rays rays = rays_of(frame, i, y);
    const Mask nothing = missed(rays.hits);
    Floats depths = infinite;
    if (facets[i].count > 0) {
      Fractions lanes = fractions(frame, facets[i].all[0], u, rays.v, last);
      for (int k = 1; k < facets[i].count; ++k) {
        const Fractions one = fractions(frame, facets[i].all[k], u, rays.v, last);
        const Mask mask = mask_of(facets[i].all[k].lanes);
        lanes.numerators = select(mask, one.numerators, lanes.numerators);
        lanes.denominators = select(mask, one.denominators, lanes.denominators);
      }
      const auto traced = load<Floats>(rays.hits.traced_depths);
      depths = select(nothing, infinite, settled(lanes, traced, frame));
    }
    store_rows(to.depths + at, to.width, depths);
    if (to.instances != nullptr) {
      const Ints instances = select(nothing, all_lanes(kNothing), load<Ints>(rays.hits.instances));
      store_rows(to.instances + at, to.width, instances);
    }
  }
}

}  // namespace
}  // namespace avoidbench
