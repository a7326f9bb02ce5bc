#include "world/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "base/math.hpp"

namespace avoidbench {
namespace {

/// Each edge is run through once each way: closed, and all triangles turn the same way.
void expect_closed(const Prototype& shell) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : shell.mesh.triangles) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      edges[{from, to}] += 1;
    }
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << ' ' << edge.second;
    ASSERT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << ' ' << edge.second;
  }
  EXPECT_EQ(shell.triangle_materials.size(), shell.mesh.triangles.size());
}

/// Inside the triangles, by the divergence theorem: positive where they turn outwards.
double volume_m3(const Prototype& shell) {
  double sum = 0.0;
  for (const auto& [a, b, c] : shell.mesh.triangles) {
    const Eigen::Vector3d va = shell.mesh.vertices[a].cast<double>();
    const Eigen::Vector3d vb = shell.mesh.vertices[b].cast<double>();
    sum += va.dot(vb.cross(shell.mesh.vertices[c].cast<double>())) / 6.0;
  }
  return sum;
}

double radius_m(const Prototype& shell, std::size_t vertex) {
  return static_cast<double>(shell.mesh.vertices[vertex].norm());
}

TEST(Solids, ATuftsFacesAreThoseOfAnIcosahedron) {
  Prototype tuft;
  add_tuft(tuft, {.lumps_ratio = 0.0, .tips_ratio = 0.0, .seed = 3}, Material::leaf);
  expect_closed(tuft);
  ASSERT_EQ(tuft.mesh.vertices.size(), 12U + 20U);
  ASSERT_EQ(tuft.mesh.triangles.size(), 60U);
  // Of a triangle with its tip, the first two corners are an edge of the icosahedron.
  const double edge_m = 0.85 * 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
  for (const auto& [a, b, tip] : tuft.mesh.triangles) {
    ASSERT_NEAR((tuft.mesh.vertices[a] - tuft.mesh.vertices[b]).norm(), edge_m, 1e-6);
    ASSERT_GE(tip, 12U);
  }
  for (std::size_t i = 0; i < tuft.mesh.vertices.size(); ++i) {
    ASSERT_NEAR(radius_m(tuft, i), 0.85, 1e-6);
  }
  // More than the icosahedron's, less than the ball's.
  const double cubed = 0.85 * 0.85 * 0.85;
  EXPECT_GT(volume_m3(tuft), cubed * 2.5361507);
  EXPECT_LT(volume_m3(tuft), cubed * math::kPi * 4.0 / 3.0);
}

TEST(Solids, ASubdividedTuftIsNearlyABall) {
  Prototype tuft;
  add_tuft(tuft, {.subdivisions = 3, .lumps_ratio = 0.0, .tips_ratio = 0.0}, Material::leaf);
  expect_closed(tuft);
  EXPECT_EQ(tuft.mesh.triangles.size(), 60U * 64U);
  const double ball_m3 = 0.85 * 0.85 * 0.85 * math::kPi * 4.0 / 3.0;
  EXPECT_NEAR(volume_m3(tuft), ball_m3, 0.01 * ball_m3);
}

TEST(Solids, TipsAndLumpsHaveTheHeightsTheyAreGiven) {
  Prototype tuft;
  const TuftShape shape{.centre = {1.0, 2.0, 3.0},
                        .axes = Eigen::Vector3d(1.0, 2.0, 0.5).asDiagonal(),
                        .subdivisions = 1,
                        .lumps_ratio = 0.3,
                        .tips_ratio = 0.4,
                        .seed = 5};
  add_tuft(tuft, shape, Material::leaf);
  expect_closed(tuft);
  const std::size_t shell_count = 42;  // vertices of an icosahedron divided once
  double least_m = 9.0, most_m = 0.0, most_tip_m = 0.0;
  for (std::size_t i = 0; i < tuft.mesh.vertices.size(); ++i) {
    const Eigen::Vector3d place = tuft.mesh.vertices[i].cast<double>() - shape.centre;
    const double radius = place.cwiseQuotient(Eigen::Vector3d(1.0, 2.0, 0.5)).norm();
    if (i < shell_count) {
      least_m = std::min(least_m, radius);
      most_m = std::max(most_m, radius);
    } else {
      most_tip_m = std::max(most_tip_m, radius);
      // Tips stand on the shell, by a tenth of tips_ratio at least.
      EXPECT_GT(radius, 0.85 - 0.3 + 0.1 * 0.4);
    }
  }
  EXPECT_LT(least_m, 0.80);
  EXPECT_GT(most_m, 0.90);
  EXPECT_GT(least_m, 0.85 - 0.3);
  EXPECT_LT(most_m, 0.85 + 0.3);
  EXPECT_GT(most_tip_m, most_m);
  EXPECT_LT(most_tip_m, 0.85 + 0.3 + 0.4);
}

TEST(Solids, ATubeHasTheVolumeOfItsPrismAndItsCone) {
  // Sides of 1 m, radius 2 m: a hexagon's area is 3√3/2 r².
  const double area_m2 = 1.5 * std::sqrt(3.0) * 4.0;
  const std::vector<TubeRing> rings{{.centre = {5.0, -1.0, 0.0}, .radius_m = 2.0},
                                    {.centre = {5.0, -1.0, 3.0}, .radius_m = 2.0}};
  Prototype prism;
  add_tube(prism, rings, 6, Material::bark);
  expect_closed(prism);
  EXPECT_NEAR(volume_m3(prism), 3.0 * area_m2, 1e-4);
  Prototype spike;
  const std::vector<TubeRing> pointed{rings[0], {.centre = {5.0, -1.0, 3.0}, .radius_m = 0.0}};
  add_tube(spike, pointed, 6, Material::bark);
  expect_closed(spike);
  EXPECT_NEAR(volume_m3(spike), area_m2, 1e-4);
}

TEST(Solids, ATubesLobesAreFive) {
  const std::vector<TubeRing> rings{{.centre = {0.0, 0.0, 0.0}, .radius_m = 1.0, .lobe_ratio = 0.2},
                                    {.centre = {0.0, 0.0, 1.0}, .radius_m = 1.0}};
  Prototype tube;
  add_tube(tube, rings, 20, Material::bark);
  for (std::size_t k = 0; k < 20; ++k) {
    const double angle = math::kTau * static_cast<double>(k) / 20.0;
    ASSERT_NEAR(radius_m(tube, k), 1.0 + 0.2 * std::cos(5.0 * angle), 1e-6) << k;
  }
}

TEST(Solids, ABentTubeDoesNotTwist) {
  std::vector<TubeRing> rings;
  for (int i = 0; i <= 8; ++i) {
    const double angle = math::kPi / 16.0 * i;
    rings.push_back(
        {.centre = {4.0 * std::cos(angle), 0.0, 4.0 * std::sin(angle)}, .radius_m = 0.5});
  }
  Prototype tube;
  add_tube(tube, rings, 8, Material::bark);
  expect_closed(tube);
  // Corner k of each ring has the same part along y, across the bend.
  for (std::size_t k = 0; k < 8; ++k) {
    for (std::size_t ring = 1; ring < rings.size(); ++ring) {
      ASSERT_NEAR(tube.mesh.vertices[ring * 8 + k].y(), tube.mesh.vertices[k].y(), 1e-5);
    }
  }
}

TEST(Solids, ABoxIsFilled) {
  Prototype box;
  add_box(box, {1.0, -2.0, 0.5}, {3.0, 1.0, 4.5}, Material::concrete);
  expect_closed(box);
  EXPECT_EQ(box.mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume_m3(box), 2.0 * 3.0 * 4.0, 1e-5);
}

}  // namespace
}  // namespace avoidbench
