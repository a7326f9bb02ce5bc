#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/input_error.hpp"
#include "base/poll.hpp"
#include "map_file/export_map.hpp"
#include "map_file/mesh_file.hpp"
#include "maps/map_spec.hpp"
#include "support/input_error_message.hpp"
#include "support/map_files.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

using test::raw;
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

Eigen::Vector3d corner(const Corners& triangle, std::size_t k) {
  return Eigen::Vector3f(triangle[k][0], triangle[k][1], triangle[k][2]).cast<double>();
}

/// By the divergence theorem; positive where corners are counter-clockwise seen from outside.
double volume_m3(const World& world) {
  double six_volumes = 0.0;
  for (const Corners& t : triangles_of(world)) {
    six_volumes += corner(t, 0).dot(corner(t, 1).cross(corner(t, 2)));
  }
  return six_volumes / 6.0;
}

/// Rounded to 0.01 m².
std::map<Material, long> area_by_material_m2(const World& world) {
  std::map<Material, double> sums;
  for (const Instance& instance : world.instances) {
    const Prototype& prototype = world.prototypes[instance.prototype];
    for (std::size_t i = 0; i < prototype.mesh.triangles.size(); ++i) {
      std::array<Eigen::Vector3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& v = prototype.mesh.vertices[prototype.mesh.triangles[i][k]];
        p[k] = (instance.T_world_prototype * v).cast<double>();
      }
      sums[prototype.triangle_materials[i]] += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    }
  }
  std::map<Material, long> rounded;
  for (const auto& [material, sum] : sums) rounded[material] = std::lround(100.0 * sum);
  return rounded;
}

std::string message_of(const MapSpec& spec) {
  return test::message_of([&] { make_world(spec, 1); });
}

TEST(MeshMap, EveryFormatGivesTheSameTriangles) {
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
    EXPECT_EQ(make_world(spec_of((folder.path() / name).string()), 7).digest, world.digest) << name;
  }
}

TEST(MeshMap, EveryReaderAsksWhetherToGoOn) {
  for (const auto& [name, bytes] : test::all_meshes(brick_mesh())) {
    const PollScope scope([] { throw std::runtime_error("enough"); });
    EXPECT_THROW(parse_mesh(bytes, name, Material::brick, 100), std::runtime_error) << name;
  }
}

TEST(MeshMap, NamesBecomeKindsAndMaterials) {
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

TEST(MeshMap, UpAxesTurnAndScaleGrowsWithoutMirroring) {
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

TEST(MeshMap, NodeTransformsAreAppliedAndMirroredNodesAreNotInsideOut) {
  const TemporaryFolder folder;
  const std::string node = ",\"translation\":[10,0,-1],\"scale\":[-1,1,2]";
  const World world =
      make_world(spec_of(folder.write("a.glb", test::gltf_bytes(brick_mesh(), true, node))), 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(7.0, 2.0, 5.0));
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(9.0, 5.0, 13.0));
  EXPECT_EQ(volume_m3(world), 48.0);
}

TEST(MeshMap, PolygonsAreCutAndFlatTrianglesLeftOut) {
  const TemporaryFolder folder;
  const std::string text =
      "o slab\nv 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 0\nv 0 0 2\nv 3 0 0\nf 1 2 3 4\nf 1 2 5\n"
      "f 1 6 2\no line\nl 1 2\n";
  const World world = make_world(spec_of(folder.write("a.obj", text)), 1);
  EXPECT_EQ(triangle_count(world), 3U);
  EXPECT_EQ(world.obstacles.size(), 1U);
}

TEST(MeshMap, RegionsAreBandsOrAsGiven) {
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

/// What make_world() says of a file of this name and content; "FILE" stands for its path.
std::string message_of_file(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, bytes);
  std::string text = message_of(spec_of(file));
  const std::size_t at = text.find(file);
  return at == std::string::npos ? text : text.replace(at, file.size(), "FILE");
}

TEST(MeshMap, WrongObjFilesAreReportedWithTheirLine) {
  const auto message = [](const std::string& text) { return message_of_file("a.obj", text); };
  const std::string triangle = "v 0 0 0\nv 5 0 0\nv 0 5 0\n";
  EXPECT_EQ(message(""), "FILE: is empty");
  EXPECT_EQ(message("v 0 0 0\nv 1 0 0\n"), "FILE: has no triangles");
  EXPECT_EQ(message("once upon a time\n"), "FILE: has no triangles");
  EXPECT_EQ(message("v 0 0 0\nv nan 0 0\n"), "FILE:2: vertex: 'nan' is not finite");
  EXPECT_EQ(message("v 0 0 0\nv 0 1e39 0\n"), "FILE:2: vertex: '1e39' is not finite");
  EXPECT_EQ(message("v 0 0\n"), "FILE:1: too few numbers");
  EXPECT_EQ(message("v 0 0 0x\n"), "FILE:1: '0x' is not a number");
  EXPECT_EQ(message("v 0 0 0 2\n"), "FILE:1: a vertex's w is not 1");
  EXPECT_EQ(message(triangle + "f 1 2\n"), "FILE:4: a face of fewer than 3 corners");
  EXPECT_EQ(message(triangle + "f 1 2 4\n"),
            "FILE:4: the face names vertex 4; up to here there are 3");
  EXPECT_EQ(message(triangle + "f 1 2 -4\n"),
            "FILE:4: the face names vertex -4; up to here there are 3");
  EXPECT_EQ(message(triangle + "f 1 2 0\n"),
            "FILE:4: the face names vertex 0; up to here there are 3");
  EXPECT_EQ(message(triangle + "f 1 2 three\n"), "FILE:4: 'three' is not a corner of a face");
  EXPECT_EQ(message(triangle + "f 1 2 \\\n3\n"),
            "FILE:4: lines continued with \\ are not supported");
  std::string polygon = triangle + "f";
  for (int i = 0; i < 1001; ++i) polygon += " 1";
  EXPECT_EQ(message(polygon),
            "FILE:4: a face of more than 1000 corners; cut it into triangles first");
}

TEST(MeshMap, MapsThatAreNoneInMetresAreReportedWithWhatToSet) {
  const auto message = [](const std::string& second, const std::string& third) {
    return message_of_file("a.obj", "v 0 0 0\nv " + second + "\nv " + third + "\nf 1 2 3\n");
  };
  EXPECT_EQ(message("5 0 0", "9 0 0"), "FILE: has no triangle with an area above 0");
  EXPECT_EQ(message("5 0 0", "0 5 0"), "FILE: its own box is only 5 × 5 × 0 m: give bounds");
  EXPECT_EQ(message("40000 0 0", "0 5 0"),
            "FILE: spans 40000 × 5 × 0 m, more than 2000 m: if its unit is not the metre, set "
            "scale (0.001 for millimetres, 0.01 for centimetres, 0.3048 for feet)");
  EXPECT_EQ(message("0.5 0 0", "0 0.1 0"),
            "FILE: spans 0.5 × 0.1 × 0 m, less than 1 m: set scale, the metres in one unit of the "
            "file");
  EXPECT_EQ(message_of_file("a.obj", "v 500000 0 0\nv 500050 0 0\nv 500000 50 9\nf 1 2 3\n"),
            "FILE: lies more than 10 km from its origin, at [500000, 0, 0]: set origin_m near "
            "there");
}

TEST(MeshMap, AMapThatLiesOnItsSideIsReportedWithTheAxisToSet) {
  const TemporaryFolder folder;
  // 20 m × 30 m and 4 m high, y up.
  MeshSpec spec = spec_of(folder.write("a.obj", "v 0 0 0\nv 20 0 0\nv 20 4 -30\nf 1 2 3\n"));
  EXPECT_EQ(message_of(spec),
            spec.file +
                ": spans 20 × 4 × 30 m, far higher than it is long, with up_axis: z: if the "
                "file's y axis points up, as in most glTF and OBJ files, set up_axis: y, "
                "else give bounds");
  spec.bounds = {{0, 0, -30}, {20, 4, 0}};
  EXPECT_EQ(message_of(spec), "");
  spec.bounds = {{0, 0, 0}, {20, 30, 4}};
  EXPECT_EQ(message_of(spec),
            spec.file +
                ": is hardly within bounds with up_axis: z: it spans [0, 0, -30] to [20, 4, "
                "0] m; with up_axis: y it fits, so set that");
  spec.up_axis = UpAxis::y;
  EXPECT_EQ(message_of(spec), "");
  spec.bounds = {};
  EXPECT_EQ(message_of(spec), "");
  spec.bounds = {{5, 5, 1}, {7, 7, 3}};  // a small piece: no axis fits better
  spec.up_axis = UpAxis::z;
  EXPECT_EQ(message_of(spec), "");

  // The same with z up, moved, in centimetres.
  spec.file = folder.write("b.obj", "v 100 0 0\nv 2100 0 0\nv 2100 3000 400\nf 1 2 3\n");
  spec.scale = 0.01;
  spec.origin_m = {1, 0, 0};
  spec.bounds = {{0, 0, 0}, {20, 30, 4}};
  EXPECT_EQ(message_of(spec), "");
  spec.up_axis = UpAxis::y;
  EXPECT_EQ(message_of(spec),
            spec.file +
                ": is hardly within bounds with up_axis: y: it spans [0, -4, 0] to [20, 0, "
                "30] m; with up_axis: z it fits, so set that");
  spec.up_axis = UpAxis::x;
  EXPECT_EQ(message_of(spec),
            spec.file +
                ": is hardly within bounds with up_axis: x: it spans [-1, 0, 1] to [29, 4, "
                "21] m; with up_axis: z it fits, so set that");
}

TEST(MeshMap, WrongStlFiles) {
  const auto message = [](const std::string& bytes) { return message_of_file("a.stl", bytes); };
  const std::string binary = test::binary_stl_bytes(brick_mesh());
  EXPECT_EQ(message(binary.substr(0, binary.size() - 100)),
            "FILE: is truncated or no STL: it promises 12 triangles, 684 bytes, and has 584");
  EXPECT_EQ(message(binary.substr(0, 83)), "FILE: is truncated: an STL file has 84 bytes at least");
  EXPECT_EQ(message(std::string(80, ' ') + raw(0U)), "FILE: has no triangles");
  std::string infinite = binary;
  infinite.replace(84 + 50 + 12, 4, raw(std::numeric_limits<float>::infinity()));
  EXPECT_EQ(message(infinite), "FILE: triangle 2 at byte 134: a vertex is not finite");
  const std::string ascii = test::ascii_stl_bytes(brick_mesh());
  EXPECT_EQ(message(ascii.substr(0, ascii.rfind("endsolid"))),
            "FILE:85: is truncated: it does not end with 'endsolid'");
  EXPECT_EQ(message("solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 nan\n"),
            "FILE:5: vertex: 'nan' is not finite");
  EXPECT_EQ(message("solid a\nfacet\nvertex 0 0 0\nendfacet\n"), "FILE:4: a facet of 1 vertices");
  EXPECT_EQ(message("solid a\nvertex 0 0 0\n"), "FILE:2: one vertex too many");
  EXPECT_EQ(message("solid a\nfacet\nfacet\n"), "FILE:3: the facet before does not end");
  EXPECT_EQ(message("solid a\ncube 3\n"), "FILE:2: 'cube' is not a word of an STL file");
}

TEST(MeshMap, WrongPlyFiles) {
  const auto message = [](const std::string& bytes) { return message_of_file("a.ply", bytes); };
  const auto head = [](const std::string& vertices, const std::string& faces) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_index\nend_header\n";
  };
  EXPECT_EQ(message("once upon a time"), "FILE:1: does not begin as a PLY file ('ply')");
  EXPECT_EQ(message(head("3", "0") + "0 0 0\n5 0 0\n0 5 0\n"),
            "FILE: has no triangles; for a cloud of points use generator: point_cloud");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 nan\n"), "FILE:11: vertex 1 is not finite");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 0\n"),
            "FILE:11: is truncated: the header promises 3 of 'vertex', there are 2");
  EXPECT_EQ(message(head("9999999999", "1")),
            "FILE: has more than 15000000 vertices, three for each of the most triangles; decimate "
            "it first");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 0\n0 5 0\n3 0 1 3\n"),
            "FILE:13: face 0 names a vertex that does not exist");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 0\n0 5 0\n3 0 1 -1\n"),
            "FILE:13: face 0 names a vertex that does not exist");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 0\n0 5 0\n200 0 1 2\n"),
            "FILE:13: too few numbers");
  EXPECT_EQ(message(head("3", "1") + "0 0 0\n5 0 0\n0 5 0\n2 0 1\n"), "FILE: has no triangles");
  const std::string binary = test::binary_ply_bytes(brick_mesh(), true);
  EXPECT_EQ(message(binary.substr(0, binary.size() - 1)),
            "FILE: is truncated: the header promises 12 of 'face', there are 11");
}

TEST(MeshMap, WrongGltfFiles) {
  const TriangleMesh mesh = brick_mesh();
  const std::string good = test::gltf_bytes(mesh, false);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return message_of_file("a.gltf", text.replace(at, from.size(), to));
  };
  EXPECT_EQ(message_of_file("a.gltf", good.substr(0, 50)),
            "FILE: is not glTF: its JSON ends or is wrong at byte 51");
  EXPECT_EQ(message_of_file("a.gltf", "[]"), "FILE: is not glTF: its JSON is not an object");
  EXPECT_EQ(message_of_file("a.gltf", "66666E33333"),
            "FILE: is not glTF: a number of its JSON is too large");
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_EQ(message_of_file("a.gltf", "{\"asset\":" + deep + "}"),
            "FILE: is not glTF of version 2");
  EXPECT_EQ(with("\"nodes\":[0]", "\"nodes\":[" + deep + "]"),
            "FILE: a scene's node is not a whole number");
  EXPECT_EQ(with("\"VEC3\"", deep), "FILE: accessors[0] is no VEC3");
  EXPECT_EQ(with("2.0", "1.0"), "FILE: is not glTF of version 2");
  EXPECT_EQ(with("data:application", "http://application"),
            "FILE: buffers[0] is in another file, 'http://application/octet-stream;base64,A…': "
            "buffers must be inside the file; export it as .glb");
  EXPECT_EQ(with("base64,A", "base64,%"), "FILE: buffers[0] is not base64");
  EXPECT_EQ(with("\"byteLength\":240", "\"byteLength\":999"),
            "FILE: is truncated: buffers[0] has 999 bytes, there are 240");
  EXPECT_EQ(with("\"byteOffset\":96", "\"byteOffset\":97"),
            "FILE: accessors[1]: its bufferView is not within its buffer");
  EXPECT_EQ(with("\"count\":8", "\"count\":9"), "FILE: accessors[0] is not within its bufferView");
  EXPECT_EQ(with("\"count\":8", "\"count\":-1"), "FILE: count is not a whole number");
  EXPECT_EQ(with("\"count\":8", "\"count\":7"), "FILE: meshes[0]: an index names no vertex");
  EXPECT_EQ(with("5126", "5123"), "FILE: accessors[0]: positions must be float");
  EXPECT_EQ(with("\"nodes\":[0]", "\"nodes\":[1]"), "FILE: nodes[1] is missing");
  EXPECT_EQ(with("\"mesh\":0", "\"mesh\":0,\"children\":[0]"),
            "FILE: nodes[0] is below two others or below itself");
  EXPECT_EQ(with("\"mesh\":0", "\"mesh\":0,\"scale\":[1,1]"), "FILE: a node's scale is wrong");
  EXPECT_EQ(with("\"material\":0", "\"material\":3"), "FILE: materials[3] is missing");
  EXPECT_EQ(with("\"indices\":1", "\"mode\":1"), "FILE: has no triangles");

  const std::string glb = test::gltf_bytes(mesh, true);
  const std::string size = std::to_string(glb.size());
  EXPECT_EQ(message_of_file("a.glb", glb.substr(0, 19)),
            "FILE: is truncated: a .glb file has 20 bytes at least");
  EXPECT_EQ(message_of_file("a.glb", glb.substr(0, glb.size() - 1)),
            "FILE: is truncated: it promises " + size + " bytes and has " +
                std::to_string(glb.size() - 1));
  TriangleMesh bad = mesh;
  bad.vertices[3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message_of_file("a.glb", test::gltf_bytes(bad, true)),
            "FILE: accessors[0]: vertex 3 is not finite");
}

TEST(MeshMap, WrongSpecs) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.obj", test::obj_bytes(brick_mesh()));
  const auto message = [&](auto&& change) {
    MeshSpec spec = spec_of(file);
    change(spec);
    std::string text = message_of(spec);
    const std::size_t at = text.find(file);
    return at == std::string::npos ? text : text.replace(at, file.size(), "FILE");
  };
  EXPECT_EQ(message([&](MeshSpec& s) { s.file = folder.path() / "none.obj"; }),
            (folder.path() / "none.obj").string() + ": no such file");
  EXPECT_EQ(message([&](MeshSpec& s) { s.file = folder.path().string() + "/"; }),
            "file: '' is not one of obj, ply, stl, glb, gltf");
  EXPECT_EQ(message([](MeshSpec& s) { s.file = "a.fbx"; }),
            "file: 'fbx' is not one of obj, ply, stl, glb, gltf");
  EXPECT_EQ(message([](MeshSpec& s) { s.file = ""; }),
            "file: is not given; it is the map's file (obj, ply, stl, glb, gltf)");
  EXPECT_EQ(message([](MeshSpec& s) {
              s.goal_region = {{0, 0, 0}, {1, 1, 1}};
            }),
            "FILE: goal_region: [0, 0, 0] to [1, 1, 1] is not within the bounds, [1, 2, 3] to [3, "
            "5, 7]");
  EXPECT_EQ(message([](MeshSpec& s) {
              s.goal_region = {{0, 0, 0}, {1, 1, 1}};
              s.bounds = {{5, 5, 5}, {9, 9, 9}};
            }),
            "goal_region: is not within bounds");
  EXPECT_EQ(message([](MeshSpec& s) {
              s.bounds = {{5, 5}, {9, 9, 9}};
            }),
            "bounds.lowest_m: expected [x, y, z]");
  EXPECT_EQ(message([](MeshSpec& s) {
              s.bounds = {{5, 5, 9}, {9, 9, 5}};
            }),
            "bounds.highest_m: is below lowest_m along z");
  EXPECT_EQ(message([](MeshSpec& s) { s.file_digest = std::string(64, '0'); }),
            "FILE: has changed: its SHA-256 is not file_digest, " + std::string(64, '0'));
}

TEST(MeshMap, MapCoordinatesKeepTheirDecimals) {
  const TemporaryFolder folder;
  const std::string text =
      "v 500000.125 5900000.25 0\nv 500010.375 5900000.25 0\nv 500000.125 5900012.5 8\nf 1 2 3\n";
  MeshSpec spec = spec_of(folder.write("a.obj", text));
  spec.origin_m = {500000, 5900000, 0};
  const World world = make_world(spec, 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(0.125, 0.25, 0.0));
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(10.375, 12.5, 8.0));
}

TEST(MeshMap, StripsFansAndListsWithoutIndices) {
  const TemporaryFolder folder;
  TriangleMesh mesh;  // a square's corners: 0 1 / 3 2
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 2}, {0, 4, 2}};
  const auto area_of = [&](const std::string& mode, std::vector<std::uint32_t> corners) {
    mesh.triangles.clear();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    std::string text = test::gltf_bytes(mesh, false);
    text.replace(text.find("\"material\":0"), 12, "\"mode\":" + mode);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Corners& t : triangles_of(make_world(spec_of(folder.write("a.gltf", text)), 1))) {
      sum += 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    }
    return sum;
  };
  const Eigen::Vector3d whole(0, -8, 16);
  EXPECT_EQ(area_of("4", {0, 1, 2, 0, 2, 3}), whole);
  EXPECT_EQ(area_of("5", {0, 1, 3, 2, 2, 2}), whole);  // the last two are flat
  EXPECT_EQ(area_of("6", {0, 1, 2, 3, 3, 3}), whole);
}

TEST(MeshMap, TooMuchIsRefusedBeforeItIsKept) {
  const auto message = [](const std::string& name, const std::string& bytes) {
    return test::message_of([&] { parse_mesh(bytes, name, Material::concrete, 11); });
  };
  for (const auto& [name, bytes] : test::all_meshes(brick_mesh())) {
    EXPECT_EQ(message(name, bytes), name + ": has more than 11 triangles; decimate it first");
  }
  std::string vertices;
  for (int i = 0; i < 34; ++i) vertices += "v 0 0 0\n";
  EXPECT_EQ(
      message("a.obj", vertices),
      "a.obj: has more than 33 vertices, three for each of the most triangles; decimate it first");
}

TEST(MeshMap, NamesWithoutAFaceAreNoObstacles) {
  const TemporaryFolder folder;
  std::string text = "v 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 3\n";
  for (int i = 0; i < 1000; ++i) text += "o none\ng none\nusemtl none\n";
  text += "o slab\nf 1 2 3\no\to gate.2\nusemtl\tbark\nf 1 3 4\n";
  const World world = make_world(spec_of(folder.write("a.obj", text)), 1);
  ASSERT_EQ(world.obstacles.size(), 2U);
  EXPECT_EQ(world.prototypes[1].triangle_materials[0], Material::bark);
}

TEST(MeshMap, WhatIsExportedComesBack) {
  const TemporaryFolder folder;
  const World world = make_world(GapWallsSpec{}, 1);
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    export_mesh(world, folder.path() / name);
    MeshSpec spec = spec_of((folder.path() / name).string());
    spec.up_axis = name == "a.glb" ? UpAxis::y : UpAxis::z;
    spec.bounds = {{-1, -1, 0}, {50, 50, 5}};
    const World back = make_world(spec, 1);
    EXPECT_EQ(triangle_count(back), triangle_count(world)) << name;
    EXPECT_NEAR(volume_m3(back), volume_m3(world), 1e-3 * std::abs(volume_m3(world))) << name;
    if (name == "a.ply" || name == "a.stl") continue;  // without materials
    EXPECT_EQ(area_by_material_m2(back), area_by_material_m2(world)) << name;
  }
}

TEST(MeshMap, AGlbThatIsExportedKeepsItsObstacles) {
  const TemporaryFolder folder;
  const World world = make_world(HallSpec{.poisson_radius_m = 6.0}, 1);
  export_mesh(world, folder.path() / "a.glb");
  MeshSpec spec = spec_of((folder.path() / "a.glb").string());
  spec.up_axis = UpAxis::y;
  const World back = make_world(spec, 1);
  ASSERT_EQ(back.obstacles.size(), world.obstacles.size());
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    EXPECT_EQ(back.obstacles[i].kind, world.obstacles[i].kind) << i;
  }
}

TEST(MeshMap, DamagedFilesEndInAnErrorOrAWorld) {
  for (const auto& [name, bytes] : test::all_meshes(brick_mesh())) {
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
      const std::string message = message_of_file(name, bytes.substr(0, size));
      const bool may_be_whole = name == "a.obj" || size + 40 >= bytes.size();
      EXPECT_TRUE(may_be_whole || message.starts_with("FILE:")) << name << size << message;
    }
    for (std::size_t at = 0; at < bytes.size(); at += 5) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
      const std::string message = message_of_file(name, damaged);
      EXPECT_TRUE(message == "" || message.starts_with("FILE:")) << name << at << message;
    }
  }
}

}  // namespace
}  // namespace avoidbench
