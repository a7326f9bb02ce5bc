#include <gtest/gtest.h>

#include <algorithm>

#include "base/input_error.hpp"
#include "support/map_files.hpp"
#include "world/map_spec.hpp"
#include "world/mesh_file.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

using test::TemporaryFolder;

/// 2 m × 3 m × 4 m, from (1, 2, 3).
TriangleMesh brick_mesh() {
  Prototype box;
  add_box(box, {1, 2, 3}, {3, 5, 7}, Material::brick);
  return box.mesh;
}

MeshSpec spec_of(const std::string& file) {
  MeshSpec spec;
  spec.file = file;
  spec.flight_height_m = 1.0;
  return spec;
}

using Corners = std::array<std::array<float, 3>, 3>;

/// The world's triangles, each from its lowest corner, sorted.
std::vector<Corners> triangles_of(const World& world) {
  std::vector<Corners> all;
  for (const Instance& instance : world.instances) {
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    for (const auto& triangle : mesh.triangles) {
      Corners corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f v = instance.T_world_prototype * mesh.vertices[triangle[k]];
        corners[k] = {v.x(), v.y(), v.z()};
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.push_back(corners);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// By the divergence theorem; positive where corners are counter-clockwise seen from outside.
double volume_m3(const World& world) {
  double six_volumes = 0.0;
  for (const Corners& t : triangles_of(world)) {
    const auto corner = [&](std::size_t k) {
      return Eigen::Vector3f(t[k][0], t[k][1], t[k][2]).cast<double>().eval();
    };
    six_volumes += corner(0).dot(corner(1).cross(corner(2)));
  }
  return six_volumes / 6.0;
}

std::string message_of(const MapSpec& spec) {
  try {
    make_world(spec, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeshMap, every_format_gives_the_same_triangles) {
  const TemporaryFolder folder;
  std::vector<Corners> first;
  for (const auto& [name, bytes] : test::all_meshes(brick_mesh())) {
    const World world = make_world(spec_of(folder.write(name, bytes)), 1);
    EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(1, 2, 3)) << name;
    EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(3, 5, 7)) << name;
    EXPECT_EQ(volume_m3(world), 24.0) << name;
    ASSERT_EQ(world.prototypes.size(), 1U) << name;
    EXPECT_EQ(world.prototypes[0].mesh.vertices.size(), 8U) << name << ": not welded";
    const std::vector<Corners> triangles = triangles_of(world);
    EXPECT_EQ(triangles.size(), 12U) << name;
    if (first.empty()) first = triangles;
    EXPECT_EQ(triangles, first) << name;
    EXPECT_EQ(make_world(spec_of((folder.path / name).string()), 7).digest, world.digest) << name;
  }
}

TEST(MeshMap, names_become_kinds_and_materials) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.obj", "a.glb"}) {
    const TriangleMesh mesh = brick_mesh();
    const std::string bytes =
        name == "a.obj" ? test::obj_bytes(mesh) : test::gltf_bytes(mesh, true);
    const World world = make_world(spec_of(folder.write(name, bytes)), 1);
    EXPECT_EQ(world.obstacles[0].kind, "pillar");
    EXPECT_EQ(world.prototypes[0].triangle_materials[0], Material::brick);
  }
  MeshSpec spec = spec_of(folder.write("a.stl", test::binary_stl_bytes(brick_mesh())));
  spec.material = Material::bark;
  EXPECT_EQ(make_world(spec, 1).prototypes[0].triangle_materials[0], Material::bark);
  EXPECT_EQ(obstacle_kind("Wall_03.001"), "wall");
  EXPECT_EQ(obstacle_kind("Floor"), "ground");
  EXPECT_EQ(obstacle_kind("roof.2"), "ceiling");
  EXPECT_EQ(obstacle_kind("  \xe5\xa2\x99 12"), "mesh");
}

TEST(MeshMap, up_axes_turn_and_scale_grows_without_mirroring) {
  const TemporaryFolder folder;
  MeshSpec spec = spec_of(folder.write("a.obj", test::obj_bytes(brick_mesh())));
  spec.scale = 0.5;
  spec.up_axis = UpAxis::y;  // (x, y, z) becomes (x, -z, y)
  World world = make_world(spec, 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(0.5, -3.5, 1.0));
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(1.5, -1.5, 2.5));
  EXPECT_EQ(volume_m3(world), 3.0);
  spec.up_axis = UpAxis::x;  // becomes (y, z, x)
  spec.scale = 2.0;
  spec.origin_m = {4.0, 6.0, 1.0};
  world = make_world(spec, 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(6.0, 8.0, 5.0));
  EXPECT_EQ(volume_m3(world), 192.0);
}

TEST(MeshMap, node_transforms_are_applied_and_mirrored_nodes_stay_inside_out_never) {
  const TemporaryFolder folder;
  const std::string node = ",\"translation\":[10,0,-1],\"scale\":[-1,1,2]";
  const World world =
      make_world(spec_of(folder.write("a.glb", test::gltf_bytes(brick_mesh(), true, node))), 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(7.0, 2.0, 5.0));
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(9.0, 5.0, 13.0));
  EXPECT_EQ(volume_m3(world), 48.0);
}

TEST(MeshMap, polygons_are_cut_and_flat_triangles_left_out) {
  const TemporaryFolder folder;
  const std::string text =
      "o slab\nv 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 0\nv 0 0 2\nv 3 0 0\nf 1 2 3 4\nf 1 2 5\n"
      "f 1 6 2\no line\nl 1 2\n";
  const World world = make_world(spec_of(folder.write("a.obj", text)), 1);
  EXPECT_EQ(triangle_count(world), 3U);
  EXPECT_EQ(world.obstacles.size(), 1U);
}

TEST(MeshMap, regions_are_bands_or_as_given) {
  const TemporaryFolder folder;
  MeshSpec spec = spec_of(folder.write("a.stl", test::binary_stl_bytes(brick_mesh())));
  spec.bounds = {{0, 0, 0}, {20, 40, 8}};
  World world = make_world(spec, 1);
  EXPECT_EQ(world.start_region.lowest, Eigen::Vector3d(2, 1, 1));
  EXPECT_EQ(world.start_region.highest, Eigen::Vector3d(18, 6, 1));
  EXPECT_EQ(world.goal_region.lowest, Eigen::Vector3d(2, 34, 1));
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(18, 39, 1));
  spec.goal_region = {{1, 2, 3}, {4, 5, 6}};
  world = make_world(spec, 1);
  EXPECT_EQ(world.goal_region.highest, Eigen::Vector3d(4, 5, 6));
}

TEST(MeshMap, what_is_wrong_is_told_with_the_files_name) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& bytes) {
    return message_of(spec_of(folder.write(name, bytes)));
  };
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(message_of(spec_of((folder.path / "none.obj").string())), "none.obj: no such file");
  expect(message_of(spec_of(folder.path.string() + "/a.fbx")), "'fbx' is none of obj, ply");
  expect(message_of(MeshSpec{}), "file: is not given");
  expect(message("empty.obj", ""), "empty.obj: is empty");
  expect(message("points.obj", "v 0 0 0\nv 1 0 0\n"), "points.obj: ");
  expect(message("words.ply", "once upon a time"), "words.ply: can't be read as a mesh");
  expect(message("nan.obj", "v nan 0 0\nv 5 0 0\nv 0 5 0\nf 1 2 3\n"), "is not finite");
  expect(message("flat.obj", "v 0 0 0\nv 5 0 0\nv 9 0 0\nf 1 2 3\n"), "no triangle with an area");
  expect(message("floor.obj", "v 0 0 0\nv 5 0 0\nv 0 5 0\nf 1 2 3\n"), "give bounds");
  expect(message("millimetres.obj", "v 0 0 0\nv 5000 0 0\nv 0 5 0\nf 1 2 3\n"),
         "5000 × 5 × 0 m, more than 2000 m: if its unit is not the metre, set scale");
  expect(message("small.obj", "v 0 0 0\nv 0.5 0 0\nv 0 0.1 0\nf 1 2 3\n"), "less than 1 m");
  expect(message("far.obj", "v 500000 0 0\nv 500050 0 0\nv 500000 50 0\nf 1 2 3\n"),
         "[500000, 0, 0]: set origin_m");
  std::string cut = test::binary_stl_bytes(brick_mesh());
  cut.resize(cut.size() - 100);
  expect(message("cut.stl", cut), "cut.stl: can't be read as a mesh");
  expect(message("outside.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":4,"
                 "\"uri\":\"a.bin\"}]}"),
         "outside.gltf: ");
  MeshSpec spec = spec_of(folder.write("a.obj", test::obj_bytes(brick_mesh())));
  spec.goal_region = {{0, 0, 0}, {1, 1, 1}};
  expect(message_of(spec), "a.obj: goal_region: [0, 0, 0] to [1, 1, 1] is not within the bounds");
  spec.bounds = {{5, 5, 5}, {9, 9, 9}};
  expect(message_of(spec), "goal_region: is not within bounds");
  spec.bounds = {{5, 5}, {9, 9, 9}};
  expect(message_of(spec), "bounds.lowest_m: expected [x, y, z]");
  spec = spec_of(folder.write("a.obj", test::obj_bytes(brick_mesh())));
  spec.file_digest = std::string(64, '0');
  expect(message_of(spec), "a.obj: is not the file it was");
}

TEST(MeshMap, damaged_files_end_in_an_error_or_a_world) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : test::all_meshes(brick_mesh())) {
    for (std::size_t size = 1; size < bytes.size(); size += 7) {
      message_of(spec_of(folder.write(name, bytes.substr(0, size))));
    }
    for (std::size_t at = 0; at < bytes.size(); at += 5) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
      message_of(spec_of(folder.write(name, damaged)));
    }
  }
}

}  // namespace
}  // namespace avoidbench
