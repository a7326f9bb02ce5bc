#pragma once

#include <cstdint>
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
    return scene_.map->flattened ? packet.hit.geomID : packet.hit.instID[0];
  }

  PlaneInCamera plane(unsigned instance, unsigned triangle) const {
    return seen_by(cameras_[camera_of(instance, scene_.flattened_count)],
                   scene_.planes_of[instance][triangle]);
  }

  /// In the frames of planes: see camera_of().
  const std::vector<CameraAxes>& cameras() const { return cameras_; }

 private:
  void find_mover_blocks(const Pose& T_world_camera);
  void trace_movers();

  const Scene::Internals& scene_;
  float range_m_;
  std::vector<double> u_, v_;
  std::vector<float> columns_[3],
      rows_[3];  ///< a ray's direction is its column's part plus its row's
  std::vector<CameraAxes> cameras_;
  std::vector<std::uint8_t> mover_blocks_;  ///< 1: a mover may be in it; empty: there are none
  RTCRayHit8 packets_[embree::kStreamPackets];
};

}  // namespace avoidbench
