// What parse_mesh() makes of each format's own ways to say a mesh.
#include <gtest/gtest.h>

#include <limits>

#include "base/input_error.hpp"
#include "map_file/mesh_file.hpp"
#include "support/input_error_message.hpp"
#include "support/map_files.hpp"

namespace avoidbench {
namespace {

using test::raw;

using Points = std::vector<Eigen::Vector3d>;

std::vector<MeshPart> parse(const std::string& name, const std::string& bytes) {
  return parse_mesh(bytes, name, Material::concrete, 1000);
}

std::string message_of(const std::string& name, const std::string& bytes) {
  return test::message_of([&] { parse(name, bytes); });
}

/// The corners of the part's triangles.
Points corners_of(const MeshPart& part) {
  Points corners;
  for (const auto& triangle : part.triangles) {
    for (const std::uint32_t vertex : triangle) corners.push_back(part.vertices.at(vertex));
  }
  return corners;
}

double area_of(const MeshPart& part) {
  const Points corners = corners_of(part);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    area += 0.5 * (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]).norm();
  }
  return area;
}

std::vector<std::string> kinds_of(const std::vector<MeshPart>& parts) {
  std::vector<std::string> kinds;
  for (const MeshPart& part : parts) kinds.push_back(part.kind);
  return kinds;
}

using Kinds = std::vector<std::string>;
using Materials = std::vector<Material>;

// ---- OBJ

const std::string kVertices = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\n";

TEST(ObjFile, CornersCountFromEitherEndAndMayNameTexturesAndNormals) {
  const std::string after = "vt 0 0\nvn 0 0 1\n";
  const Points expected{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  for (const std::string face : {"f 1 2 3 4", "f -6 -5 -4 -3", "f 1/1 2/1 3/1 4/1",
                                 "f 1//1 2//1 3//1 4//1", "f 1/1/1 -5/-1/-1 3/1/1 4/1/1\r"}) {
    const std::vector<MeshPart> parts = parse("a.obj", kVertices + after + face + "\n");
    ASSERT_EQ(parts.size(), 1U) << face;
    EXPECT_EQ(corners_of(parts[0]), expected) << face;
    EXPECT_EQ(parts[0].vertices.size(), 4U) << face << ": has vertices that no face names";
  }
}

TEST(ObjFile, AVertexMayHaveAColourOrAWeightOfOne) {
  const std::string text = "v 1 2 3 0.5 0.5 0.5\nv 5 2 3 1\n\tv +4e0 2.5e1 -3.\nf 1 2 3\n";
  const Points expected{{1, 2, 3}, {5, 2, 3}, {4, 25, -3}};
  EXPECT_EQ(corners_of(parse("a.obj", text)[0]), expected);
}

TEST(ObjFile, DecimalsAreRoundedToTheNearest) {
  const MeshPart part = parse("a.obj", "v 1.18 0 0\nv 0 0.7 0\nv 0 0 -1e-5\nf 1 2 3\n")[0];
  const auto single = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  const Points expected{{single(1.18), 0, 0}, {0, single(0.7), 0}, {0, 0, single(-1e-5)}};
  EXPECT_EQ(corners_of(part), expected);
}

TEST(ObjFile, ObjectsAndNewGroupsAreParts) {
  const std::string text = kVertices +
                           "o Wall.001\nf 1 2 3\no Tower\ng Gate_2\nf 1 2 4\ng Gate_2\nf 1 2 5\n"
                           "g Roof\nf 1 2 6\ns off\nf 2 3 6\n";
  const std::vector<MeshPart> parts = parse("a.obj", text);
  EXPECT_EQ(kinds_of(parts), (Kinds{"wall", "gate", "ceiling"}));
  EXPECT_EQ(parts[1].triangles.size(), 2U);
  EXPECT_EQ(parts[2].triangles.size(), 2U);
  EXPECT_EQ(corners_of(parts[2])[3], Eigen::Vector3d(4, 0, 0));
}

TEST(ObjFile, AnObjectNamedAgainGoesOn) {
  const std::vector<MeshPart> parts =
      parse("a.obj", kVertices + "o a\nf 1 2 3\no b\nf 1 2 4\no a\nf 1 2 6\n");
  EXPECT_EQ(kinds_of(parts), (Kinds{"a", "b"}));
  EXPECT_EQ(area_of(parts[0]), 6.0 + 4.0);
  EXPECT_EQ(area_of(parts[1]), 6.0);
}

TEST(ObjFile, AMaterialHoldsFromItsLineOn) {
  const std::string text = kVertices +
                           "f 1 2 3\nusemtl brick\nf 1 2 4\nusemtl Leaf.002\nusemtl bark\no a\n"
                           "f 1 2 5\nusemtl velvet\nf 1 2 6\n";
  const std::vector<MeshPart> parts = parse("a.obj", text);
  EXPECT_EQ(kinds_of(parts), (Kinds{"mesh", "a"}));
  EXPECT_EQ(parts[0].materials, (Materials{Material::concrete, Material::brick}));
  EXPECT_EQ(parts[1].materials, (Materials{Material::bark, Material::concrete}));
}

TEST(ObjFile, FacesThatCrossAreNamedWithTheirLine) {
  const std::string text = "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 4 4 0\nv 2 -2 0\nf 1 2 3\nf 1 2 3 4 5\n";
  EXPECT_EQ(message_of("a.obj", text),
            "a.obj:7: the face has edges that cross; cut it into triangles first");
}

// ---- PLY

struct PlyWays {
  std::string format = "binary_little_endian", count_type = "uchar", index_type = "int";
  bool has_faces_first = false;
};

template <class T>
std::string in_binary(const std::vector<T>& numbers, const std::string& type, bool is_big) {
  std::string bytes;
  for (const T number : numbers) {
    if (type == "uchar") bytes += raw(static_cast<std::uint8_t>(number), is_big);
    if (type == "ushort") bytes += raw(static_cast<std::uint16_t>(number), is_big);
    if (type == "int") bytes += raw(static_cast<std::int32_t>(number), is_big);
    if (type == "float") bytes += raw(static_cast<float>(number), is_big);
  }
  return bytes;
}

std::string ply(const Points& vertices, const std::vector<std::vector<int>>& faces,
                const PlyWays& ways) {
  const bool is_big = ways.format == "binary_big_endian", is_text = ways.format == "ascii";
  std::string vertex_bytes, face_bytes;
  for (const Eigen::Vector3d& v : vertices) {
    const std::vector<double> numbers{v.x(), v.y(), v.z()};
    vertex_bytes +=
        is_text ? test::vertex_text(v.cast<float>()) + "\n" : in_binary(numbers, "float", is_big);
  }
  for (const std::vector<int>& face : faces) {
    const std::vector<int> count{static_cast<int>(face.size())};
    if (!is_text) {
      face_bytes += in_binary(count, ways.count_type, is_big);
      face_bytes += in_binary(face, ways.index_type, is_big);
      continue;
    }
    face_bytes += std::to_string(face.size());
    for (const int corner : face) face_bytes += " " + std::to_string(corner);
    face_bytes += "\n";
  }
  const std::string vertex = "element vertex " + std::to_string(vertices.size()) +
                             "\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face " + std::to_string(faces.size()) + "\nproperty list " +
                           ways.count_type + " " + ways.index_type + " vertex_indices\n";
  const std::string head = "ply\nformat " + ways.format + " 1.0\n";
  return ways.has_faces_first ? head + face + vertex + "end_header\n" + face_bytes + vertex_bytes
                              : head + vertex + face + "end_header\n" + vertex_bytes + face_bytes;
}

const Points kPlyVertices{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {1, 1, 0}, {9, 9, 9}};

TEST(PlyFile, PolygonsOfEveryEncodingTypeAndOrder) {
  // A quad, a dart that is concave at its last corner, a rectangle with a dent.
  const std::vector<std::vector<int>> faces{{0, 1, 2, 3}, {3, 0, 1, 4}, {1, 2, 3, 4, 0}};
  const Points expected{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 0, 0}, {4, 3, 0}, {0, 3, 0},
                        {1, 1, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {0, 0, 0}, {4, 0, 0}};
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string count_type : {"uchar", "ushort", "int"}) {
      for (const std::string index_type : {"uchar", "ushort", "int"}) {
        for (const bool has_faces_first : {false, true}) {
          const PlyWays ways{format, count_type, index_type, has_faces_first};
          const std::vector<MeshPart> parts = parse("a.ply", ply(kPlyVertices, faces, ways));
          ASSERT_EQ(parts.size(), 1U);
          EXPECT_EQ(parts[0].kind, "mesh");
          Points corners = corners_of(parts[0]);
          ASSERT_EQ(corners.size(), 21U) << format << count_type << index_type;
          corners.resize(12);
          EXPECT_EQ(corners, expected) << format << count_type << index_type;
          EXPECT_NEAR(area_of(parts[0]), 12.0 + 3.5 + 10.5, 1e-12);
        }
      }
    }
  }
}

TEST(PlyFile, FacesThatCrossAreNamedWithTheirLineOrByte) {
  const Points vertices{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {4, 4, 0}, {2, -2, 0}};
  const std::vector<std::vector<int>> faces{{0, 1, 2}, {0, 1, 2, 3, 4}};
  EXPECT_EQ(message_of("a.ply", ply(vertices, faces, {.format = "ascii"})),
            "a.ply:16: face 1 has edges that cross; cut it into triangles first");
  const std::string bytes = ply(vertices, faces, {});
  EXPECT_EQ(message_of("a.ply", bytes), "a.ply: face 1 at byte " +
                                            std::to_string(bytes.size() - 21) +
                                            " has edges that cross; cut it into triangles first");
}

TEST(PlyFile, WhatIsWrongInBinaryIsNamedWithItsByte) {
  std::string bytes = ply(kPlyVertices, {{0, 1, 2}, {0, 1, 6}}, {});
  EXPECT_EQ(message_of("a.ply", bytes), "a.ply: face 1 at byte " +
                                            std::to_string(bytes.size() - 13) +
                                            " names a vertex that does not exist");
  const std::size_t second = bytes.find("end_header\n") + 11 + 12;
  bytes.replace(second + 4, 4, raw(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(message_of("a.ply", bytes),
            "a.ply: vertex 1 at byte " + std::to_string(second) + " is not finite");
}

// ---- STL

TEST(StlFile, ABinaryOneMayBeginAsATextWould) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 2}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  const Points expected{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 0}, {4, 0, 0}, {0, 0, 2}};
  std::string bytes = test::binary_stl_bytes(mesh);
  bytes.replace(0, 10, "solid cube");
  EXPECT_EQ(corners_of(parse("a.stl", bytes)[0]), expected);
  const std::string text = test::ascii_stl_bytes(mesh);
  const std::vector<MeshPart> two = parse("a.stl", text + text);
  ASSERT_EQ(two.size(), 1U) << "solids of an STL file are one part";
  EXPECT_EQ(two[0].triangles.size(), 4U);
  EXPECT_EQ(two[0].kind, "mesh");
}

// ---- glTF

/// A right triangle with legs of 2 along x and y in a buffer of its own layout: each position of
/// 12 bytes is followed by 8 others; then the indices, behind one that is not used.
struct GltfWays {
  std::string nodes = "[{\"mesh\":0}]", roots = "[0]";
  std::string primitive = "\"indices\":1";
  int index_size = 2;
  std::string accessor = "";  ///< more of the positions' JSON
  bool is_glb = false;
};

std::string gltf(const GltfWays& ways) {
  std::string buffer = "4444";  // a view that begins later
  for (const Eigen::Vector3f& v : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(2, 0, 0),
                                   Eigen::Vector3f(0, 2, 0), Eigen::Vector3f(0, 0, 1)}) {
    for (const float number : v) buffer += raw(number);
    buffer += "normals.";
  }
  const std::size_t indices_at = buffer.size();
  for (const std::uint32_t index : {3U, 0U, 1U, 2U}) {
    if (ways.index_size == 1) buffer += raw(static_cast<std::uint8_t>(index));
    if (ways.index_size == 2) buffer += raw(static_cast<std::uint16_t>(index));
    if (ways.index_size == 4) buffer += raw(index);
  }
  const std::string size = std::to_string(ways.index_size);
  const int component = ways.index_size == 1 ? 5121 : ways.index_size == 2 ? 5123 : 5125;
  const std::string uri =
      ",\"uri\":\"data:application/octet-stream;base64," + test::base64(buffer) + "\"";
  const std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":)" + ways.roots + R"(}],"nodes":)" +
      ways.nodes +
      R"(,"materials":[{"name":"brick"},{"name":"leaf.001"}],"meshes":[{"name":"Tree","primitives":[)"
      R"({"attributes":{"POSITION":0,"NORMAL":7},"material":1,)" +
      ways.primitive +
      R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3")" +
      ways.accessor + R"(},{"bufferView":1,"byteOffset":)" + size + R"(,"componentType":)" +
      std::to_string(component) +
      R"(,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":4,"byteLength":80,)"
      R"("byteStride":20},{"buffer":0,"byteOffset":)" +
      std::to_string(indices_at) + R"(,"byteLength":)" +
      std::to_string(buffer.size() - indices_at) + R"(}],"buffers":[{"byteLength":)" +
      std::to_string(buffer.size()) + (ways.is_glb ? "" : uri) + "}]}";
  if (!ways.is_glb) return json;
  const auto chunk = [](const std::string& bytes, const std::string& kind) {
    return raw(static_cast<std::uint32_t>(bytes.size())) + kind + bytes;
  };
  const std::string chunks = chunk("more", "MORE") + chunk(json, "JSON") +
                             chunk(buffer, std::string("BIN\0", 4)) + chunk("even more", "LAST");
  return "glTF" + raw(2U) + raw(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

const Points kGltfTriangle{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};

TEST(GltfFile, EveryTypeOfIndexAndInterleavedBuffers) {
  for (const bool is_glb : {false, true}) {
    for (const int index_size : {1, 2, 4}) {
      const std::vector<MeshPart> parts =
          parse("a.gltf", gltf({.index_size = index_size, .is_glb = is_glb}));
      ASSERT_EQ(parts.size(), 1U);
      EXPECT_EQ(corners_of(parts[0]), kGltfTriangle);
      EXPECT_EQ(parts[0].vertices.size(), 3U) << "has vertices that no triangle names";
      EXPECT_EQ(parts[0].materials, Materials{Material::leaf});
    }
  }
}

TEST(GltfFile, NodesArePartsNamedByThemselvesOrTheirMesh) {
  const std::vector<MeshPart> parts = parse(
      "a.gltf",
      gltf({.nodes = R"([{"name":"Pillar.7","mesh":0,"children":[2]},{"mesh":0},{"name":"12",)"
                     R"("mesh":0,"translation":[0,0,5]},{"name":"Unused","mesh":0}])",
            .roots = "[1,0]"}));
  EXPECT_EQ(kinds_of(parts), (Kinds{"tree", "pillar", "tree"}));
  EXPECT_EQ(corners_of(parts[1]), kGltfTriangle);
  EXPECT_EQ(corners_of(parts[2])[0], Eigen::Vector3d(0, 0, 5));
}

TEST(GltfFile, TransformsOfNodesNest) {
  // Below: scaled by (1, 2, 3), then a quarter turn about z, then moved. Above: a matrix, column by
  // column, that puts z up to y up and moves by (1, 0, 0).
  const std::vector<MeshPart> parts =
      parse("a.gltf",
            gltf({.nodes = R"([{"matrix":[1,0,0,0, 0,0,-1,0, 0,1,0,0, 1,0,0,1],"children":[1]},)"
                           R"({"mesh":0,"translation":[10,20,30],"scale":[1,2,3],"rotation":)"
                           R"([0,0,0.70710678118654757,0.70710678118654757]}])"}));
  const Points corners = corners_of(parts.at(0));
  const Points expected{{11, 30, -20}, {11, 30, -22}, {7, 30, -20}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((corners[i] - expected[i]).norm(), 2e-6) << corners[i].transpose();
  }
  EXPECT_NEAR(area_of(parts[0]), 4.0, 1e-6);
}

TEST(GltfFile, AMirroredTriangleIsTurnedBack) {
  const std::vector<MeshPart> parts =
      parse("a.gltf", gltf({.nodes = R"([{"mesh":0,"scale":[1,-1,1]}])"}));
  EXPECT_EQ(corners_of(parts[0]), (Points{{0, 0, 0}, {0, -2, 0}, {2, 0, 0}}));
}

TEST(GltfFile, WaysThatAreNotReadAreNamed) {
  EXPECT_EQ(message_of("a.gltf", gltf({.accessor = R"(,"sparse":{"count":1})"})),
            "a.gltf: accessors[0] is sparse, which is not supported");
  EXPECT_EQ(
      message_of("a.gltf",
                 gltf({.primitive = R"("extensions":{"KHR_draco_mesh_compression":{}})"})),
      "a.gltf: meshes[0] is compressed with Draco, which is not supported; export it uncompressed");
  // Would be one tree of many, silently.
  EXPECT_EQ(message_of("a.gltf", gltf({.nodes = R"([{"mesh":0,"extensions":{)"
                                                R"("EXT_mesh_gpu_instancing":{}}}])"})),
            "a.gltf: nodes[0] has several instances (EXT_mesh_gpu_instancing), which is not "
            "supported; export a node for each");
  EXPECT_EQ(message_of("a.gltf", gltf({.nodes = R"([{"name":"a","mesh":1}])"})),
            "a.gltf: meshes[1] is missing");
}

}  // namespace
}  // namespace avoidbench
