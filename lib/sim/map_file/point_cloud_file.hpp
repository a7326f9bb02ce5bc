#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "map_file/map_file.hpp"

/// Readers of point clouds. They take any bytes: what is wrong is told, nothing is believed before
/// the bytes are there.
namespace avoidbench {

/// The finite points of a file, in the file's order, units and axes:
/// - PLY: ascii, binary_little_endian, binary_big_endian; properties x, y and z of the element
///   vertex, of any type;
/// - PCD: ascii, binary, binary_compressed;
/// - LAS 1.2 to 1.4, as read_las_points() reads it;
/// - OctoMap's .bt: the centres of occupied voxels, all those of a larger leaf.
/// Which it is is seen from its first bytes. Points with a number that is not finite (no return)
/// are left out. `file` is for messages. Throws InputError; for LAZ, E57 and OctoMap's .ot it says
/// what converts them.
FilePoints parse_point_cloud(std::string_view bytes, const std::string& file);

/// The kinds: what parse_point_cloud() calls.
FilePoints parse_ply_points(std::string_view bytes, const std::string& file);
FilePoints parse_pcd_points(std::string_view bytes, const std::string& file);
FilePoints parse_las_points(std::string_view bytes, const std::string& file);
FilePoints parse_octree_points(std::string_view bytes, const std::string& file);

/// The most voxels of a map whose file may hold far more points, or few bytes for many voxels.
inline constexpr std::size_t kMostVoxels = 4'000'000;

/// Above any octree of kMostVoxels that maps free space, too.
inline constexpr std::uint64_t kMostOctreeBytes = 100'000'000;

/// Fills the bytes with what comes next in a file and returns how many there were, as
/// InputFile::read() does: fewer only at the end.
using ByteReader = std::function<std::size_t(std::span<char>)>;

using PointTaker = std::function<void(const Eigen::Vector3d&)>;

/// Gives `take` the finite points of a LAS file, one after another, and holds no more than 2 MB of
/// it. LAS 1.2 to 1.4 with points of formats 0 to 10 and bytes of others behind each; points that
/// are flagged as withheld are left out. Throws InputError, naming `file`.
void read_las_points(const ByteReader& read, const std::string& file, const PointTaker& take);

/// What a file is by its first bytes; 32 suffice.
bool is_las(std::string_view bytes);
bool is_octree(std::string_view bytes);       ///< OctoMap's .bt
bool is_full_octree(std::string_view bytes);  ///< OctoMap's .ot

/// The side of a voxel of an OctoMap .bt file, in its unit. Throws InputError.
double octree_resolution(std::string_view bytes, const std::string& file);

/// How to make a file that is read of one with this extension ("laz", "e57", "ot"); else "".
std::string_view conversion_of(std::string_view extension);

}  // namespace avoidbench
