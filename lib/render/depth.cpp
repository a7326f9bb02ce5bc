#include "render/depth.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "base/check.hpp"
#include "render/flush_to_zero.hpp"
#include "render/primary_rays.hpp"

namespace avoidbench {
namespace {

constexpr float kInfinite_m = std::numeric_limits<float>::infinity();

/// What the camera measures, in each lane, metres.
struct DepthRange {
  __m128 nearest, farthest;
};

/// Four of a packet's lanes: one row of its pixels.
struct Row {
  __m128i triangles, instances;
  __m128 hit;                              ///< all bits set in the lanes that hit something
  __m128 numerators = _mm_setzero_ps();    ///< h of the lane's plane
  __m128 denominators = _mm_setzero_ps();  ///< a·u + b·v + c of the lane's plane

  Row(const unsigned* geometry, const unsigned* instance, const unsigned* triangle)
      : triangles(_mm_load_si128(reinterpret_cast<const __m128i*>(triangle))),
        instances(_mm_load_si128(reinterpret_cast<const __m128i*>(instance))) {
    // Embree leaves the geometry of a ray that meets nothing at -1.
    const __m128i missed = _mm_cmpeq_epi32(
        _mm_load_si128(reinterpret_cast<const __m128i*>(geometry)), _mm_set1_epi32(-1));
    hit = _mm_castsi128_ps(_mm_xor_si128(missed, _mm_set1_epi32(-1)));
  }

  /// kNoInstance in the lanes that hit nothing.
  __m128i seen_instances() const {
    static_assert(kNoInstance == ~0U);
    const __m128i missed = _mm_xor_si128(_mm_castps_si128(hit), _mm_set1_epi32(-1));
    return _mm_or_si128(instances, missed);
  }

  unsigned hits() const { return static_cast<unsigned>(_mm_movemask_ps(hit)); }

  /// Gives the lanes on this triangle their plane; returns which they are.
  unsigned take(unsigned instance, unsigned triangle, const PlaneInCamera& plane, __m128d au_low,
                __m128d au_high, double v) {
    const __m128i same_triangle =
        _mm_cmpeq_epi32(triangles, _mm_set1_epi32(static_cast<int>(triangle)));
    const __m128i same_instance =
        _mm_cmpeq_epi32(instances, _mm_set1_epi32(static_cast<int>(instance)));
    const __m128 taken =
        _mm_and_ps(hit, _mm_castsi128_ps(_mm_and_si128(same_triangle, same_instance)));
    const __m128d row = _mm_set1_pd(plane.b * v + plane.c);
    const __m128 denominator = _mm_movelh_ps(_mm_cvtpd_ps(_mm_add_pd(au_low, row)),
                                             _mm_cvtpd_ps(_mm_add_pd(au_high, row)));
    const __m128 numerator = _mm_set1_ps(static_cast<float>(plane.h));
    // Each lane is taken once and was zero before.
    denominators = _mm_or_ps(denominators, _mm_and_ps(taken, denominator));
    numerators = _mm_or_ps(numerators, _mm_and_ps(taken, numerator));
    return static_cast<unsigned>(_mm_movemask_ps(taken));
  }

  /// plane_depth() of the four lanes, to the bit, at most the farthest; +inf where nothing was hit,
  /// NaN below the nearest.
  __m128 depths(const float* embree_depths, const DepthRange& range) const {
    // The plane's depth where it agrees with Embree's own within 0.1 %, else Embree's.
    const __m128 depth = _mm_div_ps(numerators, denominators);
    const __m128 embree = _mm_load_ps(embree_depths);
    const __m128 no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
    const __m128 difference = _mm_and_ps(_mm_sub_ps(depth, embree), no_sign);
    const __m128 agrees = _mm_cmple_ps(difference, _mm_mul_ps(_mm_set1_ps(1e-3F), embree));
    const __m128 settled = _mm_or_ps(_mm_and_ps(agrees, depth), _mm_andnot_ps(agrees, embree));
    const __m128i too_near = _mm_castps_si128(_mm_cmplt_ps(settled, range.nearest));
    // All bits but the sign: a NaN that an `or` with any depth leaves a NaN.
    const __m128 nan_below = _mm_castsi128_ps(_mm_srli_epi32(too_near, 1));
    const __m128 in_range = _mm_or_ps(_mm_min_ps(settled, range.farthest), nan_below);
    return _mm_or_ps(_mm_and_ps(hit, in_range), _mm_andnot_ps(hit, _mm_set1_ps(kInfinite_m)));
  }
};

/// The triangle that was seen last, in the camera's frame: mostly the next packet's too.
struct LastPlane {
  unsigned instance = ~0U, triangle = ~0U;
  PlaneInCamera plane{};

  const PlaneInCamera& of(const PrimaryRays& rays, unsigned instance_now, unsigned triangle_now) {
    if (instance_now != instance || triangle_now != triangle) {
      instance = instance_now;
      triangle = triangle_now;
      plane = rays.plane(instance, triangle);
    }
    return plane;
  }
};

/// What a block's rays found, row by row.
struct alignas(16) Block {
  float depths[kBlockWidth * kBlockHeight];
  std::uint32_t instances[kBlockWidth * kBlockHeight];
};

/// The 4 × 2 pixels of packet `index`, whose first has the slopes `u` and `v`.
void read_packet(const PrimaryRays& rays, std::size_t index, const double* u, const double* v,
                 const DepthRange& range, LastPlane& last, Block& block) {
  const RTCRayHit8& packet = rays.packet(index);
  const unsigned* instances = rays.instances(packet);
  const unsigned* triangles = packet.hit.primID;
  Row first(packet.hit.geomID, instances, triangles);
  Row second(packet.hit.geomID + 4, instances + 4, triangles + 4);
  const __m128d u_low = _mm_loadu_pd(u);
  const __m128d u_high = _mm_loadu_pd(u + 2);
  // Once for each triangle in the packet: one on smooth ground, up to eight in foliage.
  for (unsigned left = first.hits() | second.hits() << 4U; left != 0;) {
    const int lane = std::countr_zero(left);
    const PlaneInCamera& plane = last.of(rays, instances[lane], triangles[lane]);
    const __m128d a = _mm_set1_pd(plane.a);
    const __m128d au_low = _mm_mul_pd(a, u_low);
    const __m128d au_high = _mm_mul_pd(a, u_high);
    left &= ~first.take(instances[lane], triangles[lane], plane, au_low, au_high, v[0]);
    left &= ~(second.take(instances[lane], triangles[lane], plane, au_low, au_high, v[1]) << 4U);
  }
  float* depths = block.depths + 8 * index;
  _mm_store_ps(depths, first.depths(packet.ray.tfar, range));
  _mm_store_ps(depths + 4, second.depths(packet.ray.tfar + 4, range));
  auto* seen = reinterpret_cast<__m128i*>(block.instances + 8 * index);
  _mm_store_si128(seen, first.seen_instances());
  _mm_store_si128(seen + 1, second.seen_instances());
}

/// Copies the part of a block that is inside the image.
template <class Pixel>
void copy_block(const Pixel* from, std::size_t rows, std::size_t columns, std::size_t width,
                Pixel* to) {
  static_assert(sizeof(Pixel) == 4);
  for (std::size_t row = 0; row < rows; ++row, from += kBlockWidth, to += width) {
    if (columns == kBlockWidth) {
      std::memcpy(to, from, kBlockWidth * sizeof(Pixel));
    } else {
      std::copy_n(from, columns, to);
    }
  }
}

}  // namespace

void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m) {
  render_depth(scene, camera, T_world_camera, depth_m, {});
}

void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m, std::span<std::uint32_t> instances) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  AB_CHECK(depth_m.size() == width * height, depth_m.size(), width, height);
  AB_CHECK(instances.empty() || instances.size() == depth_m.size(), instances.size());
  // Embree recommends it: denormal numbers would cost hundreds of cycles each.
  const ScopedFlushToZero flush;
  PrimaryRays rays(scene.internals(), camera, T_world_camera);
  const DepthRange range{_mm_set1_ps(static_cast<float>(camera.min_range_m)),
                         _mm_set1_ps(static_cast<float>(camera.max_range_m))};
  Block block;
  LastPlane last;
  for (int block_y = 0; block_y < rays.blocks_down(); ++block_y) {
    const std::size_t y = static_cast<std::size_t>(block_y) * kBlockHeight;
    const std::size_t rows = std::min<std::size_t>(kBlockHeight, height - y);
    for (int block_x = 0; block_x < rays.blocks_across(); ++block_x) {
      const std::size_t x = static_cast<std::size_t>(block_x) * kBlockWidth;
      const std::size_t columns = std::min<std::size_t>(kBlockWidth, width - x);
      rays.trace(block_x, block_y);
      for (std::size_t i = 0; i < embree::kStreamPackets; ++i) {
        read_packet(rays, i, rays.u() + x, rays.v() + y + kPacketHeight * i, range, last, block);
      }
      const std::size_t at = y * width + x;
      copy_block(block.depths, rows, columns, width, depth_m.data() + at);
      if (!instances.empty()) {
        copy_block(block.instances, rows, columns, width, instances.data() + at);
      }
    }
  }
}

}  // namespace avoidbench
