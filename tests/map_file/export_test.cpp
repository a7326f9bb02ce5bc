#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>

#include "base/input_error.hpp"
#include "map_file/export_map.hpp"
#include "maps/map_spec.hpp"
#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

class Export : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("avoidbench_export_" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
};

std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A box 1 × 2 × 3 m whose surface is the whole world.
World box_world() {
  World world = test::world_of(test::box_mesh({1.0F, 2.0F, 3.0F}));
  world.bounds = Aabb(Eigen::Vector3d(-1.0, -2.0, -3.0), Eigen::Vector3d(1.0, 2.0, 3.0));
  return world;
}

TEST(Voxels, AreTheShellOfABox) {
  // 0.1 m cells whose sides the box's faces lie on belong to both: faces are shifted by 0.05 m.
  World world = box_world();
  world.bounds.translate(Eigen::Vector3d(0.05, 0.05, 0.05));
  const VoxelGrid grid = surface_voxels(world, 0.1);
  EXPECT_EQ(grid.columns, 20U);
  EXPECT_EQ(grid.rows, 40U);
  EXPECT_EQ(grid.layers, 60U);
  const auto count = std::accumulate(grid.is_occupied.begin(), grid.is_occupied.end(), 0L);
  // Faces through the middle of cells: 11 × 21 × 31 cells without those inside.
  EXPECT_EQ(count, 11 * 21 * 31 - 9 * 19 * 29);
}

TEST(Voxels, RefuseMoreThanMemoryHolds) {
  EXPECT_THROW(surface_voxels(box_world(), 1e-3), InputError);
}

TEST_F(Export, MeshesBeginAsTheirFormatDoes) {
  const World world = make_world(HallSpec{.poisson_radius_m = 6.0}, 1);
  export_mesh(world, folder / "m.glb");
  EXPECT_EQ(bytes_of(folder / "m.glb").substr(0, 4), "glTF");
  export_mesh(world, folder / "m.ply");
  EXPECT_EQ(bytes_of(folder / "m.ply").substr(0, 4), "ply\n");
  export_mesh(world, folder / "m.stl");
  const std::string stl = bytes_of(folder / "m.stl");
  std::uint32_t count = 0;
  ASSERT_GE(stl.size(), 84U);
  std::memcpy(&count, stl.data() + 80, 4);
  EXPECT_EQ(count, triangle_count(world));
  export_mesh(world, folder / "m.obj");
  std::istringstream obj(bytes_of(folder / "m.obj"));
  std::size_t faces = 0;
  for (std::string line; std::getline(obj, line);) faces += line.starts_with("f ") ? 1U : 0U;
  EXPECT_EQ(faces, triangle_count(world));
  EXPECT_THROW(export_mesh(world, folder / "m.xyz"), InputError);
  EXPECT_THROW(export_mesh(world, folder / "no" / "m.ply"), InputError);
}

TEST_F(Export, CloudAndOccupancyHoldTheSameCells) {
  const VoxelGrid grid = surface_voxels(box_world(), 0.25);
  const auto count = std::accumulate(grid.is_occupied.begin(), grid.is_occupied.end(), 0L);
  export_point_cloud(grid, folder / "c.ply");
  const std::string cloud = bytes_of(folder / "c.ply");
  EXPECT_NE(cloud.find("element vertex " + std::to_string(count) + "\n"), std::string::npos);
  const std::size_t header = cloud.find("end_header\n") + 11;
  EXPECT_EQ(cloud.size() - header, static_cast<std::size_t>(count) * 12);
  export_occupancy(grid, folder / "o.npy");
  const std::string array = bytes_of(folder / "o.npy");
  EXPECT_EQ(array.substr(1, 5), "NUMPY");
  EXPECT_NE(array.find("'shape': (24, 16, 8)"), std::string::npos);
  EXPECT_EQ((array.size() - grid.is_occupied.size()) % 64, 0U);
  EXPECT_EQ(array.substr(array.size() - grid.is_occupied.size()),
            std::string(grid.is_occupied.begin(), grid.is_occupied.end()));
  EXPECT_NE(bytes_of(folder / "o.npy.json").find("\"resolution_m\": 0.25"), std::string::npos);
}

}  // namespace
}  // namespace avoidbench
