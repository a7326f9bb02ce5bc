#pragma once

#include <vector>

#include "geometry/pose.hpp"
#include "render/camera.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {

/// A packet is 4 × 2 pixels, row by row; a block is four packets one below the other and is traced
/// as one stream. Of the shapes and widths tried (8 and 16 wide, streams of 1 to 16 packets in
/// rows, squares and columns) this is the fastest with AVX2: a fifth faster than single packets.
inline constexpr int kBlockWidth = 4;
inline constexpr int kPacketHeight = 2;
inline constexpr int kBlockHeight = kPacketHeight * static_cast<int>(embree::kStreamPackets);

/// The plane a·u + b·v + c = h/depth in a camera's frame, where (u, v, 1) is a pixel's ray.
struct PlaneInCamera {
  double a, b, c, h;
};

/// Depth of the plane at the pixel (u, v), as far as it agrees with Embree's.
inline float plane_depth(const PlaneInCamera& plane, double u, double v, float embree_depth) {
  const double row = plane.b * v + plane.c;
  const auto denominator = static_cast<float>(plane.a * u + row);
  return settled_distance(static_cast<float>(plane.h) / denominator, embree_depth);
}

/// The camera's rays of one frame, block by block. The ray's forward component is 1, so that its
/// parameter is depth. Pixels right of and below the image, where its size is not a multiple of the
/// block's, are traced with the rest. Embree's rays are float; u() and v() keep double for the
/// exact depth. Live only within a ScopedFlushToZero.
class PrimaryRays {
 public:
  /// `samples` > 1 gives an image of that many times the pixels each way, over the same view.
  PrimaryRays(const Scene::Internals& scene, const Pinhole& camera, const Pose& T_world_camera,
              int samples = 1);

  int blocks_across() const { return static_cast<int>(u_.size()) / kBlockWidth; }
  int blocks_down() const { return static_cast<int>(v_.size()) / kBlockHeight; }
  const double* u() const { return u_.data(); }  ///< one a column, padded to whole blocks
  const double* v() const { return v_.data(); }  ///< one a row, padded to whole blocks

  /// Traces one block and leaves its hits in packet(0) to packet(3).
  void trace(int block_x, int block_y);
  const RTCRayHit8& packet(std::size_t index) const { return packets_[index]; }

  /// Lane by lane: the hit's index into World::instances. Nothing of meaning where the lane hit
  /// nothing.
  const unsigned* instances(const RTCRayHit8& packet) const {
    return scene_.flattened ? packet.hit.geomID : packet.hit.instID[0];
  }

  PlaneInCamera plane(unsigned instance, unsigned triangle) const {
    const TrianglePlane& p = scene_.placements[instance].planes[triangle];
    const CameraAxes& camera = cameras_[scene_.flattened ? 0 : instance];
    return {p.nx * camera.right[0] + p.ny * camera.right[1] + p.nz * camera.right[2],
            p.nx * camera.down[0] + p.ny * camera.down[1] + p.nz * camera.down[2],
            p.nx * camera.forward[0] + p.ny * camera.forward[1] + p.nz * camera.forward[2],
            p.offset - (p.nx * camera.position[0] + p.ny * camera.position[1] +
                        p.nz * camera.position[2])};
  }

 private:
  struct CameraAxes {
    double right[3], down[3], forward[3], position[3];
  };

  const Scene::Internals& scene_;
  float range_m_;
  std::vector<double> u_, v_;
  std::vector<float> columns_[3],
      rows_[3];  ///< a ray's direction is its column's part plus its row's
  std::vector<CameraAxes>
      cameras_;  ///< in each prototype's frame, one an instance; one where flattened
  RTCRayHit8 packets_[embree::kStreamPackets];
};

}  // namespace avoidbench
