#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/poll.hpp"
#include "base/random.hpp"
#include "map_file/cloud_bytes.hpp"
#include "map_file/lzf.hpp"
#include "map_file/point_cloud_file.hpp"
#include "map_file/voxel_surface.hpp"
#include "maps/map_spec.hpp"
#include "support/input_error_message.hpp"
#include "support/map_files.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

using test::all_clouds;
using test::message_of;
using test::pcd;
using test::TemporaryFolder;

/// A thousand points in 8 m × 10 m × 4 m, multiples of 1/64 m so that text says them exactly.
FilePoints random_points() {
  RandomStream draws = stream(3, "points");
  FilePoints points;
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
      const double side_m = axis == 0 ? 8.0 : axis == 1 ? 10.0 : 4.0;
      point[axis] = std::floor(64.0 * draws.uniform(0.0, side_m)) / 64.0;
    }
    points.push_back(point);
  }
  return points;
}

PointCloudSpec cloud_spec(const std::string& file) {
  PointCloudSpec spec;
  spec.file = file;
  spec.resolution_m = 0.5;
  return spec;
}

TEST(PointCloud, EveryFormatGivesTheSamePointsAndWorld) {
  const TemporaryFolder folder;
  const FilePoints points = random_points();
  std::string digest;
  for (const auto& [name, bytes] : all_clouds(points)) {
    EXPECT_EQ(parse_point_cloud(bytes, name), points) << name;
    const World world = make_world(cloud_spec(folder.write(name, bytes)), 1);
    if (digest.empty()) digest = world.digest;
    EXPECT_EQ(world.digest, digest) << name;
  }
}

TEST(PointCloud, EveryReaderAsksWhetherToGoOn) {
  const FilePoints points = random_points();
  for (const auto& [name, bytes] : all_clouds(points)) {
    const PollScope scope([] { throw std::runtime_error("enough"); });
    EXPECT_THROW(parse_point_cloud(bytes, name), std::runtime_error) << name;
  }
  const PollScope scope([] { throw std::runtime_error("enough"); });
  EXPECT_THROW(voxel_surface(points, 0.5, 1000), std::runtime_error);
}

TEST(PointCloud, PointsThatAreNotFiniteAreLeftOut) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n";
  EXPECT_EQ(parse_point_cloud(header + "1 2 3\nnan nan nan\n4 inf 6\n1e999 0 1e-999\n", "a").size(),
            1U);
}

TEST(PointCloud, NumbersBeyondADoubleAreZeroOrInfiniteWithTheirSign) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string zeros(400, '0');
  const std::pair<std::string, double> cases[] = {{"1e400", infinity},
                                                  {"-1e400", -infinity},
                                                  {"1e-400", 0.0},
                                                  {"-1e-400", -0.0},
                                                  {"0." + zeros + "1", 0.0},
                                                  {"-." + zeros + "1", -0.0},
                                                  {"1" + zeros, infinity},
                                                  {"-1" + zeros + ".5", -infinity},
                                                  {"0." + zeros + "1e+1", 0.0},
                                                  {"0." + zeros + "1e800", infinity},
                                                  {"1" + zeros + "e-800", 0.0},
                                                  {"1" + zeros + "e-10", infinity},
                                                  {"0e400", 0.0},
                                                  {"-0e99999999999999999999", -0.0},
                                                  {"1e99999999999999999999", infinity},
                                                  {"-1E-99999999999999999999", -0.0}};
  for (const auto& [word, value] : cases) {
    const auto number = number_in<double>(word);
    ASSERT_TRUE(number.has_value()) << word;
    EXPECT_EQ(*number, value) << word;
    EXPECT_EQ(std::signbit(*number), std::signbit(value)) << word;
  }
}

double area_m2(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f u = mesh.vertices[b] - mesh.vertices[a];
    const Eigen::Vector3f v = mesh.vertices[c] - mesh.vertices[a];
    area += 0.5 * static_cast<double>(u.cross(v).norm());
  }
  return area;
}

double volume_m3(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].cast<double>().dot(
        mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  }
  return volume / 6.0;
}

TEST(Voxels, OneVoxelIsACubeAndARowIsMerged) {
  VoxelSurface surface = voxel_surface({{0.3, -0.2, 1.1}}, 0.5, 1000);
  EXPECT_EQ(surface.triangle_count, 12U);
  EXPECT_EQ(area_m2(surface.mesh), 1.5);
  EXPECT_EQ(volume_m3(surface.mesh), 0.125);
  surface = voxel_surface({{0.1, 0.1, 0.1}, {0.6, 0.1, 0.1}, {1.1, 0.2, 0.3}, {1.2, 0.2, 0.3}}, 0.5,
                          1000);
  EXPECT_EQ(surface.voxel_count, 3U);
  EXPECT_EQ(surface.triangle_count, 12U);
  EXPECT_EQ(volume_m3(surface.mesh), 0.375);
}

TEST(Voxels, FacesAreThoseOfBruteForce) {
  const FilePoints points = random_points();
  constexpr double kSide = 0.5;
  const auto is_full = [&](const Eigen::Vector3i& cell) {
    return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
      return (p / kSide).array().floor().cast<int>().matrix() == cell;
    });
  };
  double voxels = 0.0, faces = 0.0;
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 20; ++y) {
      for (int z = 0; z < 8; ++z) {
        if (!is_full({x, y, z})) continue;
        ++voxels;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int side : {-1, 1}) {
            const Eigen::Vector3i beside =
                Eigen::Vector3i(x, y, z) + side * Eigen::Vector3i::Unit(axis);
            if (!is_full(beside)) ++faces;
          }
        }
      }
    }
  }
  const VoxelSurface surface = voxel_surface(points, kSide, 1'000'000);
  EXPECT_EQ(static_cast<double>(surface.voxel_count), voxels);
  EXPECT_DOUBLE_EQ(area_m2(surface.mesh), faces * kSide * kSide);
  EXPECT_NEAR(volume_m3(surface.mesh), voxels * kSide * kSide * kSide, 1e-6);
  EXPECT_LT(static_cast<double>(surface.triangle_count), 2.0 * faces);
  FilePoints reversed(points.rbegin(), points.rend());
  EXPECT_EQ(voxel_surface(reversed, kSide, 1'000'000).mesh.triangles, surface.mesh.triangles);
  EXPECT_EQ(voxel_surface(reversed, kSide, 1'000'000).mesh.vertices, surface.mesh.vertices);
}

TEST(PointCloud, ScaleAxesOriginAndBounds) {
  const TemporaryFolder folder;
  PointCloudSpec spec = cloud_spec(folder.write("a.pcd", pcd(random_points(), "binary")));
  spec.scale = 2.0;
  spec.up_axis = UpAxis::y;
  spec.origin_m = {1.0, 2.0, 3.0};
  World world = make_world(spec, 1);
  EXPECT_EQ(world.bounds.min(), Eigen::Vector3d(-1.0, -10.0, -3.0));
  // The lowest points have z = 0: y = -2 is the low face of their voxels.
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(15.0, -1.5, 17.0));
  spec = cloud_spec(spec.file);
  spec.bounds = {{2, 2, 0}, {6, 8, 4}};
  world = make_world(spec, 1);
  EXPECT_EQ(world.bounds.max(), Eigen::Vector3d(6, 8, 4));
  for (const Eigen::Vector3f& v : world.prototypes[0].mesh.vertices) {
    EXPECT_TRUE(world.bounds.contains(v.cast<double>())) << v.transpose();
  }
}

TEST(PointCloud, WhatIsWrongIsReportedWithFileAndLine) {
  const auto parse = [](const std::string& bytes) {
    return message_of([&] { parse_point_cloud(bytes, "c"); });
  };
  const std::string ply_header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n";
  EXPECT_EQ(parse("solid"),
            "c: does not begin as one of PLY ('ply'), PCD ('# .PCD'), LAS ('LASF') and OctoMap's "
            ".bt ('# Octomap OcTree binary file')");
  EXPECT_EQ(parse("ply\nformat text 1.0\n"),
            "c:2: expected 'format ascii|binary_little_endian|binary_big_endian 1.0'");
  EXPECT_EQ(parse("ply\nformat ascii 1.0\nelement vertex two\n"),
            "c:3: expected 'element NAME COUNT'");
  EXPECT_EQ(parse(ply_header + "1 2 3\n"),
            "c:8: is truncated: the header promises 2 of 'vertex', there are 1");
  EXPECT_EQ(parse(ply_header + "1 2 3\n4 5\n"), "c:9: too few numbers");
  EXPECT_EQ(parse(ply_header + "1 2 3\n4 5 six\n"), "c:9: 'six' is not a number");
  EXPECT_EQ(parse("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n"),
            "c: the element vertex lacks the property y");
  EXPECT_EQ(parse("# .PCD\nFIELDS x y z\nSIZE 4 4\n"),
            "c:3: SIZE has 2 entries for the 3 of FIELDS");
  EXPECT_EQ(parse("# .PCD\nFIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n"), "c: FIELDS lacks z");
  EXPECT_EQ(parse("# .PCD\nFIELDS x y z\nPOINTS 99999999999999\nDATA binary\n............"),
            "c: is truncated: the header promises 99999999999999 points, there are 1");
  std::string compressed = pcd(random_points(), "binary_compressed");
  EXPECT_EQ(parse(compressed.substr(0, compressed.size() - 1)).find("c: is truncated"), 0U);
  compressed[compressed.size() - 20] = '\x7f';
  compressed[compressed.size() - 21] = '\x7f';
  compressed[compressed.size() - 33] = '\xff';
  EXPECT_NE(parse(compressed), "");

  const TemporaryFolder folder;
  const auto make = [&](const FilePoints& points, double resolution_m = 0.5) {
    PointCloudSpec spec = cloud_spec(folder.write("a.pcd", pcd(points, "binary")));
    spec.resolution_m = resolution_m;
    const std::string text = message_of([&] { make_world(spec, 1); });
    return text.substr(text.rfind(".pcd: ") + 6);
  };
  EXPECT_EQ(make({{1, 2, 3}}), "has 1 point that is finite; a map needs 10 at least");
  FilePoints millimetres = random_points();
  for (Eigen::Vector3d& p : millimetres) p *= 1000.0;
  EXPECT_NE(make(millimetres).find("set scale"), std::string::npos);
  FilePoints wide = random_points();
  wide.push_back({40'000.0, 0.0, 0.0});  // one stray point
  EXPECT_EQ(make(wide),
            "spans 40000 × 9.98438 × 3.96875 m, more than 2000 m: if its unit is not the metre, "
            "set scale (0.001 for millimetres, 0.01 for centimetres, 0.3048 for feet); stray "
            "points: give bounds");
  FilePoints many;
  RandomStream draws = stream(1, "many");
  for (int i = 0; i < 500'000; ++i) {
    const double x = draws.uniform(0, 100), y = draws.uniform(0, 100);
    many.emplace_back(x, y, draws.uniform(0, 100));
  }
  const std::string text = make(many, 0.05);
  EXPECT_NE(text.find("more than 5000000: set resolution_m coarser, to about 0.06"),
            std::string::npos)
      << text;
}

TEST(PointCloud, DamagedFilesEndInAnErrorOrPoints) {
  FilePoints points = random_points();
  points.resize(20);
  const auto read = [](const std::string& bytes) {
    return message_of([&] { parse_point_cloud(bytes, "c"); });
  };
  for (const auto& [name, bytes] : all_clouds(points)) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const std::string message = read(bytes.substr(0, size));
      const bool is_last_line = size + 40 >= bytes.size();  // text may lack its end
      EXPECT_TRUE(is_last_line || message.starts_with("c:")) << name << size << message;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char flip : {'\x01', '\x10', '\x7f'}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        const std::string message = read(damaged);
        EXPECT_TRUE(message == "" || message.starts_with("c:")) << name << at << message;
      }
    }
  }
}

TEST(Lzf, CopiesAndRefuses) {
  EXPECT_EQ(lzf_decompressed(std::string("\x02"
                                         "abc"
                                         "\x20\x02",
                                         6),
                             6),
            "abcabc");
  EXPECT_EQ(lzf_decompressed(std::string("\x00"
                                         "a"
                                         "\xe0\x00\x00",
                                         5),
                             10),
            "aaaaaaaaaa");
  EXPECT_EQ(lzf_decompressed(std::string("\x00"
                                         "a"
                                         "\xe0\x00\x00",
                                         5),
                             9),
            std::nullopt);
  EXPECT_EQ(lzf_decompressed(std::string("\x00"
                                         "a"
                                         "\x20\x01",
                                         4),
                             4),
            std::nullopt);
  EXPECT_EQ(lzf_decompressed("\x05"
                             "abc",
                             6),
            std::nullopt);
  EXPECT_EQ(lzf_decompressed("", 0), "");
}

TEST(PointCloud, AMeshIsNoCloud) {
  Prototype box;
  add_box(box, {1, 2, 3}, {3, 5, 7}, Material::brick);
  for (const auto& [name, bytes] : test::all_meshes(box.mesh)) {
    if (!name.ends_with(".ply")) continue;
    EXPECT_EQ(message_of([&mesh = bytes] { parse_point_cloud(mesh, "a.ply"); }),
              "a.ply: is a mesh of 12 faces, not a cloud of points: use generator: mesh");
  }
  // No face, but its element: as MeshLab writes clouds.
  std::string empty = test::ply({{1, 2, 3}}, "ascii");
  empty.insert(empty.find("end_header"),
               "element face 0\nproperty list uchar int vertex_indices\n");
  EXPECT_EQ(parse_point_cloud(empty, "a.ply").size(), 1U);
}

}  // namespace
}  // namespace avoidbench
