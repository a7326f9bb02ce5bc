#pragma once

#include <algorithm>
#include <cstring>
#include <ctime>
#include <vector>

#include "render/device.hpp"
#include "render/flush_to_zero.hpp"
#include "render/primary_rays.hpp"
#include "render/scene_internals.hpp"

/// The reference that rendering is measured against: Embree itself, with triangles of its own kind,
/// over the same packets, nothing else.
namespace avoidbench {

/// This thread's processor time, which other programs on the machine disturb less than the clock on
/// the wall.
inline double processor_s() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// The directions of every ray of a frame, in the order they are traced.
struct Block {
  float directions[embree::kStreamPackets][3][8];
};

inline std::vector<Block> prepared_rays(const Pinhole& camera, const Pose& pose) {
  std::vector<Block> blocks;
  for (int y = 0; y < camera.height_px; y += kBlockHeight) {
    for (int x = 0; x < camera.width_px; x += kBlockWidth) {
      Block& block = blocks.emplace_back();
      for (int i = 0; i < 8 * static_cast<int>(embree::kStreamPackets); ++i) {
        const Eigen::Vector3d in_camera((x + i % kBlockWidth - camera.cx_px) / camera.fx_px,
                                        (y + i / kBlockWidth - camera.cy_px) / camera.fy_px, 1.0);
        const Eigen::Vector3d direction = pose.linear() * in_camera;
        for (int k = 0; k < 3; ++k) {
          block.directions[i / 8][k][i % 8] = static_cast<float>(direction[k]);
        }
      }
    }
  }
  return blocks;
}

template <class T>
void set_bare_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                     const std::vector<T>& values) {
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
  std::memcpy(buffer, static_cast<const void*>(values.data()), values.size() * sizeof(T));
}

/// All instances of a world as Embree's own triangles in one hierarchy.
inline embree::SceneHandle bare_scene(const World& world) {
  embree::SceneHandle scene(rtcNewScene(embree::device()));
  for (const Instance& instance : world.instances) {
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    if (mesh.triangles.empty()) continue;
    std::vector<Eigen::Vector3f> vertices;
    for (const Eigen::Vector3f& v : mesh.vertices) {
      vertices.push_back(instance.T_world_prototype * v);
    }
    const embree::GeometryHandle geometry(
        rtcNewGeometry(embree::device(), RTC_GEOMETRY_TYPE_TRIANGLE));
    set_bare_buffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
    set_bare_buffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
  }
  rtcCommitScene(scene.get());
  return scene;
}

inline void trace_bare(RTCScene scene, RTCRayHit8 (&packets)[embree::kStreamPackets]) {
  embree::QueryContext context;
  embree::begin(context);
  embree::intersect_stream(scene, context, packets);
}

/// Directions copied in, traced, nothing out.
inline void trace_bare(RTCScene scene, const std::vector<Block>& blocks, const Pose& pose,
                       double range_m) {
  const ScopedFlushToZero flush;
  RTCRayHit8 packets[embree::kStreamPackets] = {};
  for (RTCRayHit8& packet : packets) {
    std::fill_n(packet.ray.org_x, 8, static_cast<float>(pose.translation().x()));
    std::fill_n(packet.ray.org_y, 8, static_cast<float>(pose.translation().y()));
    std::fill_n(packet.ray.org_z, 8, static_cast<float>(pose.translation().z()));
    std::fill_n(packet.ray.mask, 8, ~0U);
  }
  for (const Block& block : blocks) {
    for (std::size_t i = 0; i < embree::kStreamPackets; ++i) {
      std::memcpy(packets[i].ray.dir_x, block.directions[i][0], sizeof(packets[i].ray.dir_x));
      std::memcpy(packets[i].ray.dir_y, block.directions[i][1], sizeof(packets[i].ray.dir_y));
      std::memcpy(packets[i].ray.dir_z, block.directions[i][2], sizeof(packets[i].ray.dir_z));
      std::fill_n(packets[i].ray.tfar, 8, static_cast<float>(range_m));
      std::fill_n(packets[i].hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
    }
    trace_bare(scene, packets);
  }
}

}  // namespace avoidbench
