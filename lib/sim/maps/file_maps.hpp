#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "world/world.hpp"

/// Maps that come from files: a triangle mesh, or a point cloud turned into voxels. Positions in
/// specs are in the world frame, metres, after scale, up_axis and origin_m.
namespace avoidbench {

/// The axis of a file that points up. The others follow by turning, so that nothing is mirrored:
/// file (x, y, z) becomes world (x, y, z), (x, -z, y) or (y, z, x).
enum class UpAxis { z, y, x };

template <>
struct EnumText<UpAxis> {
  static constexpr std::pair<UpAxis, std::string_view> entries[] = {
      {UpAxis::z, "z"}, {UpAxis::y, "y"}, {UpAxis::x, "x"}};
};

/// An upright box; both corners empty where the user leaves it to the program.
struct BoxSpec {
  std::vector<double> lowest_m, highest_m;  ///< 3 numbers or none
  bool is_given() const { return !lowest_m.empty() || !highest_m.empty(); }
};

template <class Visitor, ConstOr<BoxSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("lowest_m", s.lowest_m, Range{-10000, 10000}, "Corner [x, y, z]; []: computed.");
  v.field("highest_m", s.highest_m, Range{-10000, 10000}, "Corner [x, y, z]; []: computed.");
}

/// A triangle mesh: OBJ, PLY, STL, GLB, or glTF with its buffers inside.
struct MeshSpec {
  static constexpr std::string_view kind = "mesh";
  static constexpr std::string_view doc = "A triangle mesh from a file: OBJ, PLY, STL, GLB, glTF.";
  std::string file;         ///< absolute once a sweep file is read; not part of a trial's key
  std::string file_digest;  ///< SHA-256 of the file; part of a trial's key. "": any file will do
  double scale = 1.0;
  UpAxis up_axis = UpAxis::z;
  std::array<double, 3> origin_m{0.0, 0.0, 0.0};
  BoxSpec bounds, start_region, goal_region;
  double flight_height_m = 2.0;
  Material material = Material::concrete;
};

/// A point cloud, PLY, PCD, LAS or OctoMap's .bt, as the surface of the voxels that hold a point.
struct PointCloudSpec {
  static constexpr std::string_view kind = "point_cloud";
  static constexpr std::string_view doc =
      "A point cloud from a file as voxels: PLY, PCD, LAS, OctoMap bt.";
  std::string file;         ///< as in MeshSpec
  std::string file_digest;  ///< as in MeshSpec
  double resolution_m = 0.2;
  double scale = 1.0;
  UpAxis up_axis = UpAxis::z;
  std::array<double, 3> origin_m{0.0, 0.0, 0.0};
  BoxSpec bounds, start_region, goal_region;
  double flight_height_m = 2.0;
  Material material = Material::concrete;
};

template <class Visitor, class FileSpec>
void visit_file_fields(Visitor& v, FileSpec& s) {
  v.field("file_digest", s.file_digest,
          "SHA-256 of the file, filled in; where given, the file must have it.");
  v.field("scale", s.scale, Range{1e-6, 1e6}, "Metres in one unit of the file.");
  v.field("up_axis", s.up_axis, "The file's axis that points up; y for most glTF and OBJ files.");
  v.field("origin_m", s.origin_m, Range{-1e8, 1e8},
          "Point, after scale and up_axis, that becomes the world's origin; for map coordinates.");
  v.field("bounds", s.bounds, "Box of flight; leaving it ends a flight. []: that of the file.");
  v.field(
      "start_region", s.start_region,
      "Box of starts. []: a band at the low end of y, flight_height_m above the bounds' floor.");
  v.field("goal_region", s.goal_region, "Box of goals. []: as start_region, at the high end of y.");
  v.field("flight_height_m", s.flight_height_m, Range{0.3, 1000},
          "Height of starts and goals above the bounds' floor where no region is given.");
}

template <class Visitor, ConstOr<MeshSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("file", s.file, "OBJ, PLY, STL, GLB or glTF file; relative to the sweep file's folder.");
  visit_file_fields(v, s);
  v.field("material", s.material,
          "Look of surfaces whose material in the file is not one of these.");
}

template <class Visitor, ConstOr<PointCloudSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("file", s.file, "PLY, PCD, LAS or OctoMap bt file; relative to the sweep file's folder.");
  v.field("resolution_m", s.resolution_m, Range{0.01, 10},
          "Side of a voxel: solid where it holds a point.");
  visit_file_fields(v, s);
  v.field("material", s.material, "Look of the surface.");
}

/// Adds what contradicts itself in the spec, each as "field: what is wrong", to `problems`. Does
/// not look at the file.
void find_problems(const MeshSpec& spec, std::vector<std::string>& problems);
void find_problems(const PointCloudSpec& spec, std::vector<std::string>& problems);

/// The map in the file. Throws InputError, naming the file, where it can't be read, has another
/// digest than the spec's, holds no or too many triangles, numbers that are not finite or an extent
/// that is no map's in metres, or where the regions are not in the bounds.
World make_mesh(const MeshSpec& spec);

/// The map of the cloud's voxels, whose corners are at whole multiples of resolution_m. Points
/// that are not finite or outside the given bounds are left out. Of a LAS file memory takes what
/// its voxels need, kMostVoxels at most. Throws InputError as make_mesh(); also where resolution_m
/// is finer than the voxels of an octree.
World make_point_cloud(const PointCloudSpec& spec);

}  // namespace avoidbench
