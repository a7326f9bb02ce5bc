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

/// What callbacks get with each query.
#if AVOIDBENCH_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// Lanes with tfar < tnear are inactive.
struct ActiveLanes {
  explicit ActiveLanes(const RTCRay8& rays) {
    for (int i = 0; i < 8; ++i) valid[i] = rays.tnear[i] <= rays.tfar[i] ? -1 : 0;
  }
  alignas(32) int valid[8];
};

#if AVOIDBENCH_EMBREE_MAJOR >= 4

inline void begin(QueryContext& context) { rtcInitRayQueryContext(&context); }

inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit8& packet) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(ActiveLanes(packet.ray).valid, scene, &packet, &arguments);
}

inline void occlude(RTCScene scene, QueryContext& context, RTCRay8& packet) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded8(ActiveLanes(packet).valid, scene, &packet, &arguments);
}

inline void intersect_stream(RTCScene scene, QueryContext& context,
                             RTCRayHit8 (&packets)[kStreamPackets]) {
  for (RTCRayHit8& packet : packets) intersect(scene, context, packet);
}

inline void occlude_stream(RTCScene scene, QueryContext& context,
                           RTCRay8 (&packets)[kStreamPackets]) {
  for (RTCRay8& packet : packets) occlude(scene, context, packet);
}

#else

inline void begin(QueryContext& context) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit8& packet) {
  rtcIntersect8(ActiveLanes(packet.ray).valid, scene, &context, &packet);
}

inline void occlude(RTCScene scene, QueryContext& context, RTCRay8& packet) {
  rtcOccluded8(ActiveLanes(packet).valid, scene, &context, &packet);
}

inline void intersect_stream(RTCScene scene, QueryContext& context,
                             RTCRayHit8 (&packets)[kStreamPackets]) {
  rtcIntersectNM(scene, &context, reinterpret_cast<RTCRayHitN*>(packets), 8, kStreamPackets,
                 sizeof(RTCRayHit8));
}

inline void occlude_stream(RTCScene scene, QueryContext& context,
                           RTCRay8 (&packets)[kStreamPackets]) {
  rtcOccludedNM(scene, &context, reinterpret_cast<RTCRayN*>(packets), 8, kStreamPackets,
                sizeof(RTCRay8));
}

#endif

}  // namespace avoidbench::embree
