#include "render/depth.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/check.hpp"
#include "render/depth_kernel.hpp"
#include "render/flush_to_zero.hpp"
#include "render/primary_rays.hpp"
#include "render/ray_tracing_isa.hpp"

namespace avoidbench {
namespace {

static_assert(kNoInstance == RTC_INVALID_GEOMETRY_ID);
static_assert(kDepthPackets == embree::kStreamPackets && kBlockWidth == 4 && kPacketHeight == 2);

DepthFrame frame_of(const PrimaryRays& rays, const Scene::Internals& scene, const Pinhole& camera) {
  DepthFrame frame{};
  for (std::size_t i = 0; i < embree::kStreamPackets; ++i) {
    const RTCRayHit8& packet = rays.packet(i);
    frame.packets[i] = {packet.ray.tfar, packet.hit.geomID, rays.instances(packet),
                        packet.hit.primID};
  }
  frame.planes = scene.planes_of.data();
  frame.cameras = rays.cameras().data();
  frame.flattened_count = scene.flattened_count;
  frame.u = rays.u();
  frame.v = rays.v();
  frame.nearest_m = static_cast<float>(camera.min_range_m);
  frame.farthest_m = static_cast<float>(camera.max_range_m);
  return frame;
}

/// A block at the image's border, of which only a part is inside.
struct BorderBlock {
  float depths[kBlockWidth * kBlockHeight];
  std::uint32_t instances[kBlockWidth * kBlockHeight];
};

template <class Pixel>
void copy_part(const Pixel* from, std::size_t rows, std::size_t columns, std::size_t width,
               Pixel* to) {
  for (std::size_t row = 0; row < rows; ++row, from += kBlockWidth, to += width) {
    std::copy_n(from, columns, to);
  }
}

}  // namespace

const DepthKernel& depth_kernel() { return has_avx2() ? kAvx2Depth : kPortableDepth; }

void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m) {
  render_depth(scene, camera, T_world_camera, depth_m, {});
}

void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m, std::span<std::uint32_t> instances) {
  render_depth_by(depth_kernel(), scene, camera, T_world_camera, depth_m, instances);
}

void render_depth_by(const DepthKernel& kernel, const Scene& scene, const Pinhole& camera,
                     const Pose& T_world_camera, std::span<float> depth_m,
                     std::span<std::uint32_t> instances) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  AB_CHECK(depth_m.size() == width * height, depth_m.size(), width, height);
  AB_CHECK(instances.empty() || instances.size() == depth_m.size(), instances.size());
  const Scene::Internals& internals = scene.internals();
  // Embree recommends it: denormal numbers would cost hundreds of cycles each.
  const ScopedFlushToZero flush;
  PrimaryRays rays(internals, camera, T_world_camera);
  const DepthFrame frame = frame_of(rays, internals, camera);
  LastPlane last;
  const bool has_instances = !instances.empty();
  for (int block_y = 0; block_y < rays.blocks_down(); ++block_y) {
    const std::size_t y = static_cast<std::size_t>(block_y) * kBlockHeight;
    const std::size_t rows = std::min<std::size_t>(kBlockHeight, height - y);
    for (int block_x = 0; block_x < rays.blocks_across(); ++block_x) {
      const std::size_t x = static_cast<std::size_t>(block_x) * kBlockWidth;
      const std::size_t columns = std::min<std::size_t>(kBlockWidth, width - x);
      const std::size_t at = y * width + x;
      std::uint32_t* const seen = has_instances ? instances.data() + at : nullptr;
      rays.trace(block_x, block_y);
      if (rows == kBlockHeight && columns == kBlockWidth) {
        kernel.read(frame, x, y, {depth_m.data() + at, seen, width}, last);
        continue;
      }
      BorderBlock block;
      kernel.read(frame, x, y,
                  {block.depths, has_instances ? block.instances : nullptr, kBlockWidth}, last);
      copy_part(block.depths, rows, columns, width, depth_m.data() + at);
      if (has_instances) copy_part(block.instances, rows, columns, width, seen);
    }
  }
}

}  // namespace avoidbench
