#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "map_file/map_file.hpp"

namespace avoidbench {

/// The boundary between voxels that hold a point and those that don't.
struct VoxelSurface {
  TriangleMesh mesh;                 ///< empty where there would be too many triangles
  std::uint64_t triangle_count = 0;  ///< also where the mesh is empty
  std::uint64_t voxel_count = 0;     ///< with a point in it
};

/// Voxel (i, j, k) is the cube [i, i + 1) × [j, j + 1) × [k, k + 1) · resolution_m. Only faces
/// between a full and an empty voxel become triangles; equal rows of faces in a plane are merged
/// to rectangles of two triangles each. Corners are counter-clockwise seen from the empty side. The
/// points' extent must be below 2^21 voxels; their order does not matter.
VoxelSurface voxel_surface(const FilePoints& points, double resolution_m,
                           std::uint64_t most_triangles);

/// Takes points one after another and keeps which voxels hold one: memory grows with the voxels,
/// not with the points.
class VoxelSieve {
 public:
  VoxelSieve(double resolution_m, std::size_t most_voxels);

  /// A point whose coordinates are within ±2^20 voxels. False once there are too many voxels.
  bool add(const Eigen::Vector3d& point);

  /// The voxels' centres, of which voxel_surface() makes what it makes of the points. Empty where
  /// there are too many.
  FilePoints centres();

 private:
  void sort();

  double resolution_m_;
  std::size_t most_voxels_, sort_at_;
  std::vector<std::uint64_t> cells_;  ///< packed; some twice until they are sorted
};

}  // namespace avoidbench
