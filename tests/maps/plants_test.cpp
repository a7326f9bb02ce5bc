#include "maps/plants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "geometry/box_triangle.hpp"
#include "maps/map_spec.hpp"

namespace avoidbench {
namespace {

std::vector<PlantModel> all_models() {
  std::vector<PlantModel> models = tree_models();
  for (PlantModel& bush : bush_models()) models.push_back(std::move(bush));
  return models;
}

Triangle corners(const Prototype& prototype, std::size_t triangle) {
  Triangle corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = prototype.mesh.triangles[triangle][k];
    corners[k] = prototype.mesh.vertices[vertex].cast<double>();
  }
  return corners;
}

/// The shell each triangle belongs to: triangles that share vertices.
std::vector<std::uint32_t> shells(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::vector<std::uint32_t> shell;
  for (const auto& triangle : mesh.triangles) shell.push_back(root(triangle[0]));
  return shell;
}

void expect_sane(const Prototype& prototype) {
  SCOPED_TRACE(prototype.name);
  ASSERT_EQ(prototype.triangle_materials.size(), prototype.mesh.triangles.size());
  for (const auto& triangle : prototype.mesh.triangles) {
    for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, prototype.mesh.vertices.size());
  }
  for (const Eigen::Vector3f& vertex : prototype.mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  std::size_t degenerate_count = 0;
  for (std::size_t i = 0; i < prototype.mesh.triangles.size(); ++i) {
    const Triangle t = corners(prototype, i);
    if ((t[1] - t[0]).cross(t[2] - t[0]).norm() < 1e-9) ++degenerate_count;
  }
  EXPECT_LE(degenerate_count, prototype.mesh.triangles.size() / 200);
}

void expect_closed_and_outward(const Prototype& prototype) {
  SCOPED_TRACE(prototype.name);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : prototype.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  const std::vector<std::uint32_t> shell = shells(prototype.mesh);
  std::map<std::uint32_t, double> volumes;
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const Triangle t = corners(prototype, i);
    const Eigen::Vector3d reference = prototype.mesh.vertices[shell[i]].cast<double>();
    volumes[shell[i]] += (t[0] - reference).dot((t[1] - reference).cross(t[2] - reference)) / 6.0;
  }
  for (const auto& [vertex, volume] : volumes) EXPECT_GT(volume, 0.0) << vertex;
}

TEST(Plants, AreSaneClosedAndOutward) {
  for (const PlantModel& model : all_models()) {
    expect_sane(model.prototype);
    expect_closed_and_outward(model.prototype);
  }
}

TEST(Plants, HallPrototypesAreSaneClosedAndOutward) {
  const World world = make_world(HallSpec{}, 3);
  EXPECT_GT(world.prototypes.size(), 1U);
  for (const Prototype& prototype : world.prototypes) {
    expect_sane(prototype);
    expect_closed_and_outward(prototype);
  }
}

TEST(Plants, KeepTheTriangleBudget) {
  for (const PlantModel& model : all_models()) {
    EXPECT_GE(model.prototype.mesh.triangles.size(), 1000U) << model.prototype.name;
    EXPECT_LE(model.prototype.mesh.triangles.size(), 3000U) << model.prototype.name;
  }
}

TEST(Plants, ThereAreSixTreesAndFourBushesAllDifferent) {
  EXPECT_EQ(tree_models().size(), 6U);
  EXPECT_EQ(bush_models().size(), 4U);
  std::set<std::string> names;
  for (const PlantModel& model : all_models()) names.insert(model.prototype.name);
  EXPECT_EQ(names.size(), 10U);
}

TEST(Plants, TreesHaveBoughsAndFoliageWhereVehiclesFly) {
  for (const PlantModel& model : tree_models()) {
    bool bark_beside_trunk = false, leaves = false;
    for (std::size_t i = 0; i < model.prototype.mesh.triangles.size(); ++i) {
      const Triangle t = corners(model.prototype, i);
      const Eigen::Vector3d middle = (t[0] + t[1] + t[2]) / 3.0;
      if (middle.z() < 0.5 || middle.z() > 4.5) continue;
      const bool beside = middle.head<2>().norm() > 0.6;
      const Material material = model.prototype.triangle_materials[i];
      bark_beside_trunk |= beside && material == Material::bark;
      leaves |= beside && material == Material::leaf;
    }
    EXPECT_TRUE(bark_beside_trunk && leaves) << model.prototype.name;
  }
}

TEST(Plants, BushesAreAsHighAsSaid) {
  float tallest_m = 0.0F;
  for (const PlantModel& model : bush_models()) {
    float top_m = 0.0F;
    for (const Eigen::Vector3f& v : model.prototype.mesh.vertices) top_m = std::max(top_m, v.z());
    EXPECT_GT(top_m * 0.82F, 0.6F) << model.prototype.name;
    EXPECT_LT(top_m * 1.18F, 2.3F) << model.prototype.name;
    tallest_m = std::max(tallest_m, top_m);
  }
  EXPECT_GT(tallest_m * 1.18F, 2.0F);
}

TEST(Plants, ATreeIsAsWideAsItsTrunk) {
  for (const PlantModel& model : tree_models()) {
    // The trunk's corners near one of its rings lie on a circle of that diameter, less for a
    // flat-sided trunk.
    const double height_m = model.trunk_heights_m[5];
    EXPECT_DOUBLE_EQ(obstacle_width_m(model, 1.0, height_m), 2.0 * model.trunk_radii_m[5]);
    EXPECT_DOUBLE_EQ(obstacle_width_m(model, 1.2, 1.2 * height_m), 2.4 * model.trunk_radii_m[5]);
    EXPECT_GT(obstacle_width_m(model, 1.0, 0.1), obstacle_width_m(model, 1.0, 3.0));
    EXPECT_GE(obstacle_width_m(model, 1.0, 100.0), 0.0);
  }
}

TEST(Plants, ABushIsAsWideAsItsMeshBelowFlight) {
  PlantModel cube;
  for (const float z : {0.0F, 3.0F}) {
    const float half = z > 0.0F ? 5.0F : 1.0F;
    for (const float x : {-half, half}) {
      for (const float y : {-half, half}) cube.prototype.mesh.vertices.emplace_back(x, y, z);
    }
  }
  EXPECT_NEAR(obstacle_width_m(cube, 1.0, 2.0), 2.0 * std::sqrt(2.0), 0.02);
  EXPECT_NEAR(obstacle_width_m(cube, 1.0, 4.0), 10.0 * std::sqrt(2.0), 0.1);
  EXPECT_NEAR(obstacle_width_m(cube, 0.5, 2.0), 5.0 * std::sqrt(2.0), 0.1);
}

}  // namespace
}  // namespace avoidbench
