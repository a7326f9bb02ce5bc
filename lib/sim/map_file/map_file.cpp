#include "map_file/map_file.hpp"

#include <span>

#include "base/digest.hpp"
#include "base/input_file.hpp"
#include "base/words.hpp"

namespace avoidbench {

void fail_file(const std::string& file, std::string message, int line) {
  throw InputError(InputProblem{.file = file, .line = line, .message = std::move(message)});
}

std::string read_map_file(const std::string& file) {
  std::string bytes = read_input_file(file, kMostFileBytes);
  if (bytes.empty()) fail_file(file, "is empty");
  return bytes;
}

std::string first_bytes(const std::string& file, std::size_t count) {
  std::string bytes(count, '\0');
  bytes.resize(InputFile(file, kMostFileBytes).read(bytes));
  if (bytes.empty()) fail_file(file, "is empty");
  return bytes;
}

std::string bytes_digest(std::string_view bytes) {
  return Digest().add_bytes(std::as_bytes(std::span(bytes.data(), bytes.size()))).hex();
}

std::string extension_of(const std::string& file) {
  // Of the name alone: folders have dots, too.
  const std::size_t dot = file.find_last_of("./");
  if (dot == std::string::npos || file[dot] == '/') return "";
  std::string extension = file.substr(dot + 1);
  for (char& c : extension) {
    // std::tolower() would ask the locale.
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

const std::vector<std::string>& mesh_endings() {
  static const std::vector<std::string> endings{"obj", "ply", "stl", "glb", "gltf"};
  return endings;
}

const std::vector<std::string>& cloud_endings() {
  static const std::vector<std::string> endings{"ply", "pcd", "las", "bt"};
  return endings;
}

MapFileKind map_file_kind(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == "ply") {
    const std::string header = first_bytes(file, 4096);
    const std::size_t faces = header.find("\nelement face ");
    const bool has_faces =
        faces != std::string::npos && header.compare(faces, 16, "\nelement face 0\n") != 0;
    return has_faces ? MapFileKind::mesh : MapFileKind::point_cloud;
  }
  if (contains(mesh_endings(), extension)) return MapFileKind::mesh;
  return contains(cloud_endings(), extension) ? MapFileKind::point_cloud : MapFileKind::unknown;
}

}  // namespace avoidbench
