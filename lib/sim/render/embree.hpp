#pragma once

#ifndef AVOIDBENCH_EMBREE_MAJOR
#error "only render and shading see Embree's headers: link avoidbench_embree, or include less"
#elif AVOIDBENCH_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>
#include <memory>
#include <type_traits>

/// The one place that knows whether this is Embree 3.13 or 4. Private to this room and its
/// benchmark.
namespace avoidbench::embree {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// Packets in one coherent stream. Four packets of eight rays are what Embree 3.13 traces fastest
/// with AVX2.
inline constexpr std::size_t kStreamPackets = 4;

#if AVOIDBENCH_EMBREE_MAJOR >= 4

inline void intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  rtcIntersect1(scene, &ray, &arguments);
}

inline void occlude(RTCScene scene, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  rtcOccluded1(scene, &ray, &arguments);
}

/// Lanes with tfar < tnear are inactive.
inline void intersect_stream(RTCScene scene, RTCRayHit8 (&packets)[kStreamPackets]) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (RTCRayHit8& packet : packets) {
    alignas(32) int valid[8];
    for (int i = 0; i < 8; ++i) valid[i] = packet.ray.tnear[i] <= packet.ray.tfar[i] ? -1 : 0;
    rtcIntersect8(valid, scene, &packet, &arguments);
  }
}

inline void occlude_stream(RTCScene scene, RTCRay8 (&packets)[kStreamPackets]) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (RTCRay8& packet : packets) {
    alignas(32) int valid[8];
    for (int i = 0; i < 8; ++i) valid[i] = packet.tnear[i] <= packet.tfar[i] ? -1 : 0;
    rtcOccluded8(valid, scene, &packet, &arguments);
  }
}

#else

inline void intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}

inline void occlude(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

/// Lanes with tfar < tnear are inactive.
inline void intersect_stream(RTCScene scene, RTCRayHit8 (&packets)[kStreamPackets]) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersectNM(scene, &context, reinterpret_cast<RTCRayHitN*>(packets), 8, kStreamPackets,
                 sizeof(RTCRayHit8));
}

inline void occlude_stream(RTCScene scene, RTCRay8 (&packets)[kStreamPackets]) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccludedNM(scene, &context, reinterpret_cast<RTCRayN*>(packets), 8, kStreamPackets,
                sizeof(RTCRay8));
}

#endif

}  // namespace avoidbench::embree
