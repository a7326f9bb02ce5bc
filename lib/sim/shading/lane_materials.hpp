#pragma once

#include "shading/lane_noise.hpp"

/// What the materials look like, lane by lane. A look depends on the point of the object alone,
/// so that two cameras see the same texture; the footprint only fades what is too fine for a pixel.
namespace avoidbench {
namespace {

/// Linear RGB, the same in all lanes.
struct Rgb {
  float r, g, b;
};

/// Linear RGB, or a vector.
struct Triple {
  Floats x, y, z;
};

AB_LANE Triple all_lanes(Rgb c) { return {all_lanes(c.r), all_lanes(c.g), all_lanes(c.b)}; }
AB_LANE Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
AB_LANE Triple operator*(const Triple& a, Floats s) { return {a.x * s, a.y * s, a.z * s}; }
AB_LANE Floats dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
AB_LANE Triple mix(const Triple& a, const Triple& b, Floats t) {
  return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}
AB_LANE Triple mix(Rgb a, Rgb b, Floats t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}
AB_LANE Triple select(Mask mask, const Triple& yes, const Triple& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// Points of surfaces as their material sees them, in the object's frame.
struct Points {
  Triple at;         ///< [m]
  Triple normal;     ///< unit
  Ints seed;         ///< of the object
  Floats footprint;  ///< size of a pixel on the surface [m]; huge in lanes of other materials
};

/// What light meets there.
struct Look {
  Triple albedo;
  Triple tilt;                            ///< to be added to the unit normal: relief
  Floats crevice = all_lanes(1.0F);       ///< part of the sky that reaches the point
  Floats translucency = all_lanes(0.0F);  ///< part of the sun that shines through from behind
  Floats glow = all_lanes(0.0F);          ///< light of its own, times the albedo
};

/// Coordinates along the surface: the two axes of the object that the normal points least along.
struct Flat {
  Mask is_level, is_across;  ///< the axes are x and y; else, y and z; else x and z
  Floats x, y;
};

AB_LANE Flat along_surface(const Points& p) {
  const Floats nx = magnitude(p.normal.x);
  const Floats ny = magnitude(p.normal.y);
  const Floats nz = magnitude(p.normal.z);
  const Mask is_level = greatest(nx, ny) <= nz;
  const Mask is_across = ny <= nx;
  return {is_level, is_across, select(is_level, p.at.x, select(is_across, p.at.y, p.at.x)),
          select(is_level, p.at.y, p.at.z)};
}

/// The tilt of a relief of these slopes along a flat's axes.
AB_LANE Triple tilt_along(const Flat& flat, Floats slope_x, Floats slope_y, float strength) {
  const Floats none{};
  const Floats x = slope_x * -strength;
  const Floats y = slope_y * -strength;
  return {select(flat.is_level, x, select(flat.is_across, none, x)),
          select(flat.is_level, y, select(flat.is_across, x, none)),
          select(flat.is_level, none, y)};
}

AB_LANE Triple untilted() { return all_lanes(Rgb{0.0F, 0.0F, 0.0F}); }

AB_LANE Ints key_of(std::uint32_t number) { return all_lanes(salt(number)); }

/// Earth with patches of grass, fresh and dry.
inline Look soil(const Points& p) {
  const Flat at = along_surface(p);
  const Noise patches = octaves(at.x, at.y, Chain{3.5F, 5}, p.footprint, key_of(11U));
  const Noise tones = octaves(at.x, at.y, Chain{9.0F, 3}, p.footprint, key_of(23U));
  const Noise blades = octaves(at.x, at.y, Chain{0.64F, 6, 0.8F}, p.footprint, key_of(37U));
  const Floats fine = 0.5F + 0.55F * blades.value;
  const Floats coarse = 0.5F + 0.6F * patches.value + 0.25F * tones.value;
  const Floats level = within_unit(0.6F * fine + 0.4F * coarse);
  const Triple earth = mix(Rgb{0.060F, 0.037F, 0.021F}, Rgb{0.29F, 0.20F, 0.123F}, level);
  const Triple fresh = mix(Rgb{0.022F, 0.048F, 0.011F}, Rgb{0.15F, 0.235F, 0.052F}, level);
  const Triple dry = mix(Rgb{0.09F, 0.077F, 0.027F}, Rgb{0.38F, 0.315F, 0.126F}, level);
  const Triple grass = mix(fresh, dry, smooth_step(0.42F, 0.68F, 0.5F + 0.5F * tones.value));
  Look look;
  look.albedo =
      mix(earth, grass, smooth_step(-0.10F, 0.04F, 0.5F * patches.value + 0.11F * blades.value));
  look.tilt = tilt_along(at, blades.slope_x, blades.slope_y, 0.055F);
  look.crevice = 0.88F + 0.25F * blades.value;
  return look;
}

/// Streaks, long up the stem and narrow around it, with blotches, and moss at the foot.
inline Look bark(const Points& p) {
  constexpr float kStretch = 0.22F;
  const Noise plates =
      octaves(p.at.x, p.at.y, p.at.z * kStretch, Chain{0.06F, 4}, p.footprint, p.seed);
  const Noise blotches =
      octaves(p.at.x, p.at.y, p.at.z, Chain{0.7F, 4, 0.7F}, p.footprint, salted(p.seed, 7U));
  // Where the plates are too fine to be seen, their mean.
  constexpr float kMeanCrack = 0.72F;
  const Floats crack = kMeanCrack + seen(0.06F, p.footprint) *
                                        (smooth_step(-0.32F, 0.04F, plates.value) - kMeanCrack);
  const Floats blotch = 0.5F + 0.5F * blotches.value;
  Look look;
  look.albedo =
      mix(Rgb{0.030F, 0.020F, 0.014F}, Rgb{0.24F, 0.165F, 0.11F}, crack) * (0.5F + blotch);
  const Floats moss = smooth_step(0.55F, 0.75F, blotch) * (1.0F - smooth_step(0.0F, 2.5F, p.at.z));
  look.albedo = mix(look.albedo, all_lanes(Rgb{0.085F, 0.12F, 0.035F}), 0.6F * moss);
  constexpr float kStrength = 0.5F;
  look.tilt = {plates.slope_x * -kStrength, plates.slope_y * -kStrength,
               plates.slope_z * (-kStrength * kStretch)};
  look.crevice = 0.55F + 0.45F * crack;
  return look;
}

/// Clusters of leaves; near by single ones, each of its own tone and tilt, with the dark of the
/// crown between them.
inline Look leaf(const Points& p) {
  constexpr float kLeaf = 0.085F;
  const Floats plant = part_of<3>(p.seed);
  const Noise clusters =
      octaves(p.at.x, p.at.y, p.at.z, Chain{0.45F, 2}, p.footprint, salted(p.seed, 3U));
  Look look;
  look.tilt = Triple{clusters.slope_x, clusters.slope_y, clusters.slope_z} * all_lanes(-0.35F);
  Floats tone = 0.5F + 0.45F * clusters.value;
  constexpr float kMeanBetween = 0.5F;
  Floats between = all_lanes(kMeanBetween);
  const Floats visible = seen(kLeaf, p.footprint);
  if (any(visible > 0.0F)) {
    constexpr float kLeaves = 1.0F / kLeaf;
    const Cell cell = nearest_cell(p.at.x * kLeaves, p.at.y * kLeaves, p.at.z * kLeaves, p.seed);
    tone = tone + visible * 0.6F * (part_of<6>(cell.hash) - 0.5F);
    between = between + visible * (smooth_step(0.12F, 0.42F, cell.square_distance) - kMeanBetween);
    const Floats tilt = visible * 1.3F;
    look.tilt = look.tilt + Triple{tilt * (part_of<9>(cell.hash) - 0.5F),
                                   tilt * (part_of<15>(cell.hash) - 0.5F),
                                   tilt * (part_of<22>(cell.hash) - 0.5F)};
    const Noise veins =
        octaves(p.at.x, p.at.y, p.at.z, Chain{0.03F, 2}, p.footprint, salted(p.seed, 5U));
    tone = tone + 0.35F * veins.value;
  }
  const Triple dark = mix(Rgb{0.020F, 0.050F, 0.010F}, Rgb{0.045F, 0.060F, 0.010F}, plant);
  const Triple light = mix(Rgb{0.10F, 0.22F, 0.034F}, Rgb{0.25F, 0.28F, 0.045F}, plant);
  look.albedo = mix(dark, light, within_unit(tone)) * (1.25F - 0.95F * between);
  look.crevice = 1.0F - 0.65F * between;
  look.translucency = all_lanes(0.55F);
  return look;
}

/// Courses of bricks, each of its own shade, some burnt dark, in pale mortar.
inline Look brick(const Points& p) {
  constexpr float kLength = 0.40F, kHeight = 0.16F, kMortar = 0.014F;
  const Flat at = along_surface(p);
  const Split course = split(at.y * (1.0F / kHeight));
  const Floats is_odd = to_floats(course.whole & 1U);
  const Split brick_of = split(at.x * (1.0F / kLength) + is_odd * 0.5F);
  const Floats to_side = least(brick_of.rest, 1.0F - brick_of.rest) * kLength;
  const Floats to_bed = least(course.rest, 1.0F - course.rest) * kHeight;
  const Floats edge = 0.5F * p.footprint + 0.003F;
  const Floats across =
      within_unit((least(to_side, to_bed) - 0.5F * kMortar + edge) / (2.0F * edge));
  const Floats visible = seen(kHeight, p.footprint);
  constexpr float kBrickPart = (1.0F - kMortar / kLength) * (1.0F - kMortar / kHeight);
  const Floats inside =
      kBrickPart + visible * (across * across * (3.0F - 2.0F * across) - kBrickPart);
  const Ints hash = mixed(x_key(brick_of.whole) + y_key(course.whole) + p.seed);
  const Floats shade = 0.5F + visible * (part_of<3>(hash) - 0.5F);
  const Floats burnt = visible * select(part_of<14>(hash) > 0.82F, all_lanes(0.8F), Floats{}) +
                       (1.0F - visible) * 0.14F;
  const Noise grain = octaves(at.x, at.y, Chain{0.06F, 3}, p.footprint, salted(p.seed, 5U));
  const Noise stain = octaves(at.x, at.y, Chain{1.6F, 4}, p.footprint, salted(p.seed, 9U));
  const Triple clay = mix(mix(Rgb{0.22F, 0.075F, 0.045F}, Rgb{0.46F, 0.19F, 0.11F}, shade),
                          all_lanes(Rgb{0.17F, 0.085F, 0.07F}), burnt);
  Look look;
  look.albedo = mix(all_lanes(Rgb{0.40F, 0.38F, 0.34F}), clay, inside) *
                (0.95F + 0.4F * grain.value + 0.5F * stain.value);
  look.tilt = untilted();
  look.crevice = 0.75F + 0.25F * inside;
  return look;
}

/// Stained slabs of 3 m with a groove between them.
inline Look concrete(const Points& p) {
  constexpr float kSlab = 3.0F, kGroove = 0.012F;
  const Flat at = along_surface(p);
  const Noise stain = octaves(at.x, at.y, Chain{2.2F, 5, 0.7F}, p.footprint, p.seed);
  const Noise grit = octaves(at.x, at.y, Chain{0.07F, 4, 0.8F}, p.footprint, salted(p.seed, 41U));
  const Floats from_x = magnitude(split(at.x * (1.0F / kSlab) + 0.5F).rest - 0.5F);
  const Floats from_y = magnitude(split(at.y * (1.0F / kSlab) + 0.5F).rest - 0.5F);
  const Floats width = kGroove + 0.5F * p.footprint;
  const Floats t = within_unit((least(from_x, from_y) * kSlab - 0.4F * width) / (0.6F * width));
  const Floats groove = (1.0F - t * t * (3.0F - 2.0F * t)) * (0.55F * kGroove / width);
  Look look;
  look.albedo =
      mix(Rgb{0.15F, 0.147F, 0.14F}, Rgb{0.36F, 0.35F, 0.33F}, 0.5F + 0.55F * stain.value) *
      ((1.0F + 0.45F * grit.value) * (1.0F - groove));
  look.tilt = untilted();
  return look;
}

/// One of six paints by the object's seed.
AB_LANE Triple paint_of(Ints seed) {
  constexpr Rgb kPaints[6] = {{0.78F, 0.50F, 0.045F}, {0.55F, 0.075F, 0.050F},
                              {0.055F, 0.19F, 0.46F}, {0.075F, 0.34F, 0.16F},
                              {0.70F, 0.26F, 0.040F}, {0.050F, 0.055F, 0.060F}};
  const Floats number = part_of<7>(seed) * 6.0F;
  Triple paint = all_lanes(kPaints[0]);
  for (int i = 1; i < 6; ++i) {
    paint = select(number >= static_cast<float>(i), all_lanes(kPaints[i]), paint);
  }
  return paint;
}

/// Painted stripes that wind around the object's z axis, worn to rust in places, scratched around.
inline Look painted_metal(const Points& p) {
  constexpr float kPeriod = 0.9F;
  // Turns around the axis, up to a smooth change of pace: it closes on itself and needs no atan.
  const Floats ax = magnitude(p.at.x);
  const Floats ay = magnitude(p.at.y);
  const Floats quarter = 0.25F * ay / (ax + ay + 1e-6F);
  const Floats half = select(p.at.x < 0.0F, 0.5F - quarter, quarter);
  const Floats phase = p.at.z * (1.0F / kPeriod) + turned(half, p.at.y) + part_of<17>(p.seed);
  const Floats saw = magnitude(2.0F * split(phase).rest - 1.0F);
  const Floats blur = p.footprint * (1.0F / kPeriod) + 0.01F;
  const Floats t = within_unit((saw - 0.5F + blur) / (2.0F * blur));
  const Floats visible = seen(kPeriod, p.footprint);
  const Floats stripe = 0.5F + visible * (t * t * (3.0F - 2.0F * t) - 0.5F);
  const Noise wear =
      octaves(p.at.x, p.at.y, p.at.z, Chain{0.5F, 5}, p.footprint, salted(p.seed, 17U));
  const Noise scratch = octaves(p.at.x, p.at.y, 4.0F * p.at.z, Chain{0.07F, 3, 0.8F},
                                3.0F * p.footprint, salted(p.seed, 19U));
  Look look;
  look.albedo = mix(paint_of(p.seed), all_lanes(Rgb{0.62F, 0.61F, 0.58F}), stripe) *
                (1.0F + 0.4F * scratch.value + 0.3F * wear.value);
  look.albedo = mix(look.albedo, all_lanes(Rgb{0.13F, 0.075F, 0.045F}),
                    smooth_step(0.18F, 0.46F, wear.value));
  look.tilt = untilted();
  return look;
}

inline Look lamp() {
  Look look;
  look.albedo = all_lanes(Rgb{0.90F, 0.88F, 0.82F});
  look.tilt = untilted();
  look.glow = all_lanes(1.2F);
  return look;
}

/// About the mean of each material, in the order of the enum: what a bland surface looks like.
constexpr Rgb kBlandAlbedo[7] = {
    {0.13F, 0.12F, 0.055F}, {0.14F, 0.10F, 0.07F}, {0.10F, 0.15F, 0.03F}, {0.33F, 0.14F, 0.09F},
    {0.25F, 0.245F, 0.23F}, {0.45F, 0.44F, 0.42F}, {0.90F, 0.88F, 0.82F}};

/// The look of a material by its number in the enum Material.
AB_LANE Look look_of(int material, const Points& p) {
  switch (material) {
    case 0:
      return soil(p);
    case 1:
      return bark(p);
    case 2:
      return leaf(p);
    case 3:
      return brick(p);
    case 4:
      return concrete(p);
    case 5:
      return painted_metal(p);
    default:
      return lamp();
  }
}

/// The same with its texture as strong as `opacity` says.
AB_LANE Look faded_look(int material, const Points& p, Floats opacity) {
  Look look = look_of(material, p);
  look.albedo = {greatest(look.albedo.x, 0.0F), greatest(look.albedo.y, 0.0F),
                 greatest(look.albedo.z, 0.0F)};
  look.albedo = mix(all_lanes(kBlandAlbedo[material]), look.albedo, opacity);
  look.tilt = look.tilt * opacity;
  look.crevice = 1.0F + (look.crevice - 1.0F) * opacity;
  return look;
}

}  // namespace
}  // namespace avoidbench
