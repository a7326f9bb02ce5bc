#include "map_file/point_cloud_file.hpp"

namespace avoidbench {

FilePoints parse_point_cloud(std::string_view bytes, const std::string& file) {
  // The contents decide, not the file's name.
  const std::string_view word = bytes.substr(0, bytes.find_first_of(" \t\r\n"));
  if (word == "ply") return parse_ply_points(bytes, file);
  const bool is_pcd = bytes.starts_with('#') || word == "VERSION" || word == "FIELDS";
  if (is_pcd) return parse_pcd_points(bytes, file);
  fail_file(file, "begins neither as a PLY file ('ply') nor as a PCD file ('# .PCD')");
}

}  // namespace avoidbench
