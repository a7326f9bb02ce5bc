#pragma once

#include "shading/lane_materials.hpp"
#include "shading/shading_kernel.hpp"

/// The source of both builds of the shading kernel; see shading_kernel.hpp.
namespace avoidbench {
namespace {

constexpr Rgb kSunColor{1.0F, 0.93F, 0.80F};
constexpr Rgb kSkyColor{0.72F, 0.86F, 1.0F};
constexpr Rgb kBounceColor{0.55F, 0.50F, 0.38F};
constexpr Rgb kHorizonColor{0.74F, 0.82F, 0.90F};
constexpr Rgb kZenithColor{0.16F, 0.34F, 0.72F};
constexpr float kExposure = 2.2F;
constexpr float kNowhere_m = 1e9F;  ///< a footprint that sees no texture
constexpr unsigned kLeafMaterial = 2;

AB_LANE Triple of(const float (&v)[3]) {
  return {all_lanes(v[0]), all_lanes(v[1]), all_lanes(v[2])};
}
AB_LANE Triple load(const float (&v)[3][kPacketLanes], int first) {
  return {load<Floats>(v[0] + first), load<Floats>(v[1] + first), load<Floats>(v[2] + first)};
}
AB_LANE void store(float (&to)[3][kPacketLanes], int first, const Triple& v) {
  store(to[0] + first, v.x);
  store(to[1] + first, v.y);
  store(to[2] + first, v.z);
}
AB_LANE Triple load_rays(const PacketHits& hits, int first) {
  return {load<Floats>(hits.ray_x + first), load<Floats>(hits.ray_y + first),
          load<Floats>(hits.ray_z + first)};
}

/// exp(x), x <= 0: relative error below 2e-6.
AB_LANE Floats falling_exp(Floats x) {
  // 2^x of x log₂ e; below 2^-126 floats lose bits, and haze is complete.
  const Split power = split(greatest(x * 1.44269504F, -126.0F));
  const Floats f = power.rest;
  Floats sum = 0.0018775767F * f + 0.0089893397F;
  sum = sum * f + 0.0558263180F;
  sum = sum * f + 0.2401536394F;
  sum = sum * f + 0.6931530731F;
  sum = sum * f + 0.9999999251F;
  return sum * bits_as<Floats>((power.whole + 127U) << 23);
}

/// The lanes' planes: a·u + b·v + c, h and the normals by the triangles' corner order.
struct Planes {
  Floats denominator, numerator;
  Triple normal_world;
};

AB_LANE Planes planes_of(const PacketHits& hits, int first, Floats u, Floats v) {
  const auto plane = [&](const FacetLanes& facet) {
    return Planes{facet.a * u + (facet.b * v + facet.c), all_lanes(facet.h),
                  of(facet.normal_world)};
  };
  Planes all = plane(hits.facets[0]);
  for (int i = 1; i < hits.facet_count; ++i) {
    const Mask mask = mask_of(hits.facets[i].lanes >> first);
    const Planes one = plane(hits.facets[i]);
    all.denominator = select(mask, one.denominator, all.denominator);
    all.numerator = select(mask, one.numerator, all.numerator);
    all.normal_world = select(mask, one.normal_world, all.normal_world);
  }
  return all;
}

/// A register's lanes from the first on.
AB_LANE void locate(const FrameLight& frame, const PacketHits& hits, int first,
                    PacketSurface& surface) {
  const auto u = load<Floats>(hits.u + first);
  const auto v = load<Floats>(hits.v + first);
  Planes planes = planes_of(hits, first, u, v);
  // As in depth images: the plane's depth where it agrees with that of the traced ray.
  const auto traced_depth = load<Floats>(hits.traced_depth + first);
  const Floats plane_depth = planes.numerator / planes.denominator;
  const Mask agrees = magnitude(plane_depth - traced_depth) <= traced_depth * 1e-3F;
  const Floats depth = select(mask_of(hits.hit >> first), select(agrees, plane_depth, traced_depth),
                              all_lanes(1.0F));
  store(surface.depth + first, depth);

  const Floats toward_viewer = 0.0F - planes.denominator;
  const Triple normal_world{turned(planes.normal_world.x, toward_viewer),
                            turned(planes.normal_world.y, toward_viewer),
                            turned(planes.normal_world.z, toward_viewer)};
  Triple at{}, normal{};
  for (int i = 0; i < hits.object_count; ++i) {
    const ObjectView& object = *hits.objects[i].object;
    const auto along_ray = [&](int k) {
      return object.position[k] +
             depth * (object.right[k] * u + (object.down[k] * v + object.forward[k]));
    };
    const auto row = [&](int k) { return dot(of(object.R_object_world[k]), normal_world); };
    const Triple at_here{along_ray(0), along_ray(1), along_ray(2)};
    const Triple normal_here{row(0), row(1), row(2)};
    const Mask mask = mask_of(hits.objects[i].lanes >> first);
    at = i == 0 ? at_here : select(mask, at_here, at);
    normal = i == 0 ? normal_here : select(mask, normal_here, normal);
  }
  store(surface.object, first, at);
  store(surface.normal_object, first, normal);

  // Seen at a slant, a pixel's footprint is longer than it is wide: between the two.
  const Floats ray_length = square_root(u * u + (v * v + 1.0F));
  const Floats cosine = least(greatest(magnitude(planes.denominator) / ray_length, 0.01F), 1.0F);
  store(surface.ray_length + first, ray_length);
  store(surface.footprint + first, frame.pixel_slope * depth / square_root(cosine));

  const Floats facing = dot(of(frame.to_sun_world), normal_world);
  const Mask facing_sun = (facing > 0.0F) & mask_of(hits.hit >> first);
  const Mask needed = facing_sun | mask_of(hits.material_lanes[kLeafMaterial] >> first);
  surface.facing_sun |= lane_bits(needed) << first;
  // Off the surface by more than float rounding at that distance, or a surface would shade itself.
  const Floats off = turned(1e-3F + 1e-4F * depth, facing);
  const Triple from = of(frame.camera_world) + load_rays(hits, first) * depth + normal_world * off;
  store(surface.shadow_from, first, from);
  const Floats rise = greatest(frame.ceiling_z_m - 1e-3F - from.z, 0.0F);
  const Floats length = least(rise * frame.sun_distance_per_m, frame.longest_shadow_m);
  store(surface.shadow_length + first, select(needed, length, all_lanes(-1.0F)));
}

void locate(const FrameLight& frame, const PacketHits& hits, PacketSurface& surface) {
  surface.facing_sun = 0;
  for (int first = 0; first < kPacketLanes; first += kLanes) locate(frame, hits, first, surface);
}

AB_LANE Triple sky(const FrameLight& frame, const Triple& direction) {
  const Triple zenithward = mix(kHorizonColor, kZenithColor, square_root(within_unit(direction.z)));
  const Floats near_sun = greatest(dot(direction, of(frame.to_sun_world)), 0.0F);
  const Floats squared = near_sun * near_sun;
  const Floats fourth = squared * squared;
  // Products give the same bits everywhere, which pow() does not.
  const Floats glow = fourth * fourth;
  return zenithward + all_lanes(kSunColor) * (0.35F * glow * glow);
}

/// The looks of all lanes, one material after the other: mostly there is one.
AB_LANE Look looks_of(const PacketHits& hits, const PacketSurface& surface, int first, Ints seed,
                      Floats opacity) {
  Points points{load(surface.object, first), load(surface.normal_object, first), seed,
                all_lanes(kNowhere_m)};
  const auto footprint = load<Floats>(surface.footprint + first);
  Look all;
  all.albedo = untilted();
  all.tilt = untilted();
  for (int material = 0; material < kMaterialCount; ++material) {
    const Mask mask = mask_of(hits.material_lanes[material] >> first);
    if (!any(mask)) continue;
    points.footprint = select(mask, footprint, all_lanes(kNowhere_m));
    const Look one = faded_look(material, points, opacity);
    all.albedo = select(mask, one.albedo, all.albedo);
    all.tilt = select(mask, one.tilt, all.tilt);
    all.crevice = select(mask, one.crevice, all.crevice);
    all.translucency = select(mask, one.translucency, all.translucency);
    all.glow = select(mask, one.glow, all.glow);
  }
  return all;
}

/// Light from surfaces, before haze.
AB_LANE Triple surface_light(const FrameLight& frame, const PacketHits& hits,
                             const PacketSurface& surface, int first, unsigned lit) {
  const ObjectView& first_object = *hits.objects[0].object;
  Ints seed = all_lanes(first_object.seed);
  Floats opacity = all_lanes(first_object.opacity);
  Triple to_sun = of(first_object.to_sun);
  // The third column: up in the object's frame.
  const auto up_of = [](const ObjectView& object) {
    return Triple{all_lanes(object.R_object_world[0][2]), all_lanes(object.R_object_world[1][2]),
                  all_lanes(object.R_object_world[2][2])};
  };
  Triple up = up_of(first_object);
  for (int i = 1; i < hits.object_count; ++i) {
    const Mask mask = mask_of(hits.objects[i].lanes >> first);
    const ObjectView& object = *hits.objects[i].object;
    seed = select(mask, all_lanes(object.seed), seed);
    opacity = select(mask, all_lanes(object.opacity), opacity);
    to_sun = select(mask, of(object.to_sun), to_sun);
    up = select(mask, up_of(object), up);
  }
  const Look look = looks_of(hits, surface, first, seed, opacity);

  const Triple flat = load(surface.normal_object, first);
  const Triple tilted = flat + look.tilt;
  const Floats length = square_root(dot(tilted, tilted));
  const Mask is_normal = length > 1e-3F;
  const Triple normal = select(is_normal, tilted * (1.0F / greatest(length, 1e-3F)), flat);
  const Floats facing = dot(normal, to_sun);
  const Floats sun = select(mask_of(lit >> first), all_lanes(frame.sun), Floats{});
  const Floats front = sun * greatest(facing, 0.0F);
  const Floats through = sun * look.translucency * greatest(0.0F - facing, 0.0F);
  const Floats above = frame.sky * look.crevice * (0.5F + 0.5F * dot(normal, up));
  // Light from the sky that the ground throws back.
  const Floats below = 0.45F * (frame.sky * look.crevice - above);
  // Light that a leaf lets through comes out yellower.
  const auto channel = [&](Floats albedo, float sun_color, float sky_color, float bounce,
                           float yellower) {
    return albedo * (look.glow + sun_color * (front + yellower * through) + sky_color * above +
                     bounce * below);
  };
  return {channel(look.albedo.x, kSunColor.r, kSkyColor.r, kBounceColor.r, 1.15F),
          channel(look.albedo.y, kSunColor.g, kSkyColor.g, kBounceColor.g, 1.1F),
          channel(look.albedo.z, kSunColor.b, kSkyColor.b, kBounceColor.b, 0.5F)};
}

AB_LANE void shade(const FrameLight& frame, const PacketHits& hits, const PacketSurface& surface,
                   int first, unsigned lit, PacketLight& light) {
  Triple color = untilted();
  const Mask hit = mask_of(hits.hit >> first);
  if (any(hit)) {
    const Triple bare = surface_light(frame, hits, surface, first, lit) * all_lanes(kExposure);
    const Floats distance =
        load<Floats>(surface.depth + first) * load<Floats>(surface.ray_length + first);
    const Floats clear = falling_exp(distance * (0.0F - frame.haze_per_m));
    color = mix(all_lanes(kHorizonColor), bare, clear);
  }
  if (any(~hit)) {
    const Triple ray = load_rays(hits, first);
    const Triple direction = ray * (1.0F / square_root(dot(ray, ray)));
    color = select(hit, color, sky(frame, direction));
  }
  store(light.rgb, first, color);
  store(light.grey + first, 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z);
}

void shade(const FrameLight& frame, const PacketHits& hits, const PacketSurface& surface,
           unsigned lit, PacketLight& light) {
  for (int first = 0; first < kPacketLanes; first += kLanes) {
    shade(frame, hits, surface, first, lit, light);
  }
}

}  // namespace
}  // namespace avoidbench
