#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.hpp"

/// What readers of map files share.
namespace avoidbench {

/// The bytes of a file. Throws InputError where it can't be read, is empty or larger than
/// kMostFileBytes.
std::string read_map_file(const std::string& file);

/// The first bytes of a file, `count` of them or all. Throws InputError as read_map_file().
std::string first_bytes(const std::string& file, std::size_t count);

/// The SHA-256 of bytes already read, as file_digest() gives it.
std::string bytes_digest(std::string_view bytes);

/// An InputError that names the file, and the line where it is not 0.
[[noreturn]] void fail_file(const std::string& file, std::string message, int line = 0);

/// The file's name after its last dot, lower-case: "ply".
std::string extension_of(const std::string& file);

/// The endings of files of meshes and of point clouds. A PLY may be either.
const std::vector<std::string>& mesh_endings();
const std::vector<std::string>& cloud_endings();

/// What a map's file holds, by its ending; of a PLY by whether it has faces.
enum class MapFileKind { mesh, point_cloud, unknown };
MapFileKind map_file_kind(const std::string& file);

/// Positions as they stand in a file: its units, its axes.
using FilePoints = std::vector<Eigen::Vector3d>;

}  // namespace avoidbench
