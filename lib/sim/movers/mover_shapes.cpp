#include "movers/mover_shapes.hpp"

#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

constexpr int kMoverSides = 12;
constexpr double kPersonWidth_m = 0.5, kPersonDepth_m = 0.3, kPersonHeight_m = 1.75;
constexpr double kPoleWidth_m = 0.2, kPoleHeight_m = 4.0;

/// A tube around the upright axis through (height, radius) pairs from the foot up.
template <std::size_t count>
Prototype upright(std::string_view name, const std::array<std::array<double, 2>, count>& outline,
                  Material material) {
  std::array<TubeRing, count> rings;
  for (std::size_t i = 0; i < count; ++i) {
    rings[i] = {.centre = {0.0, 0.0, outline[i][0]}, .radius_m = outline[i][1]};
  }
  Prototype prototype;
  prototype.name = name;
  add_tube(prototype, rings, kMoverSides, material);
  return prototype;
}

/// Legs, hips, shoulders and head of a width of 1, then drawn wide and flat: who walks along +x has
/// the shoulders along y.
Prototype person() {
  constexpr std::array<std::array<double, 2>, 9> kOutline{{{0.0, 0.24},
                                                           {0.45, 0.28},
                                                           {0.9, 0.38},
                                                           {1.3, 0.5},
                                                           {1.42, 0.46},
                                                           {1.5, 0.2},
                                                           {1.58, 0.22},
                                                           {1.69, 0.18},
                                                           {kPersonHeight_m, 0.0}}};
  Prototype prototype = upright("person", kOutline, Material::brick);
  for (Eigen::Vector3f& vertex : prototype.mesh.vertices) {
    vertex.x() *= static_cast<float>(kPersonDepth_m);
    vertex.y() *= static_cast<float>(kPersonWidth_m);
  }
  return prototype;
}

Prototype ball() {
  constexpr std::size_t kRings = 8;
  std::array<std::array<double, 2>, kRings + 1> outline{};
  for (std::size_t i = 0; i <= kRings; ++i) {
    const double angle_rad = math::kPi * static_cast<double>(i) / static_cast<double>(kRings);
    outline[i] = {-0.5 * math::cos(angle_rad), 0.5 * math::sin(angle_rad)};
  }
  // The lower pole is a small face, the upper one a point.
  outline.front()[1] = 1e-3;
  outline.back()[1] = 0.0;
  return upright("ball", outline, Material::painted_metal);
}

}  // namespace

MoverShape mover_shape(MoverKind kind, double size_m) {
  switch (kind) {
    case MoverKind::person:
      return {kind, 1.0, kPersonWidth_m, kPersonHeight_m, true};
    case MoverKind::pole:
      return {kind, 1.0, kPoleWidth_m, kPoleHeight_m, true};
    case MoverKind::box:
      return {kind, size_m, std::sqrt(2.0) * size_m, size_m, false};
    case MoverKind::ball:
      return {kind, size_m, size_m, size_m, false};
    case MoverKind::mixed:
      break;
  }
  AB_CHECK(false, "a mover is of one kind");
  return {};
}

Prototype mover_prototype(MoverKind kind) {
  if (kind == MoverKind::person) return person();
  if (kind == MoverKind::ball) return ball();
  Prototype prototype;
  if (kind == MoverKind::box) {
    prototype.name = "box";
    add_box(prototype, Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5),
            Material::painted_metal);
    return prototype;
  }
  constexpr std::array<std::array<double, 2>, 2> kOutline{
      {{0.0, 0.5 * kPoleWidth_m}, {kPoleHeight_m, 0.5 * kPoleWidth_m}}};
  return upright("pole", kOutline, Material::concrete);
}

}  // namespace avoidbench
