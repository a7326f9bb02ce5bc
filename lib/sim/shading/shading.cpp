#include "shading/shading.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "render/flush_to_zero.hpp"
#include "render/lanes.hpp"
#include "render/primary_rays.hpp"
#include "render/ray_tracing_isa.hpp"
#include "shading/shading_kernel.hpp"
#include "shading/srgb.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

static_assert(kBlockPackets == embree::kStreamPackets);
static_assert(kMaterialCount == static_cast<int>(Material::lamp) + 1);

std::uint32_t mixed_seed(std::uint32_t number) {
  // Constants of MurmurHash3 and of the golden ratio, then a mixer with two rounds: neighbouring
  // numbers get unlike seeds.
  std::uint32_t h = number * 0x85ebca6bU + 0x9e3779b9U;
  h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12U)) * 0x297a2d39U;
  return h ^ (h >> 15U);
}

void copy(const Vector3d& from, float (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

/// The instances that a frame has seen so far, as its camera sees them.
class ObjectViews {
 public:
  ObjectViews(const Scene::Internals& scene, const Pose& T_world_camera, const Vector3d& to_sun)
      : scene_(scene),
        axes_(T_world_camera.linear()),
        position_world_(T_world_camera.translation()),
        to_sun_(to_sun),
        // Only what is seen is ever written.
        views_(std::make_unique_for_overwrite<ObjectView[]>(scene.placements.size())),
        is_made_(scene.placements.size(), 0) {}

  const ObjectView& of(unsigned instance) {
    if (is_made_[instance] == 0) make(instance);
    return views_[instance];
  }

 private:
  void make(unsigned instance) {
    const World& world = *scene_.world;
    const Placement& placement = scene_.placements[instance];
    // Into the object's own frame and size, in which textures lie: they move with it.
    const Eigen::Matrix3d R = placement.linear_prototype_world * placement.scale;
    ObjectView& view = views_[instance];
    copy(R * axes_.col(0), view.right);
    copy(R * axes_.col(1), view.down);
    copy(R * axes_.col(2), view.forward);
    copy(R * (position_world_ - placement.position_world), view.position);
    copy(R * to_sun_, view.to_sun);
    for (int row = 0; row < 3; ++row) copy(R.row(row).transpose(), view.R_object_world[row]);
    const std::uint32_t obstacle = world.instances[instance].obstacle;
    const bool has_opacity = obstacle < world.obstacles.size();
    view.opacity =
        has_opacity ? static_cast<float>(world.obstacles[obstacle].texture_opacity) : 1.0F;
    view.seed = mixed_seed(instance);
    is_made_[instance] = 1;
  }

  const Scene::Internals& scene_;
  Eigen::Matrix3d axes_;
  Vector3d position_world_, to_sun_;
  std::unique_ptr<ObjectView[]> views_;
  std::vector<std::uint8_t> is_made_;
};

/// The triangle that was seen last: mostly the next packet's too.
struct LastFacet {
  unsigned instance = ~0U, triangle = ~0U;
  FacetLanes facet{};
  std::size_t material = 0;

  void find(const Scene::Internals& scene, const PrimaryRays& rays, unsigned instance_now,
            unsigned triangle_now) {
    if (instance_now == instance && triangle_now == triangle) return;
    instance = instance_now;
    triangle = triangle_now;
    const PlaneInCamera plane = rays.plane(instance, triangle);
    facet.a = static_cast<float>(plane.a);
    facet.b = static_cast<float>(plane.b);
    facet.c = static_cast<float>(plane.c);
    facet.h = static_cast<float>(plane.h);
    const Placement& placement = scene.placements[instance];
    const TrianglePlane& p = scene.planes_of[instance][triangle];
    const Vector3d normal(p.nx, p.ny, p.nz);
    // Planes of a flattened scene are in the world already.
    copy(instance < scene.flattened_count
             ? normal
             : Vector3d(placement.linear_world_prototype * normal * (1.0 / placement.scale)),
         facet.normal_world);
    const World& world = *scene.world;
    const Prototype& prototype = world.prototypes[world.instances[instance].prototype];
    material = static_cast<std::size_t>(prototype.triangle_materials[triangle]);
  }
};

/// A bit for each lane of a packet that holds this number.
unsigned lanes_with(const unsigned* lanes, unsigned number) {
  unsigned bits = 0;
  for (int first = 0; first < kPacketLanes; first += kLanes) {
    bits |= lane_bits(load<Ints>(lanes + first) == number) << first;
  }
  return bits;
}

/// A frame as it is being shaded.
struct Frame {
  const ShadingKernel& kernel;
  const Scene::Internals& scene;
  FrameLight light;
  bool has_shadows;
  std::vector<float> u, v;  ///< of each ray of a row and of a column of packets
  ObjectViews objects;
  LastFacet last;
};

void add_object(PacketHits& hits, const ObjectView& object, unsigned lanes) {
  // A packet of eight lanes sees eight objects at most.
  for (int i = 0; i < hits.object_count; ++i) {
    if (hits.objects[i].object != &object) continue;
    hits.objects[i].lanes |= lanes;
    return;
  }
  hits.objects[hits.object_count++] = {lanes, &object};
}

/// What a packet of rays has met, as the kernels take it.
void gather(Frame& frame, const PrimaryRays& rays, const RTCRayHit8& packet, std::size_t x,
            std::size_t y, PacketHits& hits) {
  hits.ray_x = packet.ray.dir_x;
  hits.ray_y = packet.ray.dir_y;
  hits.ray_z = packet.ray.dir_z;
  hits.traced_depth = packet.ray.tfar;
  hits.u = &frame.u[kPacketHeight * x];
  hits.v = &frame.v[kBlockWidth * y];
  hits.hit = 0xffU & ~lanes_with(packet.hit.geomID, RTC_INVALID_GEOMETRY_ID);
  hits.facet_count = 0;
  hits.object_count = 0;
  std::fill_n(hits.material_lanes, kMaterialCount, 0U);
  const unsigned* instances = rays.instances(packet);
  const unsigned* triangles = packet.hit.primID;
  // Lanes that met the same triangle are taken together, until none is left.
  for (unsigned left = hits.hit; left != 0;) {
    const int lane = std::countr_zero(left);
    const unsigned lanes =
        left & lanes_with(instances, instances[lane]) & lanes_with(triangles, triangles[lane]);
    left &= ~lanes;
    frame.last.find(frame.scene, rays, instances[lane], triangles[lane]);
    FacetLanes& facet = hits.facets[hits.facet_count++];
    facet = frame.last.facet;
    facet.lanes = lanes;
    hits.material_lanes[frame.last.material] |= lanes;
    add_object(hits, frame.objects.of(instances[lane]), lanes);
  }
}

/// The four packets of a block.
struct Block {
  PacketHits hits[kBlockPackets];
  PacketSurface surfaces[kBlockPackets];
  PacketLight lights[kBlockPackets];
  RTCRay8 shadows[kBlockPackets];  ///< rays to the sun

  explicit Block(const FrameLight& light) : hits{}, surfaces{}, lights{}, shadows{} {
    for (RTCRay8& packet : shadows) {
      std::fill_n(packet.mask, 8, ~0U);
      std::fill_n(packet.dir_x, 8, light.to_sun_world[0]);
      std::fill_n(packet.dir_y, 8, light.to_sun_world[1]);
      std::fill_n(packet.dir_z, 8, light.to_sun_world[2]);
    }
  }
};

/// Takes the lanes that something hides from the sun from `lit`.
void cast_shadows(const Frame& frame, Block& block, unsigned (&lit)[kBlockPackets]) {
  unsigned any = 0;
  for (int i = 0; i < kBlockPackets; ++i) {
    RTCRay8& rays = block.shadows[i];
    const PacketSurface& surface = block.surfaces[i];
    std::copy_n(surface.shadow_from[0], 8, rays.org_x);
    std::copy_n(surface.shadow_from[1], 8, rays.org_y);
    std::copy_n(surface.shadow_from[2], 8, rays.org_z);
    if (lit[i] != 0) {
      std::copy_n(surface.shadow_length, 8, rays.tfar);
    } else {
      // Rays of negative length are switched off for Embree.
      std::fill_n(rays.tfar, 8, -1.0F);
    }
    any |= lit[i];
  }
  if (any == 0) return;
  const Placement* placements = frame.scene.placements.data();
  occlude(frame.scene.map->top.get(), placements, block.shadows);
  // Rays that the map has stopped are switched off by their length.
  if (frame.scene.has_movers()) {
    occlude(frame.scene.movers.top.get(), placements, block.shadows);
  }
  for (int i = 0; i < kBlockPackets; ++i) {
    // Embree gives rays that hit something a length of -inf.
    for (int first = 0; first < kPacketLanes; first += kLanes) {
      lit[i] &= ~(lane_bits(load<Mask>(block.shadows[i].tfar + first)) << first);
    }
  }
}

/// Rays, what they met, shadows, light: for a block of four packets at once.
void shade_block(Frame& frame, PrimaryRays& rays, int block_x, int block_y, Block& block) {
  rays.trace(block_x, block_y);
  const std::size_t x = static_cast<std::size_t>(block_x) * kBlockWidth;
  const std::size_t y = static_cast<std::size_t>(block_y) * kBlockHeight;
  unsigned lit[kBlockPackets] = {};
  for (std::size_t i = 0; i < kBlockPackets; ++i) {
    PacketHits& hits = block.hits[i];
    gather(frame, rays, rays.packet(i), x, y + kPacketHeight * i, hits);
    PacketSurface& surface = block.surfaces[i];
    surface.facing_sun = 0;
    if (hits.hit != 0) {
      // Where and what was hit; which lanes face the sun.
      frame.kernel.locate(frame.light, hits, surface);
    } else {
      std::fill_n(surface.shadow_length, kPacketLanes, -1.0F);
    }
    lit[i] = surface.facing_sun;
  }
  // Shadows of all four packets are one stream of rays.
  if (frame.has_shadows) cast_shadows(frame, block, lit);
  for (std::size_t i = 0; i < kBlockPackets; ++i) {
    frame.kernel.shade(frame.light, block.hits[i], block.surfaces[i], lit[i], block.lights[i]);
  }
}

/// Where a frame's light goes.
struct Image {
  std::size_t width, height, samples;
  Channels channels;
  std::span<float> radiance;
};

/// Writes (or, of several samples, adds) a block's light to the pixels at (x, y) of the samples.
void store_block(const Image& image, const Block& block, std::size_t x, std::size_t y) {
  // Blocks at the right and lower border stand out of the image.
  const std::size_t columns = std::min<std::size_t>(kBlockWidth, image.width * image.samples - x);
  const std::size_t rows = std::min<std::size_t>(kBlockHeight, image.height * image.samples - y);
  const auto channels = static_cast<std::size_t>(image.channels);
  const bool is_single = image.samples == 1;
  const float share = 1.0F / static_cast<float>(image.samples * image.samples);
  for (std::size_t row = 0; row < rows; ++row) {
    const PacketLight& light = block.lights[row / kPacketHeight];
    const std::size_t first_lane = row % kPacketHeight * kBlockWidth;
    const bool is_grey = image.channels == Channels::grey;
    const float* from[3] = {(is_grey ? light.grey : light.rgb[0]) + first_lane,
                            light.rgb[1] + first_lane, light.rgb[2] + first_lane};
    float* line = &image.radiance[(y + row) / image.samples * image.width * channels];
    // The usual case of cameras, row by row.
    if (is_grey && is_single && columns == kBlockWidth) {
      std::copy_n(from[0], kBlockWidth, line + x);
      continue;
    }
    for (std::size_t column = 0; column < columns; ++column) {
      float* pixel = line + (x + column) / image.samples * channels;
      for (std::size_t k = 0; k < channels; ++k) {
        pixel[k] = is_single ? from[k][column] : pixel[k] + share * from[k][column];
      }
    }
  }
}

FrameLight frame_light(const Scene::Internals& scene, const Pinhole& camera,
                       const Pose& T_world_camera, const Light& light, int samples) {
  // Farther than any map; squares of it are still good floats.
  constexpr double kHugeLength_m = 1e6;
  const Vector3d to_sun = light.to_sun_world.normalized();
  FrameLight frame{};
  copy(T_world_camera.translation(), frame.camera_world);
  copy(to_sun, frame.to_sun_world);
  frame.sun = static_cast<float>(light.sun);
  frame.sky = static_cast<float>(light.sky);
  frame.haze_per_m = static_cast<float>(1.0 / light.haze_range_m);
  // The width of a sample at a distance of 1 m: textures are smoothed by it.
  frame.pixel_slope = static_cast<float>(1.0 / (camera.fx_px * samples));
  // Below that the sun is at the horizon and would reach no ceiling within a map.
  const bool is_above = to_sun.z() > 1e-3;
  frame.ceiling_z_m = static_cast<float>(is_above ? scene.lowest_ceiling_m : kHugeLength_m);
  frame.sun_distance_per_m = static_cast<float>(is_above ? 1.0 / to_sun.z() : 1.0);
  frame.longest_shadow_m = static_cast<float>(kHugeLength_m);
  return frame;
}

/// Keeps the middle and bends the highlights: x below 0.6, toward 1 beyond.
float soft_highlights(float x) {
  // For people's pictures only: cameras have their own exposure, see sensing/image_model.cpp. The
  // curve and its slope are continuous at the knee.
  constexpr float kKnee = 0.6F;
  if (x <= kKnee) return std::max(x, 0.0F);
  const float over = (x - kKnee) / (1.0F - kKnee);
  return kKnee + (1.0F - kKnee) * over / (1.0F + over);
}

}  // namespace

const ShadingKernel& shading_kernel() { return has_avx2() ? kAvx2Shading : kPortableShading; }

void render_radiance_by(const ShadingKernel& kernel, const Scene& scene, const Pinhole& camera,
                        const Pose& T_world_camera, const Light& light, int samples,
                        Channels channels, std::span<float> radiance) {
  const Image image{static_cast<std::size_t>(camera.width_px),
                    static_cast<std::size_t>(camera.height_px), static_cast<std::size_t>(samples),
                    channels, radiance};
  AB_CHECK(radiance.size() == image.width * image.height * static_cast<std::size_t>(channels),
           radiance.size(), image.width, image.height);
  AB_CHECK(samples >= 1 && light.to_sun_world.norm() > 0.0, samples);
  const Scene::Internals& internals = scene.internals();
  const ScopedFlushToZero flush;
  PrimaryRays rays(internals, camera, T_world_camera, samples);
  Frame frame{kernel,
              internals,
              frame_light(internals, camera, T_world_camera, light, samples),
              light.shadows,
              {},
              {},
              ObjectViews(internals, T_world_camera, light.to_sun_world.normalized()),
              {}};
  for (int i = 0; i < rays.blocks_across() * kPacketHeight; ++i) {
    const double* u = rays.u() + i / kPacketHeight * kBlockWidth;
    frame.u.insert(frame.u.end(), u, u + kBlockWidth);
  }
  for (int row = 0; row < rays.blocks_down() * kBlockHeight; ++row) {
    frame.v.insert(frame.v.end(), kBlockWidth, static_cast<float>(rays.v()[row]));
  }
  // Several samples of a pixel are added up in place.
  if (samples > 1) std::fill(radiance.begin(), radiance.end(), 0.0F);
  Block block(frame.light);
  for (int block_y = 0; block_y < rays.blocks_down(); ++block_y) {
    for (int block_x = 0; block_x < rays.blocks_across(); ++block_x) {
      shade_block(frame, rays, block_x, block_y, block);
      store_block(image, block, static_cast<std::size_t>(block_x) * kBlockWidth,
                  static_cast<std::size_t>(block_y) * kBlockHeight);
    }
  }
}

void render_radiance(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                     const Light& light, int samples, Channels channels,
                     std::span<float> radiance) {
  render_radiance_by(shading_kernel(), scene, camera, T_world_camera, light, samples, channels,
                     radiance);
}

void render_shaded(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                   const Light& light, int samples, std::span<std::uint8_t> rgb) {
  std::vector<float> radiance(rgb.size());
  render_radiance(scene, camera, T_world_camera, light, samples, Channels::rgb, radiance);
  const SrgbTable& srgb = srgb_table();
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float level = std::min(soft_highlights(radiance[i]), 1.0F);
    // The table's last index.
    rgb[i] = srgb[static_cast<std::size_t>(std::lround(4096.0F * level))];
  }
}

}  // namespace avoidbench
