#pragma once

#include "render/lanes.hpp"
#include "render/ray_test.hpp"

/// The source of both builds of the ray test; see ray_test.hpp.
namespace avoidbench {
namespace {

/// Relative to the products' greatest size: 64 units of float rounding, of which the longest chain
/// of operations here takes less than 20.
constexpr float kRounding = 64.0F * 0x1p-24F;

struct Triple {
  Floats x, y, z;
};

AB_LANE Triple load_triple(const float* const (&from)[3], int first) {
  return {load<Floats>(from[0] + first), load<Floats>(from[1] + first),
          load<Floats>(from[2] + first)};
}

AB_LANE Floats dot(const Triple& a, float x, float y, float z) {
  return a.x * x + a.y * y + a.z * z;
}

AB_LANE Floats size(const Triple& a) { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }

/// Möller and Trumbore's test: the origin relative to corner a, crossed with the direction, gives
/// the corners' weights times `slope`.
AB_LANE RayTest test_lanes(const PacketOfRays& rays, int first, const TracedTriangle& t) {
  const Triple origin = load_triple(rays.origin, first);
  const Triple d = load_triple(rays.direction, first);
  const Triple to_a{t.a[0] - origin.x, t.a[1] - origin.y, t.a[2] - origin.z};
  const Triple cross{to_a.y * d.z - to_a.z * d.y, to_a.z * d.x - to_a.x * d.z,
                     to_a.x * d.y - to_a.y * d.x};
  const Floats signed_slope = dot(d, t.normal[0], t.normal[1], t.normal[2]);
  const Floats slope = magnitude(signed_slope);
  const Floats of_b =
      turned(dot(cross, t.c[0] - t.a[0], t.c[1] - t.a[1], t.c[2] - t.a[2]), signed_slope);
  const Floats of_c =
      turned(dot(cross, t.a[0] - t.b[0], t.a[1] - t.b[1], t.a[2] - t.b[2]), signed_slope);
  const Floats least_weight = least(least(of_b, of_c), slope - of_b - of_c);
  const Floats distance = size(to_a);
  const Floats off = kRounding * (distance + t.edge) + 4.0F * rays.origin_error;
  const Floats error = off * (size(d) * t.edge);
  const Mask inside = least_weight >= 0.0F - error;
  if (!any(inside)) return {0, 0};
  // height = parameter × slope: behind the origin, or beyond the ray's end.
  const Floats height = turned(dot(to_a, t.normal[0], t.normal[1], t.normal[2]), signed_slope);
  const Floats height_error = off * (t.edge * t.edge);
  const Floats end = load<Floats>(rays.limit + first);
  const Mask ahead = height >= 0.0F - height_error;
  const Mask before = ~(height - height_error > end * (slope * (1.0F + kRounding) + error));
  return {lane_bits(inside & ahead & before) << first, lane_bits(least_weight > error) << first};
}

RayTest test_packet(const PacketOfRays& rays, const TracedTriangle& triangle) {
  RayTest all{0, 0};
  for (int first = 0; first < 8; first += kLanes) {
    const RayTest some = test_lanes(rays, first, triangle);
    all.possible |= some.possible;
    all.sure |= some.sure;
  }
  return all;
}

AB_LANE Doubles load_doubles(const float* from) {
#ifdef __AVX2__
  return _mm256_cvtps_pd(_mm_loadu_ps(from));
#else
  return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
#endif
}

AB_LANE Doubles magnitude(Doubles x) { return x < 0.0 ? -x : x; }

void plane_distances(const PacketOfRays& rays, const TrianglePlane& plane, double (&distances)[8]) {
  const auto along = [&plane](const Doubles& x, const Doubles& y, const Doubles& z) {
    return plane.nx * x + plane.ny * y + plane.nz * z;
  };
  const Doubles nan = all_lanes(__builtin_nan(""));
  for (int i = 0; i < 8; i += kDoubles) {
    const Doubles x = load_doubles(rays.direction[0] + i), y = load_doubles(rays.direction[1] + i),
                  z = load_doubles(rays.direction[2] + i);
    const Doubles slope = along(x, y, z);
    const Doubles origin = along(load_doubles(rays.origin[0] + i), load_doubles(rays.origin[1] + i),
                                 load_doubles(rays.origin[2] + i));
    const Doubles length = magnitude(x) + magnitude(y) + magnitude(z);
    const Doubles distance = (plane.offset - origin) / slope;
    store(distances + i, magnitude(slope) > kEdgeOn * length ? distance : nan);
  }
}

}  // namespace
}  // namespace avoidbench
