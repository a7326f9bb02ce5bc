#pragma once

#include <cstddef>
#include <cstdint>

#include "render/triangle_plane.hpp"

/// Exact depths of the triangles that rays have met, a register of rays at a time. One
/// source (lane_depth.hpp), compiled for any x86-64 and for AVX2; both give the same bits. Plain
/// data here, and nothing that would bring the standard library's or Eigen's inline functions into
/// a file compiled for AVX2.
namespace avoidbench {

inline constexpr int kPacketColumns = 4, kPacketRows = 2;  ///< pixels
inline constexpr int kDepthPackets = 4;                    ///< one below the other

/// What the rays of one packet have met: eight numbers each, 32-byte aligned.
struct PacketOfHits {
  const float* traced_depths;       ///< [m]
  const std::uint32_t* geometries;  ///< ~0: the ray has hit nothing
  const std::uint32_t* instances;
  const std::uint32_t* triangles;
};

/// What is the same for all blocks of a frame.
struct DepthFrame {
  PacketOfHits packets[kDepthPackets];
  const TrianglePlane* const* planes;  ///< one list an instance
  const CameraAxes* cameras;           ///< in the frames of planes: see camera_of()
  unsigned flattened_count;
  const double* u;  ///< of the frame's columns and rows: (u, v, 1) is a ray in the camera's frame
  const double* v;
  float nearest_m, farthest_m;
};

/// The plane that was seen last, mostly the next block's too.
struct LastPlane {
  const TrianglePlane* plane = nullptr;
  std::uint32_t instance = 0;
  PlaneInCamera in_camera{};
};

/// The upper left pixel of a block in the images that are filled.
struct DepthPixels {
  float* depths;             ///< [m]; +inf: nothing was hit, NaN: nearer than the nearest
  std::uint32_t* instances;  ///< what was hit, ~0: nothing; null where nobody asks
  std::size_t width;         ///< of both images
};

/// One build of the kernel. Flush-to-zero must be on while it runs.
struct DepthKernel {
  /// Writes the 4 × 8 pixels whose first column and row are x and y.
  void (*read)(const DepthFrame& frame, std::size_t x, std::size_t y, const DepthPixels& to,
               LastPlane& last);
};

extern const DepthKernel kPortableDepth;
extern const DepthKernel kAvx2Depth;  ///< only where the processor has AVX2

}  // namespace avoidbench
