#pragma once

#include "render/triangle_plane.hpp"

/// Which rays of a packet may meet a triangle, and which surely do, in float with bounds of its
/// rounding: what is neither sure nor out of the question is decided in double (tracing.cpp), so
/// that no answer depends on the rounding here. One source (lane_ray_test.hpp), compiled for any
/// x86-64 and for AVX2; both give the same bits. Plain data, as in depth_kernel.hpp.
namespace avoidbench {

/// A triangle as rays are tested against it: one line of the cache.
struct alignas(64) TracedTriangle {
  float a[3], b[3], c[3];  ///< corners
  float normal[3];         ///< (b − a) × (c − a), rounded
  float edge;              ///< at least the sum |x| + |y| + |z| of its longest edge
};

/// Eight rays: eight numbers each, 32-byte aligned.
struct PacketOfRays {
  const float* origin[3];
  const float* direction[3];
  const float* limit;  ///< the ray's parameter where it ends
  float origin_error;  ///< of each coordinate of the origins; 0: they are exact
};

/// A bit a ray.
struct RayTest {
  unsigned possible;  ///< may meet the triangle before their end
  unsigned sure;      ///< of these: meet its inside, wherever their end is
};

/// Edge-on is a sine of the angle between ray and plane below this. Distances are then still exact
/// to a thousandth of a millimetre.
inline constexpr double kEdgeOn = 1e-9;

/// One build of the kernel. Flush-to-zero must be on while it runs.
struct RayTestKernel {
  RayTest (*test)(const PacketOfRays& rays, const TracedTriangle& triangle);
  /// The rays' parameters where they meet the plane, in double. NaN where a ray runs along it: a
  /// triangle seen edge-on covers nothing.
  void (*distances)(const PacketOfRays& rays, const TrianglePlane& plane, double (&distances)[8]);
};

extern const RayTestKernel kPortableRayTest;
extern const RayTestKernel kAvx2RayTest;  ///< only where the processor has AVX2

}  // namespace avoidbench
