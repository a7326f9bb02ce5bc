#pragma once

#include <cstdint>

/// The arithmetic of shading, a register of rays at a time. One source (lane_shading.hpp),
/// compiled for any x86-64 and for AVX2; both give the same bits. Plain data here, and nothing that
/// would bring the standard library's or Eigen's inline functions into a file compiled for AVX2.
namespace avoidbench {

inline constexpr int kPacketLanes = 8;
inline constexpr int kBlockPackets = 4;
inline constexpr int kMaterialCount = 7;  ///< of Material (world/world.hpp)

/// What is the same for all rays of a frame. Directions are unit vectors in the world's frame.
struct FrameLight {
  float camera_world[3];
  float to_sun_world[3];
  float sun, sky;            ///< strengths, as in Light
  float haze_per_m;          ///< 1 / haze range
  float pixel_slope;         ///< size of a ray's footprint a metre of depth
  float ceiling_z_m;         ///< the sun is above the surfaces and below this
  float sun_distance_per_m;  ///< along the sun's rays, a metre of height
  float longest_shadow_m;    ///< no ray to the sun is longer
};

/// An instance as the camera sees it. Its own frame is the prototype's, scaled to metres.
struct ObjectView {
  float right[3], down[3], forward[3];  ///< the camera's axes
  float position[3];                    ///< of the camera [m]
  float R_object_world[3][3];
  float to_sun[3];
  float opacity;       ///< of the texture: 0 is bland
  std::uint32_t seed;  ///< well mixed: no two objects look the same
};

/// The lanes that see the same triangle.
struct FacetLanes {
  unsigned lanes;    ///< a bit a lane
  float a, b, c, h;  ///< a·u + b·v + c = h/depth, (u, v, 1) being a ray in the camera's frame
  float normal_world[3];  ///< unit
};

/// The lanes that see the same instance.
struct ObjectLanes {
  unsigned lanes;
  const ObjectView* object;
};

/// What the rays of one packet hit.
struct PacketHits {
  const float *ray_x, *ray_y, *ray_z;  ///< world frame, forward component 1; 32-byte aligned
  const float* traced_depth;           ///< [m]; 32-byte aligned
  const float *u, *v;                  ///< of each ray
  unsigned hit;                        ///< a bit a lane
  int facet_count, object_count;
  FacetLanes facets[kPacketLanes];
  ObjectLanes objects[kPacketLanes];
  unsigned material_lanes[kMaterialCount];
};

/// Where they hit it. Lanes that hit nothing hold numbers without meaning.
struct alignas(32) PacketSurface {
  float depth[kPacketLanes];             ///< along camera z [m]
  float object[3][kPacketLanes];         ///< position in the object's frame [m]
  float normal_object[3][kPacketLanes];  ///< unit, towards the viewer
  float footprint[kPacketLanes];         ///< size of a pixel on the surface [m]
  float ray_length[kPacketLanes];        ///< a metre of depth
  float shadow_from[3][kPacketLanes];    ///< off the surface, world frame [m]
  float shadow_length[kPacketLanes];     ///< of the ray to the sun [m]; negative: none is needed
  unsigned facing_sun;                   ///< lanes that the sun may reach
};

struct alignas(32) PacketLight {
  float rgb[3][kPacketLanes];  ///< linear light
  float grey[kPacketLanes];    ///< its Rec. 709 luminance
};

/// One build of the kernel. Flush-to-zero must be on while it runs.
struct ShadingKernel {
  void (*locate)(const FrameLight& frame, const PacketHits& hits, PacketSurface& surface);
  /// `lit` are the lanes that nothing hides from the sun.
  void (*shade)(const FrameLight& frame, const PacketHits& hits, const PacketSurface& surface,
                unsigned lit, PacketLight& light);
};

extern const ShadingKernel kPortableShading;
extern const ShadingKernel kAvx2Shading;  ///< only where the processor has AVX2

}  // namespace avoidbench
