#pragma once

#include <string>
#include <string_view>

#include "map_file/map_file.hpp"

/// Readers of point clouds. They take any bytes: what is wrong is told, nothing is believed before
/// the bytes are there.
namespace avoidbench {

/// The finite points of a PLY file (ascii, binary_little_endian, binary_big_endian; properties x, y
/// and z of the element vertex, of any type) or a PCD file (ascii, binary, binary_compressed), in
/// the file's order, units and axes. Which it is is seen from its first bytes. Points with a number
/// that is not finite (no return) are left out. `file` is for messages. Throws InputError.
FilePoints parse_point_cloud(std::string_view bytes, const std::string& file);

/// The two kinds: what parse_point_cloud() calls.
FilePoints parse_ply_points(std::string_view bytes, const std::string& file);
FilePoints parse_pcd_points(std::string_view bytes, const std::string& file);

}  // namespace avoidbench
