#include "render/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "render/flush_to_zero.hpp"
#include "render/materials.hpp"
#include "render/primary_rays.hpp"
#include "render/value_noise.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t kLanes = 8 * embree::kStreamPackets;

const Vector3f kSunColor(1.0F, 0.93F, 0.80F);
const Vector3f kSkyColor(0.72F, 0.86F, 1.0F);
const Vector3f kBounceColor(0.55F, 0.50F, 0.38F);
const Vector3f kHorizonColor(0.74F, 0.82F, 0.90F);
const Vector3f kZenithColor(0.16F, 0.34F, 0.72F);

/// What one ray of a block found.
struct Lane {
  bool inside = false;  ///< a pixel of the image
  bool hit = false;
  bool lit = true;  ///< by the sun, as far as other surfaces go
  std::uint32_t instance = 0, triangle = 0;
  std::size_t pixel = 0;
  double depth_m = 0.0;
  Vector3d ray;             ///< world frame, forward component 1
  Vector3d position_world;  ///< of the hit
  Vector3d normal_world;    ///< unit, towards the viewer
};

struct View {
  const Scene::Internals& scene;
  const Light& light;
  Vector3d to_sun;
  Vector3d position_world;
  Eigen::Matrix3d axes;
  std::size_t width, height;
  std::size_t samples;
  double pixel_slope;  ///< size of a ray's footprint a metre of depth
  double ceiling_z_m;  ///< the sun is above the surfaces and below this
};

/// The lowest point of all ceilings and lamps: the sun shines through them, else halls would be
/// dark.
double lowest_ceiling_m(const Scene::Internals& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  const World& world = *scene.world;
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    const Instance& instance = world.instances[i];
    if (instance.obstacle >= world.obstacles.size()) continue;
    const std::string& kind = world.obstacles[instance.obstacle].kind;
    if (kind != "ceiling" && kind != "lamp") continue;
    const Placement& placement = scene.placements[i];
    for (const Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      lowest = std::min(lowest, (placement.linear_world_prototype * vertex.cast<double>() +
                                 placement.position_world)
                                    .z());
    }
  }
  return lowest;
}

void gather_lanes(const View& view, const PrimaryRays& rays, int block_x, int block_y,
                  std::array<Lane, kLanes>& lanes) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    Lane& lane = lanes[i];
    const std::size_t x = static_cast<std::size_t>(block_x) * kBlockWidth + i % kBlockWidth;
    const std::size_t y = static_cast<std::size_t>(block_y) * kBlockHeight + i / kBlockWidth;
    lane.inside = x < view.width * view.samples && y < view.height * view.samples;
    if (!lane.inside) continue;
    lane.pixel = y / view.samples * view.width + x / view.samples;
    const double u = rays.u()[x];
    const double v = rays.v()[y];
    lane.ray = view.axes.col(0) * u + view.axes.col(1) * v + view.axes.col(2);
    const RTCRayHit8& packet = rays.packet(i / 8);
    lane.hit = packet.hit.geomID[i % 8] != RTC_INVALID_GEOMETRY_ID;
    if (!lane.hit) continue;
    lane.instance = rays.instances(packet)[i % 8];
    lane.triangle = packet.hit.primID[i % 8];
    const float depth =
        plane_depth(rays.plane(lane.instance, lane.triangle), u, v, packet.ray.tfar[i % 8]);
    lane.depth_m = static_cast<double>(depth);
    lane.position_world = view.position_world + lane.ray * lane.depth_m;
    const Placement& placement = view.scene.placements[lane.instance];
    const TrianglePlane& plane = placement.planes[lane.triangle];
    Vector3d normal(plane.nx, plane.ny, plane.nz);
    if (!view.scene.flattened) normal = placement.linear_world_prototype * normal / placement.scale;
    lane.normal_world = normal.dot(lane.ray) > 0.0 ? Vector3d(-normal) : normal;
  }
}

void cast_shadows(const View& view, std::array<Lane, kLanes>& lanes) {
  RTCRay8 packets[embree::kStreamPackets] = {};
  bool any = false;
  for (std::size_t i = 0; i < kLanes; ++i) {
    RTCRay8& packet = packets[i / 8];
    const std::size_t k = i % 8;
    packet.tfar[k] = -1.0F;
    packet.mask[k] = ~0U;
    packet.dir_x[k] = static_cast<float>(view.to_sun.x());
    packet.dir_y[k] = static_cast<float>(view.to_sun.y());
    packet.dir_z[k] = static_cast<float>(view.to_sun.z());
    Lane& lane = lanes[i];
    lane.lit = true;
    if (!lane.inside || !lane.hit) continue;
    const double side = lane.normal_world.dot(view.to_sun) < 0.0 ? -1.0 : 1.0;
    const Vector3d from =
        lane.position_world + lane.normal_world * (side * (1e-3 + 1e-4 * lane.depth_m));
    packet.org_x[k] = static_cast<float>(from.x());
    packet.org_y[k] = static_cast<float>(from.y());
    packet.org_z[k] = static_cast<float>(from.z());
    const double rise = view.ceiling_z_m - 1e-3 - from.z();
    packet.tfar[k] = rise < 1e6 ? static_cast<float>(std::max(rise, 0.0) / view.to_sun.z())
                                : std::numeric_limits<float>::infinity();
    any = true;
  }
  if (!any) return;
  std::array<bool, kLanes> active{};
  for (std::size_t i = 0; i < kLanes; ++i) active[i] = packets[i / 8].tfar[i % 8] >= 0.0F;
  embree::occlude_stream(view.scene.top.get(), packets);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (active[i]) lanes[i].lit = packets[i / 8].tfar[i % 8] >= 0.0F;
  }
}

Vector3f sky_color(const View& view, const Vector3d& direction) {
  const auto up = static_cast<float>(std::clamp(direction.z(), 0.0, 1.0));
  const float toward_zenith = std::sqrt(up);
  Vector3f color = kHorizonColor + (kZenithColor - kHorizonColor) * toward_zenith;
  const auto near_sun = static_cast<float>(std::max(0.0, direction.dot(view.to_sun)));
  const float squared = near_sun * near_sun;
  const float glow = squared * squared * squared * squared;
  return color + kSunColor * (0.35F * glow * glow);
}

Vector3f surface_color(const View& view, const Lane& lane) {
  const World& world = *view.scene.world;
  const Instance& instance = world.instances[lane.instance];
  const Placement& placement = view.scene.placements[lane.instance];
  SurfacePoint point;
  point.material = world.prototypes[instance.prototype].triangle_materials[lane.triangle];
  const Eigen::Matrix3d to_object = placement.linear_prototype_world * placement.scale;
  point.position_object =
      (to_object * (lane.position_world - placement.position_world)).cast<float>();
  point.normal_object = (to_object * lane.normal_world).cast<float>();
  point.object_seed = lattice_hash(static_cast<std::int32_t>(lane.instance), 0, 0, 1U);
  if (instance.obstacle < world.obstacles.size()) {
    point.texture_opacity = static_cast<float>(world.obstacles[instance.obstacle].texture_opacity);
  }
  point.footprint_m = static_cast<float>(view.pixel_slope * lane.depth_m);
  const SurfaceLook look = surface_look(point);

  const Vector3f tilted =
      lane.normal_world.cast<float>() +
      (placement.linear_world_prototype.cast<float>() / static_cast<float>(placement.scale)) *
          look.normal_tilt;
  const float length = tilted.norm();
  const Vector3f normal =
      length > 1e-3F ? Vector3f(tilted / length) : lane.normal_world.cast<float>();
  const float facing = normal.dot(view.to_sun.cast<float>());
  const float front = std::max(facing, 0.0F);
  const float through = look.translucency * std::max(-facing, 0.0F);
  // Light that a leaf lets through comes out yellower.
  const Vector3f through_color(1.15F * look.albedo.x(), 1.1F * look.albedo.y(),
                               0.5F * look.albedo.z());
  const auto sun = static_cast<float>(lane.lit ? view.light.sun : 0.0);
  const auto sky = static_cast<float>(view.light.sky) * look.crevice;
  const float up = 0.5F + 0.5F * normal.z();
  const Vector3f ambient = kSkyColor * (sky * up) + kBounceColor * (0.45F * sky * (1.0F - up));
  return look.glow * look.albedo + look.albedo.cwiseProduct(kSunColor * (sun * front) + ambient) +
         through_color.cwiseProduct(kSunColor * (sun * through));
}

Vector3f lane_color(const View& view, const Lane& lane) {
  const double length = lane.ray.norm();
  if (!lane.hit) return sky_color(view, lane.ray / length);
  constexpr float kExposure = 2.2F;
  const Vector3f color = surface_color(view, lane) * kExposure;
  const auto clear =
      static_cast<float>(math::exp(-lane.depth_m * length / view.light.haze_range_m));
  return kHorizonColor + (color - kHorizonColor) * clear;
}

/// Linear light in [0, 1] to 8-bit sRGB (IEC 61966-2-1), by a table of 4096 steps.
std::array<std::uint8_t, 4097> make_srgb_table() {
  std::array<std::uint8_t, 4097> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double linear = static_cast<double>(i) / 4096.0;
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * math::pow(linear, 1.0 / 2.4) - 0.055;
    table[i] = static_cast<std::uint8_t>(std::round(255.0 * encoded));
  }
  return table;
}

/// Keeps the middle and bends the highlights: x below 0.6, toward 1 beyond.
float soft_highlights(float x) {
  constexpr float kKnee = 0.6F;
  if (x <= kKnee) return std::max(x, 0.0F);
  const float over = (x - kKnee) / (1.0F - kKnee);
  return kKnee + (1.0F - kKnee) * over / (1.0F + over);
}

}  // namespace

void render_shaded(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                   const Light& light, int samples, std::span<std::uint8_t> rgb) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  AB_CHECK(rgb.size() == 3 * width * height, rgb.size(), width, height);
  AB_CHECK(samples >= 1 && light.to_sun_world.norm() > 0.0, samples);
  const ScopedFlushToZero flush;
  PrimaryRays rays(scene.internals(), camera, T_world_camera, samples);
  const Vector3d to_sun = light.to_sun_world.normalized();
  const double ceiling_z_m = to_sun.z() > 1e-3 ? lowest_ceiling_m(scene.internals())
                                               : std::numeric_limits<double>::infinity();
  const View view{scene.internals(),
                  light,
                  to_sun,
                  T_world_camera.translation(),
                  T_world_camera.linear(),
                  width,
                  height,
                  static_cast<std::size_t>(samples),
                  1.0 / (camera.fx_px * samples),
                  ceiling_z_m};
  std::vector<Vector3f> colors(width * height, Vector3f::Zero());
  std::array<Lane, kLanes> lanes;
  for (int block_y = 0; block_y < rays.blocks_down(); ++block_y) {
    for (int block_x = 0; block_x < rays.blocks_across(); ++block_x) {
      rays.trace(block_x, block_y);
      gather_lanes(view, rays, block_x, block_y, lanes);
      if (light.shadows) cast_shadows(view, lanes);
      for (const Lane& lane : lanes) {
        if (!lane.inside) continue;
        colors[lane.pixel] += lane_color(view, lane).unaryExpr(&soft_highlights);
      }
    }
  }
  static const std::array<std::uint8_t, 4097> kSrgb = make_srgb_table();
  const float share = 1.0F / static_cast<float>(samples * samples);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float level = colors[i][static_cast<Eigen::Index>(k)] * share;
      rgb[3 * i + k] =
          kSrgb[static_cast<std::size_t>(std::lround(4096.0F * std::min(level, 1.0F)))];
    }
  }
}

}  // namespace avoidbench
