#include "render/materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "render/value_noise.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

Vector3f mix(const Vector3f& a, const Vector3f& b, float t) { return a + (b - a) * t; }

/// 0 below `low`, 1 above `high`, smooth between.
float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// Part of detail of this size that a pixel still resolves.
float seen(float size_m, float footprint_m) {
  return std::clamp(2.0F - 2.0F * footprint_m / size_m, 0.0F, 1.0F);
}

/// Three noises at once, each in [-1, 1]: relief.
Vector3f tilt_noise(const Vector3f& point, std::uint32_t seed) {
  const float x = value_noise(point, seed);
  const float y = value_noise(point, seed + 101U);
  const float z = value_noise(point, seed + 202U);
  return Vector3f(2.0F * x - 1.0F, 2.0F * y - 1.0F, 2.0F * z - 1.0F);
}

SurfaceLook soil(const SurfacePoint& p) {
  const Vector3f& at = p.position_object;
  const float patches = fractal_value_noise(at / 3.5F, 5, p.footprint_m / 3.5F, 11U);
  const float tone = fractal_value_noise(at / 9.0F, 3, p.footprint_m / 9.0F, 23U);
  const float blades = fractal_value_noise(at / 0.16F, 3, p.footprint_m / 0.16F, 37U);
  const float crumbs = fractal_value_noise(at / 0.09F, 3, p.footprint_m / 0.09F, 53U);
  const Vector3f earth = mix({0.085F, 0.052F, 0.030F}, {0.26F, 0.18F, 0.11F}, crumbs);
  const Vector3f fresh = mix({0.028F, 0.060F, 0.014F}, {0.16F, 0.25F, 0.055F}, blades);
  const Vector3f dry = mix({0.10F, 0.085F, 0.030F}, {0.36F, 0.30F, 0.12F}, blades);
  const Vector3f grass = mix(fresh, dry, smooth_step(0.42F, 0.68F, tone));
  SurfaceLook look;
  look.albedo = mix(earth, grass, smooth_step(0.40F, 0.54F, patches + 0.22F * (blades - 0.5F)));
  look.normal_tilt = 0.45F * seen(0.12F, p.footprint_m) * tilt_noise(at / 0.12F, 71U);
  look.crevice = 0.75F + 0.5F * (blades - 0.25F);
  return look;
}

SurfaceLook bark(const SurfacePoint& p) {
  // Streaks run up the stem: they are long in z and narrow around it.
  const Vector3f streaked(p.position_object.x(), p.position_object.y(),
                          p.position_object.z() * 0.22F);
  const float plates =
      fractal_value_noise(streaked / 0.06F, 4, p.footprint_m / 0.06F, p.object_seed);
  const float blotches =
      fractal_value_noise(p.position_object / 0.7F, 3, p.footprint_m / 0.7F, p.object_seed + 7U);
  const float crack = smooth_step(0.34F, 0.52F, plates);
  SurfaceLook look;
  look.albedo = mix({0.030F, 0.020F, 0.014F}, {0.24F, 0.165F, 0.11F}, crack);
  look.albedo *= 0.65F + 0.7F * blotches;
  const float moss =
      smooth_step(0.55F, 0.75F, blotches) * smooth_step(2.5F, 0.0F, p.position_object.z());
  look.albedo = mix(look.albedo, {0.085F, 0.12F, 0.035F}, 0.6F * moss);
  look.normal_tilt = 0.7F * seen(0.055F, p.footprint_m) * tilt_noise(streaked / 0.055F, 91U);
  look.crevice = 0.55F + 0.45F * crack;
  return look;
}

SurfaceLook leaf(const SurfacePoint& p) {
  const Vector3f& at = p.position_object;
  const float plant = lattice_value(0, 0, 0, p.object_seed);
  const float cluster = value_noise(at / 0.45F, p.object_seed + 3U);
  const Vector3f dark = mix({0.020F, 0.050F, 0.010F}, {0.045F, 0.060F, 0.010F}, plant);
  const Vector3f light = mix({0.10F, 0.22F, 0.034F}, {0.25F, 0.28F, 0.045F}, plant);
  SurfaceLook look;
  look.translucency = 0.55F;
  look.normal_tilt = 0.45F * tilt_noise(at / 0.4F, 171U);
  // Single leaves, each of its own tone and tilt, with the dark of the crown between them.
  constexpr float kLeaf = 0.085F;
  const float visible = seen(kLeaf, p.footprint_m);
  float tone = 0.25F + 0.5F * cluster;
  float between = 0.35F;
  if (visible > 0.0F) {
    const Cell cell = nearest_cell(at / kLeaf, p.object_seed);
    const auto part = [&](unsigned shift) {
      return static_cast<float>((cell.hash >> shift) & 0xffU) / 255.0F;
    };
    tone += visible * 0.6F * (part(3U) - 0.5F);
    between += visible * (smooth_step(0.12F, 0.42F, cell.square_distance) - 0.35F);
    look.normal_tilt +=
        visible * 1.3F * Vector3f(part(7U) - 0.5F, part(13U) - 0.5F, part(21U) - 0.5F);
  }
  look.albedo = mix(dark, light, std::clamp(tone, 0.0F, 1.0F)) * (1.25F - 0.95F * between);
  look.crevice = 1.0F - 0.65F * between;
  return look;
}

/// Coordinates along the surface: the two axes of the object that the normal points least along.
Vector2f along_surface(const SurfacePoint& p) {
  const Vector3f size = p.normal_object.cwiseAbs();
  const Vector3f& at = p.position_object;
  if (size.z() >= size.x() && size.z() >= size.y()) return {at.x(), at.y()};
  return size.x() >= size.y() ? Vector2f(at.y(), at.z()) : Vector2f(at.x(), at.z());
}

SurfaceLook brick(const SurfacePoint& p) {
  constexpr float kLength = 0.40F, kHeight = 0.16F, kMortar = 0.014F;
  const Vector2f at = along_surface(p);
  const float row = std::floor(at.y() / kHeight);
  const auto course = static_cast<std::int32_t>(row);
  const float x = at.x() / kLength + ((course & 1) != 0 ? 0.5F : 0.0F);
  const float column = std::floor(x);
  const float to_side = std::min(x - column, column + 1.0F - x) * kLength;
  const float to_bed = std::min(at.y() - row * kHeight, (row + 1.0F) * kHeight - at.y());
  const float edge = 0.5F * p.footprint_m + 0.003F;
  const float inside =
      smooth_step(0.5F * kMortar - edge, 0.5F * kMortar + edge, std::min(to_side, to_bed));
  const float shade = lattice_value(static_cast<std::int32_t>(column), course, 0, p.object_seed);
  const float kiln = lattice_value(static_cast<std::int32_t>(column), course, 1, p.object_seed);
  const float grain = fractal_value_noise(p.position_object / 0.06F, 3, p.footprint_m / 0.06F, 5U);
  const float stain = fractal_value_noise(p.position_object / 1.6F, 4, p.footprint_m / 1.6F, 9U);
  Vector3f clay = mix({0.22F, 0.075F, 0.045F}, {0.46F, 0.19F, 0.11F}, shade);
  clay = mix(clay, {0.17F, 0.085F, 0.07F}, kiln > 0.82F ? 0.8F : 0.0F);
  const Vector3f mortar(0.40F, 0.38F, 0.34F);
  SurfaceLook look;
  look.albedo = mix(mortar, clay, inside) * (0.55F + 0.55F * grain + 0.5F * (stain - 0.25F));
  look.crevice = 0.75F + 0.25F * inside;
  return look;
}

SurfaceLook concrete(const SurfacePoint& p) {
  const Vector3f& at = p.position_object;
  const float stain = fractal_value_noise(at / 2.2F, 5, p.footprint_m / 2.2F, p.object_seed);
  const float grit = fractal_value_noise(at / 0.05F, 3, p.footprint_m / 0.05F, 41U);
  const Vector2f slab = along_surface(p) / 3.0F;
  const Vector2f joint(std::abs(slab.x() - std::floor(slab.x() + 0.5F)),
                       std::abs(slab.y() - std::floor(slab.y() + 0.5F)));
  const float width_m = 0.012F + 0.5F * p.footprint_m;
  const float groove = 1.0F - smooth_step(0.4F * width_m, width_m, 3.0F * joint.minCoeff());
  SurfaceLook look;
  look.albedo = mix({0.15F, 0.147F, 0.14F}, {0.36F, 0.35F, 0.33F}, stain);
  look.albedo *= (0.72F + 0.56F * grit) * (1.0F - 0.55F * groove * 0.012F / width_m);
  return look;
}

SurfaceLook painted_metal(const SurfacePoint& p) {
  static const std::array<Vector3f, 6> kPaints{
      Vector3f(0.78F, 0.50F, 0.045F), Vector3f(0.55F, 0.075F, 0.050F),
      Vector3f(0.055F, 0.19F, 0.46F), Vector3f(0.075F, 0.34F, 0.16F),
      Vector3f(0.70F, 0.26F, 0.040F), Vector3f(0.050F, 0.055F, 0.060F)};
  const Vector3f& at = p.position_object;
  const Vector3f& paint = kPaints[lattice_hash(1, 2, 3, p.object_seed) % kPaints.size()];
  // Stripes wind around the object's z axis, one turn a period, so that they close on themselves.
  constexpr float kPeriod = 0.9F;
  const auto turn = static_cast<float>(
      math::atan2(static_cast<double>(at.y()), static_cast<double>(at.x())) / math::kTau);
  const float phase = at.z() / kPeriod + turn + lattice_value(4, 5, 6, p.object_seed);
  const float saw = std::abs(2.0F * (phase - std::floor(phase)) - 1.0F);
  const float blur = p.footprint_m / kPeriod + 0.01F;
  const float stripe = smooth_step(0.5F - blur, 0.5F + blur, saw);
  const float wear = fractal_value_noise(at / 0.5F, 5, p.footprint_m / 0.5F, p.object_seed + 17U);
  const float scratch = fractal_value_noise(Vector3f(at.x(), at.y(), 4.0F * at.z()) / 0.07F, 3,
                                            p.footprint_m / 0.018F, p.object_seed + 19U);
  SurfaceLook look;
  look.albedo = mix(paint, {0.62F, 0.61F, 0.58F}, stripe) * (0.60F + 0.8F * scratch);
  look.albedo = mix(look.albedo, {0.13F, 0.075F, 0.045F}, smooth_step(0.60F, 0.74F, wear));
  return look;
}

/// About the mean of each material, in the order of the enum: what a bland surface looks like.
Vector3f bland_albedo(Material material) {
  static const std::array<Vector3f, 7> kMeans{
      Vector3f(0.13F, 0.12F, 0.055F), Vector3f(0.14F, 0.10F, 0.07F),  Vector3f(0.10F, 0.15F, 0.03F),
      Vector3f(0.33F, 0.14F, 0.09F),  Vector3f(0.25F, 0.245F, 0.23F), Vector3f(0.45F, 0.44F, 0.42F),
      Vector3f(0.90F, 0.88F, 0.82F)};
  return kMeans[static_cast<std::size_t>(material)];
}

SurfaceLook textured_look(const SurfacePoint& point) {
  switch (point.material) {
    case Material::soil:
      return soil(point);
    case Material::bark:
      return bark(point);
    case Material::leaf:
      return leaf(point);
    case Material::brick:
      return brick(point);
    case Material::concrete:
      return concrete(point);
    case Material::painted_metal:
      return painted_metal(point);
    case Material::lamp: {
      SurfaceLook look;
      look.albedo = {0.90F, 0.88F, 0.82F};
      look.glow = 1.2F;
      return look;
    }
  }
  return {};
}

}  // namespace

SurfaceLook surface_look(const SurfacePoint& point) {
  SurfaceLook look = textured_look(point);
  const float opacity = point.texture_opacity;
  if (opacity < 1.0F) {
    look.albedo = mix(bland_albedo(point.material), look.albedo, opacity);
    look.normal_tilt *= opacity;
    look.crevice = 1.0F + (look.crevice - 1.0F) * opacity;
  }
  return look;
}

}  // namespace avoidbench
