#include "world/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "world/noise.hpp"

namespace avoidbench {
namespace {

constexpr int kLobes = 5;

void add_triangle(Prototype& prototype, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  Material material) {
  prototype.mesh.triangles.push_back({a, b, c});
  prototype.triangle_materials.push_back(material);
}

std::uint32_t add_vertex(Prototype& prototype, const Eigen::Vector3d& position) {
  prototype.mesh.vertices.push_back(position.cast<float>());
  return static_cast<std::uint32_t>(prototype.mesh.vertices.size() - 1);
}

/// A unit vector across `axis`, as near to `wanted` as can be.
Eigen::Vector3d across(const Eigen::Vector3d& axis, const Eigen::Vector3d& wanted) {
  const Eigen::Vector3d part = wanted - axis * axis.dot(wanted);
  if (part.squaredNorm() > 1e-12) return part.normalized();
  // `wanted` lies along the axis: any direction that does not.
  const Eigen::Vector3d other =
      std::abs(axis.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return (other - axis * axis.dot(other)).normalized();
}

struct UnitSphere {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

UnitSphere icosahedron() {
  // The golden ratio: corners of three rectangles across each other.
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  UnitSphere sphere;
  sphere.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3d& vertex : sphere.vertices) vertex.normalize();
  sphere.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return sphere;
}

/// With each triangle cut into four by the middles of its edges, moved out to the sphere.
UnitSphere subdivided(const UnitSphere& coarse) {
  UnitSphere fine;
  fine.vertices = coarse.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  // Two triangles share an edge: its middle becomes one vertex, so that the shell stays closed.
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back((coarse.vertices[a] + coarse.vertices[b]).normalized());
    return entry->second;
  };
  // Four triangles for each, which turn as it does.
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({b, bc, ab});
    fine.triangles.push_back({c, ca, bc});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace

void add_tube(Prototype& prototype, std::span<const TubeRing> rings, int sides, Material material) {
  AB_CHECK(rings.size() >= 2 && sides >= 3, rings.size(), sides);
  const auto count = static_cast<std::uint32_t>(sides);
  const bool pointed = rings.back().radius_m <= 0.0;
  const std::size_t full_rings = rings.size() - (pointed ? 1U : 0U);
  const auto first = static_cast<std::uint32_t>(prototype.mesh.vertices.size());

  Eigen::Vector3d side = Eigen::Vector3d::UnitX();
  for (std::size_t i = 0; i < full_rings; ++i) {
    const Eigen::Vector3d& before = rings[i > 0 ? i - 1 : 0].centre;
    const Eigen::Vector3d& after = rings[std::min(i + 1, rings.size() - 1)].centre;
    // A ring lies across the direction from its neighbour before to that after.
    const Eigen::Vector3d axis = (after - before).normalized();
    // From the side of the ring before, so that the tube does not twist.
    side = across(axis, side);
    const Eigen::Vector3d other = axis.cross(side);
    for (int k = 0; k < sides; ++k) {
      const double angle = math::kTau * k / sides;
      const double radius =
          rings[i].radius_m * (1.0 + rings[i].lobe_ratio * math::cos(kLobes * angle));
      const Eigen::Vector3d corner =
          rings[i].centre + radius * (math::cos(angle) * side + math::sin(angle) * other);
      add_vertex(prototype, corner);
    }
  }
  // The walls, two triangles a side.
  for (std::uint32_t i = 0; i + 1 < full_rings; ++i) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = first + i * count + k;
      const std::uint32_t b = first + i * count + (k + 1) % count;
      add_triangle(prototype, a, b, b + count, material);
      add_triangle(prototype, a, b + count, a + count, material);
    }
  }
  const std::uint32_t last = first + static_cast<std::uint32_t>(full_rings - 1) * count;
  // The ends, as fans around their first corner.
  for (std::uint32_t k = 1; k + 1 < count; ++k) {
    add_triangle(prototype, first, first + k + 1, first + k, material);
    if (!pointed) add_triangle(prototype, last, last + k, last + k + 1, material);
  }
  if (pointed) {
    const std::uint32_t tip = add_vertex(prototype, rings.back().centre);
    for (std::uint32_t k = 0; k < count; ++k) {
      add_triangle(prototype, last + k, last + (k + 1) % count, tip, material);
    }
  }
}

void add_tuft(Prototype& prototype, const TuftShape& shape, Material material) {
  UnitSphere sphere = icosahedron();
  for (int i = 0; i < shape.subdivisions; ++i) sphere = subdivided(sphere);
  const auto first = static_cast<std::uint32_t>(prototype.mesh.vertices.size());
  RandomStream tips(shape.seed);
  const auto shell_radius = [&](const Eigen::Vector3d& direction) {
    // A floor, since a deep lump would turn the shell inside out.
    return std::max(0.25, 0.85 + shape.lumps_ratio * gradient_noise(1.7 * direction, shape.seed));
  };
  for (const Eigen::Vector3d& direction : sphere.vertices) {
    add_vertex(prototype, shape.centre + shape.axes * (shell_radius(direction) * direction));
  }
  // Each triangle becomes three around a tip above it, somewhere between its corners.
  for (const auto& [a, b, c] : sphere.triangles) {
    const double shift_a = tips.uniform(0.15, 2.5);
    const double shift_b = tips.uniform(0.15, 2.5);
    const double draw = tips.uniform();
    // Squared: most tips are short, few long.
    const double height = shape.tips_ratio * (0.1 + 0.9 * draw * draw);
    const Eigen::Vector3d direction =
        (shift_a * sphere.vertices[a] + shift_b * sphere.vertices[b] + sphere.vertices[c])
            .normalized();
    const double radius = shell_radius(direction) + height;
    const std::uint32_t tip =
        add_vertex(prototype, shape.centre + shape.axes * (radius * direction));
    add_triangle(prototype, first + a, first + b, tip, material);
    add_triangle(prototype, first + b, first + c, tip, material);
    add_triangle(prototype, first + c, first + a, tip, material);
  }
}

void add_box(Prototype& prototype, const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest,
             Material material) {
  const auto first = static_cast<std::uint32_t>(prototype.mesh.vertices.size());
  // Corner i has bit 0 for x, bit 1 for y, bit 2 for z.
  for (std::uint32_t i = 0; i < 8; ++i) {
    add_vertex(prototype, {(i & 1U) != 0U ? highest.x() : lowest.x(),
                           (i & 2U) != 0U ? highest.y() : lowest.y(),
                           (i & 4U) != 0U ? highest.z() : lowest.z()});
  }
  // At -z, +z, -y, +y, -x and +x; counter-clockwise seen from outside.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    add_triangle(prototype, first + a, first + b, first + c, material);
    add_triangle(prototype, first + a, first + c, first + d, material);
  }
}

}  // namespace avoidbench
