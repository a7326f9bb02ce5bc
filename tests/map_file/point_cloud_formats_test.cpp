// LAS files and OctoMap's octrees, written byte by byte.
#include <gtest/gtest.h>

#include <limits>

#include "base/random.hpp"
#include "map_file/point_cloud_file.hpp"
#include "map_file/voxel_surface.hpp"
#include "maps/map_spec.hpp"
#include "support/input_error_message.hpp"
#include "support/map_files.hpp"

namespace avoidbench {
namespace {

using test::has;
using test::las;
using test::LasForm;
using test::message_of;
using test::octree;
using test::octree_at_origin;
using test::octree_node;
using test::put;
using test::raw;
using test::TemporaryFolder;

std::string parse_message(const std::string& bytes) {
  return message_of([&] { parse_point_cloud(bytes, "c"); });
}

FilePoints three() {
  return {{1.0, -2.5, 0.25}, {3.0, 4.015625, -1.0}, {0.0, 0.0, 33'554'431.984375}};
}

TEST(Las, EveryVersionAndPointFormatIsRead) {
  for (int minor = 2; minor <= 4; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      for (const std::size_t extra : {0U, 1U, 200U}) {
        const LasForm form{.minor = minor, .format = format, .extra = extra, .records = extra % 3};
        EXPECT_EQ(parse_point_cloud(las(three(), form), "c"), three()) << minor << ' ' << format;
      }
    }
  }
}

TEST(Las, WithheldPointsAreLeftOutInOldAndNewFormats) {
  for (int format = 0; format <= 10; ++format) {
    const LasForm form{.minor = 4, .format = format, .withheld = {1}};
    const FilePoints left{three()[0], three()[2]};
    EXPECT_EQ(parse_point_cloud(las(three(), form), "c"), left) << format;
  }
  // Synthetic points and key points are points.
  for (const int format : {3, 7}) {
    std::string bytes = las({three()[0]}, {.minor = 4, .format = format});
    bytes[375 + 15] = format == 3 ? '\x7f' : '\xfb';
    EXPECT_EQ(parse_point_cloud(bytes, "c").size(), 1U) << format;
  }
}

TEST(Las, TheCountOf64BitsIsThatOfLas14) {
  const LasForm form{.minor = 4, .format = 6, .has_legacy_count = false};
  std::string bytes = las(three(), form);
  EXPECT_EQ(parse_point_cloud(bytes, "c"), three());
  put(bytes, 247, std::uint64_t{0});  // writers of before 1.4's last revision
  put(bytes, 107, std::uint32_t{2});
  EXPECT_EQ(parse_point_cloud(bytes, "c").size(), 2U);
  put(bytes, 247, std::uint64_t{0xffffffffffffffff});
  // Points of 30 bytes are those there, and what follows is less than one.
  EXPECT_EQ(parse_message(bytes),
            "c: is truncated: the header promises 18446744073709551615 points, there are 3");
}

TEST(Las, MapCoordinatesKeepTheirDecimals) {
  const Eigen::Vector3d far(512'345.0, 5'412'345.0, 431.0);
  const FilePoints points = parse_point_cloud(
      las({far + Eigen::Vector3d(0.001, 0.002, 0.003)}, {.scale = 0.001, .offset = far}), "c");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0],
            Eigen::Vector3d(1 * 0.001 + far.x(), 2 * 0.001 + far.y(), 3 * 0.001 + far.z()));
}

TEST(Las, WhatIsWrongIsReportedWithItsByte) {
  const std::string good = las(three(), {.minor = 4, .format = 6, .records = 1});
  const auto with = [&](std::size_t at, auto value) {
    std::string bytes = good;
    put(bytes, at, value);
    return parse_message(bytes);
  };
  EXPECT_EQ(parse_message(good), "");
  EXPECT_TRUE(has(with(25, std::uint8_t{1}), "c: is LAS 1.1, not 1.2 to 1.4: "));
  EXPECT_TRUE(has(with(24, std::uint8_t{2}), "c: is LAS 2.4, not 1.2 to 1.4: "));
  EXPECT_EQ(with(94, std::uint16_t{374}),
            "c: byte 94: a header of LAS 1.4 has 375 bytes at least, not 374");
  EXPECT_EQ(with(94, std::uint16_t{65535}), "c: is truncated within its header");
  EXPECT_EQ(with(96, std::uint32_t{374}),
            "c: byte 96: its points can't begin at byte 374, within the header");
  EXPECT_EQ(with(96, std::uint32_t{0xffffffff}),
            "c: is truncated: its points should begin at byte 4294967295, it ends at " +
                std::to_string(good.size()));
  EXPECT_EQ(with(104, std::uint8_t{11}), "c: byte 104: point format 11 is not one of 0 to 10");
  EXPECT_EQ(with(105, std::uint16_t{29}),
            "c: byte 105: a point of format 6 has 30 bytes at least, not 29");
  EXPECT_EQ(with(105, std::uint16_t{0}),
            "c: byte 105: a point of format 6 has 30 bytes at least, not 0");
  EXPECT_EQ(with(105, std::uint16_t{65535}),
            "c: is truncated: the header promises 3 points, there are 0");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double scale : {0.0, -0.01, kNan, kInfinity}) {
    EXPECT_EQ(with(139, scale), "c: byte 139: the scale of y is not a finite number above 0");
  }
  for (const double offset : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(with(171, offset), "c: byte 171: the offset of z is not finite");
  }
  // Points beyond any double are not finite: left out.
  std::string vast = good;
  put(vast, 131, 1e308);
  put(vast, 155, 1e308);
  EXPECT_EQ(parse_point_cloud(vast, "c").size(), 1U);
  // Records promised beyond the points change nothing.
  EXPECT_EQ(with(100, std::uint32_t{0xffffffff}), "");
  EXPECT_EQ(with(375 + 20, std::uint16_t{65535}), "");
}

TEST(Las, FilesThatNeedAConverterSayWhich) {
  std::string laz = las(three(), {.minor = 4, .format = 6, .records = 1});
  laz.replace(375 + 2, 16, std::string("laszip encoded\0\0", 16));
  const std::string converters =
      "c: is compressed (LAZ): convert it first, with 'pdal translate in.laz out.las' or 'laszip "
      "-i in.laz -o out.las'";
  EXPECT_EQ(parse_message(laz), converters);
  laz = las(three());
  laz[104] = static_cast<char>(0x80 | 3);
  EXPECT_EQ(parse_message(laz), converters);
  EXPECT_EQ(
      parse_message("ASTM-E57\1"),
      "c: is an E57 file: convert it first, with 'pdal translate in.e57 out.las' or CloudCompare");
  EXPECT_EQ(parse_message("# Octomap OcTree file\nid OcTree\n"),
            "c: is an octree with probabilities (.ot): convert it first, with 'convert_octree "
            "in.ot out.bt'");
  PointCloudSpec spec;
  spec.file = "a.LAZ";
  std::vector<std::string> problems;
  find_problems(spec, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0],
            "file: 'laz' is not one of ply, pcd, las, bt: convert it first, with 'pdal translate "
            "in.laz out.las' or 'laszip -i in.laz -o out.las'");
}

FilePoints cloud_around_origin(int count) {
  RandomStream draws = stream(3, "points");
  FilePoints points;
  for (int i = 0; i < count; ++i) {
    const double x = draws.uniform(-8.0, 8.0), y = draws.uniform(0.0, 10.0);
    points.emplace_back(x, y, draws.uniform(0.0, 4.0));
  }
  for (Eigen::Vector3d& p : points) p = (p * 64.0).array().round() / 64.0;
  return points;
}

PointCloudSpec voxels_of(const std::string& file, double resolution_m = 0.5) {
  PointCloudSpec spec;
  spec.file = file;
  spec.resolution_m = resolution_m;
  return spec;
}

TEST(VoxelSieve, ItsCentresHaveTheSurfaceOfThePoints) {
  // Many of each voxel, in any order; also on faces, and more than are kept unsorted.
  const FilePoints points = cloud_around_origin(40'000);
  VoxelSieve sieve(0.5, 10'000);
  for (int again = 0; again < 60; ++again) {
    for (const Eigen::Vector3d& p : points) ASSERT_TRUE(sieve.add(p));
  }
  const VoxelSurface expected = voxel_surface(points, 0.5, 1'000'000);
  const FilePoints centres = sieve.centres();
  EXPECT_EQ(centres.size(), expected.voxel_count);
  EXPECT_EQ(voxel_surface(centres, 0.5, 1'000'000).mesh.vertices, expected.mesh.vertices);
}

TEST(VoxelSieve, TooManyVoxelsAreNoticed) {
  VoxelSieve few(1.0, 2);
  for (int i = 0; i < 3; ++i) few.add({0.5 + i, 0.0, 0.0});
  EXPECT_TRUE(few.centres().empty());
  // On the way, too, before memory runs out.
  VoxelSieve sieve(1.0, 1000);
  bool fits = true;
  for (int i = 0; i < 2'000'000 && fits; ++i) {
    fits = sieve.add({static_cast<double>(i % 2000), static_cast<double>(i / 2000), 0.0});
  }
  EXPECT_FALSE(fits);
}

TEST(Las, BoundsOriginAndDigestAreThoseOfOtherClouds) {
  const TemporaryFolder folder;
  FilePoints points = cloud_around_origin(3000);
  points.push_back({40'000.0, 0.0, 0.0});  // stray
  points.push_back({6.0, 8.0, 1.0});       // on the high faces of the bounds
  PointCloudSpec spec = voxels_of(folder.write("a.pcd", test::pcd(points, "binary")));
  spec.scale = 0.5;
  spec.origin_m = {0.25, 0.5, 0.0};
  spec.bounds = {{-3, 0, 0}, {2.75, 3.5, 2}};
  spec.flight_height_m = 1.0;
  const std::string expected = make_world(spec, 1).digest;
  const std::string bytes = las(points, {.format = 1});
  spec.file = folder.write("a.las", bytes);
  EXPECT_EQ(make_world(spec, 1).digest, expected);
  spec.file_digest = bytes_digest(bytes);
  EXPECT_EQ(make_world(spec, 1).digest, expected);
  spec.file_digest[0] = spec.file_digest[0] == '0' ? '1' : '0';
  EXPECT_TRUE(has(message_of([&] { make_world(spec, 1); }), "has changed: its SHA-256"));
}

TEST(Las, ExtentsAreReportedAsOfOtherClouds) {
  const TemporaryFolder folder;
  const auto make = [&](const FilePoints& points, const LasForm& form, double resolution_m = 0.5) {
    const PointCloudSpec spec = voxels_of(folder.write("a.las", las(points, form)), resolution_m);
    const std::string text = message_of([&] { make_world(spec, 1); });
    return text.substr(std::min(text.size(), text.rfind(".las: ") + 6));
  };
  const Eigen::Vector3d utm(512'345.0, 5'412'345.0, 431.0);
  FilePoints far = cloud_around_origin(1000);
  for (Eigen::Vector3d& p : far) p += utm;
  EXPECT_TRUE(has(make(far, {.offset = utm}),
                  "lies more than 10 km from its origin, at [512337, 5412345, 431]: set origin_m"));
  EXPECT_EQ(make({{1, 2, 3}}, {}), "has 1 point that is finite; a map needs 10 at least");
  FilePoints wide = cloud_around_origin(1000);
  wide.push_back({40'000.0, 0.0, 0.0});
  EXPECT_TRUE(has(make(wide, {}), "more than 2000 m"));
  // As large as numbers come.
  FilePoints vast = cloud_around_origin(1000);
  for (Eigen::Vector3d& p : vast) p *= 1e300;
  EXPECT_TRUE(has(make(vast, {.scale = 1e298}), "more than 2000 m"));
  FilePoints many;
  for (int i = 0; i < 4'100'000; ++i) many.emplace_back(i % 2100, i / 2100, 0);
  for (Eigen::Vector3d& p : many) p /= 2.0;
  EXPECT_EQ(make(many, {.scale = 0.5}),
            "has points in more than 4000000 voxels of 0.5 m: set resolution_m coarser, or bounds "
            "to the part that is flown in");
}

TEST(Octree, VoxelsAreAtTheirCentres) {
  // Children by number: x is bit 0, y bit 1, z bit 2.
  const std::string bytes = octree_at_origin("0.25", 1, octree_node("ofoo0fo0"), 6);
  EXPECT_EQ(parse_point_cloud(bytes, "c"), (FilePoints{{0.125, 0.125, 0.125},
                                                       {0.125, 0.375, 0.125},
                                                       {0.375, 0.375, 0.125},
                                                       {0.125, 0.375, 0.375}}));
  EXPECT_EQ(octree_resolution(bytes, "c"), 0.25);
  // The voxel below the origin on all sides.
  std::string tree = octree_node("n0000000");
  for (int depth = 1; depth < 15; ++depth) tree += octree_node("0000000n");
  EXPECT_EQ(parse_point_cloud(octree(17, "0.1", tree + octree_node("0000000o")), "c"),
            (FilePoints{{-0.5 * 0.1, -0.5 * 0.1, -0.5 * 0.1}}));
}

TEST(Octree, ALargeLeafIsAllItsVoxels) {
  // Child 5 of a node that spans 8 voxels a side: 4³ voxels from (4, 0, 4).
  const FilePoints points =
      parse_point_cloud(octree_at_origin("1", 3, octree_node("00000o00"), 1), "c");
  ASSERT_EQ(points.size(), 64U);
  const VoxelSurface surface = voxel_surface(points, 1.0, 1000);
  EXPECT_EQ(surface.voxel_count, 64U);
  EXPECT_EQ(surface.triangle_count, 12U);
  EXPECT_EQ(points.front(), Eigen::Vector3d(4.5, 0.5, 4.5));
  EXPECT_EQ(points.back(), Eigen::Vector3d(7.5, 3.5, 7.5));
}

TEST(Octree, NodesFollowInTheOrderOfTheirBits) {
  // Two nodes below one: the first one's children stand before the second's.
  const std::string tree =
      octree_node("n0o0000n") + octree_node("o0000000") + octree_node("0000000o");
  EXPECT_EQ(parse_point_cloud(octree_at_origin("1", 2, tree, 5), "c").size(), 1U + 8U + 1U);
  const FilePoints points = parse_point_cloud(octree_at_origin("1", 2, tree, 5), "c");
  EXPECT_EQ(points.front(), Eigen::Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(points.back(), Eigen::Vector3d(3.5, 3.5, 3.5));
}

TEST(Octree, WhatIsWrongIsReported) {
  const std::string node = octree_node("o0000000");
  const auto head = [](const std::string& lines) {
    return parse_message("# Octomap OcTree binary file\n" + lines);
  };
  EXPECT_EQ(parse_message(octree(0, "0.1", "")), "");
  EXPECT_EQ(head("id OcTree\nsize many\n"), "c:3: expected 'size' and one whole number");
  for (const std::string res : {"0", "-1", "nan", "inf", "1e308", "", "a"}) {
    EXPECT_EQ(head("res " + res + "\n"), "c:2: expected 'res' and the side of a voxel, above 0");
  }
  EXPECT_EQ(head("id OcTree\nres 1\ndata\n"), "c:4: the header lacks size");
  EXPECT_EQ(head("id OcTree\nsize 1\ndata\n"), "c:4: the header lacks res");
  EXPECT_EQ(head("id OcTree\nsize 1\n"), "c:3: the header does not end ('data')");
  EXPECT_EQ(head("size 1\nres 1\ndata\n"), "c: is an octree with the id '', not OcTree");
  EXPECT_EQ(head("id OcTree\nside 1\n"), "c:3: 'side' is not a word of an OctoMap header");
  EXPECT_EQ(head(std::string(20'000, '\n')), "c:10001: the header does not end ('data')");
  EXPECT_EQ(parse_message(octree_at_origin("1", 1, node, 2)),
            "c: is damaged: the header promises 18 nodes, there are 17");
  EXPECT_EQ(parse_message(octree(3, "1", octree_node("000n0000"))),
            "c: is truncated: the header promises 3 nodes, there are 2");
  // A leaf of 2^15 voxels a side, and many of 64.
  EXPECT_EQ(parse_message(octree(2, "1", node)),
            "c: has more than 4000000 occupied voxels: make its voxels larger or cut out a part "
            "first");
  std::string many = octree_node("nnnnnnnn");
  for (int i = 0; i < 8; ++i) many += octree_node("oooooooo");
  EXPECT_TRUE(has(parse_message(octree_at_origin("1", 8, many, 8 + 64)), "has more than 4000000"));
  // Nodes without end.
  std::string deep;
  for (int depth = 0; depth < 1'000'000; ++depth) deep += octree_node("n0000000");
  EXPECT_TRUE(
      has(parse_message(octree(1'000'001, "1", deep)), "the tree is deeper than 16 levels"));
}

TEST(Octree, DamagedFilesEndInAnErrorOrPoints) {
  const std::string bytes = octree_at_origin(
      "0.25", 3, octree_node("n00000on") + octree_node("ofofof00") + octree_node("0000000f"), 10);
  ASSERT_EQ(parse_message(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_TRUE(parse_message(bytes.substr(0, size)).starts_with("c")) << size;
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const char flip : {'\x01', '\x10', '\x7f'}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      const std::string message = parse_message(damaged);
      EXPECT_TRUE(message.empty() || message.starts_with("c:")) << at << message;
    }
  }
}

/// A block of 16³ voxels of this side with its corner at the origin, of one leaf and others.
std::string block(const std::string& resolution) {
  std::string tree = octree_node("nooooooo");
  tree += octree_node("oooooooo");
  return octree_at_origin(resolution, 4, tree, 16);
}

TEST(Octree, TheMapHasItsVoxels) {
  const TemporaryFolder folder;
  PointCloudSpec spec = voxels_of(folder.write("a.bt", block("0.1")), 0.1);
  spec.flight_height_m = 0.8;
  for (const double resolution_m : {0.1, 0.2, 0.4, 1.6}) {
    spec.resolution_m = resolution_m;
    const World world = make_world(spec, 1);
    EXPECT_EQ(world.prototypes[0].mesh.triangles.size(), 12U) << resolution_m;
    EXPECT_TRUE(
        world.bounds.isApprox(Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d(1.6, 1.6, 1.6)), 1e-6));
  }
  // Between multiples there are no gaps, either.
  for (const double resolution_m : {0.11, 0.15, 0.17, 0.3}) {
    spec.resolution_m = resolution_m;
    EXPECT_EQ(make_world(spec, 1).prototypes[0].mesh.triangles.size(), 12U) << resolution_m;
  }
  spec.resolution_m = 0.05;
  EXPECT_TRUE(has(message_of([&] { make_world(spec, 1); }),
                  "has voxels of 0.1 m: resolution_m 0.05 would leave gaps between them; set it to "
                  "0.1 or coarser"));
}

TEST(Octree, AnOriginBetweenVoxelsMakesNoGaps) {
  const TemporaryFolder folder;
  PointCloudSpec spec = voxels_of(folder.write("a.bt", block("0.1")), 0.1);
  spec.flight_height_m = 0.8;
  for (const UpAxis up : {UpAxis::z, UpAxis::y, UpAxis::x}) {
    for (const double origin_m : {0.05, 0.15, -0.75, 0.0499999999, 0.03, 123.45, 1234.55}) {
      spec.up_axis = up;
      spec.origin_m = {origin_m, -origin_m, 0.0};
      const World world = make_world(spec, 1);
      EXPECT_EQ(world.prototypes[0].mesh.triangles.size(), 12U) << origin_m;
      EXPECT_TRUE((world.bounds.sizes() - Eigen::Vector3d(1.6, 1.6, 1.6)).isZero(1e-3)) << origin_m;
    }
  }
}

TEST(Octree, AnOctreeLargerThanAnyIsRefusedUnread) {
  const TemporaryFolder folder;
  const PointCloudSpec spec = voxels_of(folder.write("a.bt", block("0.5")));
  std::filesystem::resize_file(spec.file, 3'000'000'000);
  EXPECT_TRUE(has(message_of([&] { make_world(spec, 1); }),
                  "is larger than 100 MB, the most for an octree"));
}

}  // namespace
}  // namespace avoidbench
