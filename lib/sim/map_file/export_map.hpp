#pragma once

#include <filesystem>

#include "world/voxels.hpp"

/// Maps as files for other programs. World frame: ENU, z up, metres; only glTF, which is y up by
/// definition, has its scene turned. Each throws InputError where the file can't be written or its
/// name has none of the endings.
namespace avoidbench {

/// All triangles: .glb (one mesh a prototype, an instance a node), .obj, .ply or .stl (flattened).
void export_mesh(const World& world, const std::filesystem::path& file);

/// The centres of the occupied cells as a binary .ply point cloud: what the original computes its
/// map metrics from.
void export_point_cloud(const VoxelGrid& grid, const std::filesystem::path& file);

/// The cells as a NumPy array (.npy, uint8, shape layers × rows × columns: z, y, x) and, beside it
/// in a file with .json added to the name, the array's lowest corner and the size of a cell.
void export_occupancy(const VoxelGrid& grid, const std::filesystem::path& file);

}  // namespace avoidbench
