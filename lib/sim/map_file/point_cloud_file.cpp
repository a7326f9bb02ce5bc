#include "map_file/point_cloud_file.hpp"

namespace avoidbench {

std::string_view conversion_of(std::string_view extension) {
  if (extension == "laz") {
    return "convert it first, with 'pdal translate in.laz out.las' or 'laszip -i in.laz -o "
           "out.las'";
  }
  if (extension == "e57") {
    return "convert it first, with 'pdal translate in.e57 out.las' or CloudCompare";
  }
  if (extension == "ot") return "convert it first, with 'convert_octree in.ot out.bt'";
  return "";
}

FilePoints parse_point_cloud(std::string_view bytes, const std::string& file) {
  // The contents decide, not the file's name.
  if (is_las(bytes)) return parse_las_points(bytes, file);
  if (is_octree(bytes)) return parse_octree_points(bytes, file);
  if (is_full_octree(bytes)) {
    fail_file(file, "is an octree with probabilities (.ot): " + std::string(conversion_of("ot")));
  }
  if (bytes.starts_with("ASTM-E57")) {
    fail_file(file, "is an E57 file: " + std::string(conversion_of("e57")));
  }
  const std::string_view word = bytes.substr(0, bytes.find_first_of(" \t\r\n"));
  if (word == "ply") return parse_ply_points(bytes, file);
  const bool is_pcd = bytes.starts_with('#') || word == "VERSION" || word == "FIELDS";
  if (is_pcd) return parse_pcd_points(bytes, file);
  fail_file(file,
            "does not begin as one of PLY ('ply'), PCD ('# .PCD'), LAS ('LASF') and OctoMap's .bt "
            "('# Octomap OcTree binary file')");
}

}  // namespace avoidbench
