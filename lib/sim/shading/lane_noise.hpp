#pragma once

#include "render/lanes.hpp"

/// Value noise, lane by lane: a smooth field through random numbers that stand at whole
/// coordinates. It depends on nothing but the coordinates and the key.
namespace avoidbench {
namespace {

AB_LANE Floats mix(Floats a, Floats b, Floats t) { return a + (b - a) * t; }

/// 0 below `low`, 1 above `high`, smooth between.
AB_LANE Floats smooth_step(float low, float high, Floats x) {
  const Floats t = within_unit((x - low) * (1.0F / (high - low)));
  return t * t * (3.0F - 2.0F * t);
}

/// Part of detail of this size that a pixel of this footprint resolves: none of what is no larger
/// than the pixel, all of what is twice as large.
AB_LANE Floats seen(float size, Floats footprint) {
  return within_unit(2.0F - footprint * (2.0F / size));
}

/// The two signed halves of a lane as products_of_halves() takes them.
constexpr std::uint32_t halves(int low, int high) {
  return (static_cast<std::uint32_t>(high) << 16U) | (static_cast<std::uint32_t>(low) & 0xffffU);
}

/// A coordinate of the lattice, ready to be added to those of the other axes.
AB_LANE Ints x_key(Ints x) { return products_of_halves(x, all_lanes(halves(32529, 25947))); }
AB_LANE Ints y_key(Ints y) { return products_of_halves(y, all_lanes(halves(19041, 26741))) << 6; }
AB_LANE Ints z_key(Ints z) { return products_of_halves(z, all_lanes(halves(29327, 17839))) << 3; }

/// A key of its own for each number: for seeds and octaves.
constexpr std::uint32_t salt(std::uint32_t number) { return number * 0x9e3779b9U; }
AB_LANE Ints salted(Ints key, std::uint32_t number) { return key + salt(number); }

/// Mixes a lattice point's key, so that points near each other are uncorrelated as far as 160 × 160
/// of them can tell. As a number it is evenly spread over ±2³¹; its lowest bit is 0.
AB_LANE Ints mixed(Ints key) {
  Ints h = key ^ key >> 13;
  h = products_of_halves(h, all_lanes(halves(27197, -21883)));
  h = h ^ h >> 15;
  return products_of_halves(h, all_lanes(halves(-32603, 18517))) << 1;
}

AB_LANE Floats number_at(Ints key) { return to_floats(mixed(key)); }

/// Ten bits of a mixed key as a number in [0, 1).
template <int kShift>
AB_LANE Floats part_of(Ints hash) {
  return to_floats(hash >> kShift & 0x3ffU) * 0x1p-10F;
}

/// Scales mixed numbers to ±0.5.
constexpr float kNoiseScale = 0x1p-32F;

/// Noise within ±0.5, and its slope along each axis.
struct Noise {
  Floats value, slope_x, slope_y, slope_z;
};

/// What interpolation needs of one coordinate.
struct Along {
  Ints whole;
  Floats t, slope;  ///< smooth weight of the upper neighbour, and its derivative
};

AB_LANE Along along(Floats x) {
  const Split parts = split(x);
  const Floats t = parts.rest;
  return {parts.whole, t * t * (3.0F - 2.0F * t), 6.0F * t * (1.0F - t)};
}

AB_LANE Noise noise(Floats x, Floats y, Ints key) {
  const Along ax = along(x);
  const Along ay = along(y);
  const Ints x0 = x_key(ax.whole) + key;
  const Ints x1 = x_key(ax.whole + 1U) + key;
  const Ints y0 = y_key(ay.whole);
  const Ints y1 = y_key(ay.whole + 1U);
  const Floats n00 = number_at(x0 + y0);
  const Floats n01 = number_at(x0 + y1);
  const Floats low = number_at(x1 + y0) - n00;
  const Floats high = number_at(x1 + y1) - n01;
  const Floats row0 = n00 + low * ax.t;
  const Floats row1 = n01 + high * ax.t;
  return {mix(row0, row1, ay.t) * kNoiseScale, mix(low, high, ay.t) * ax.slope * kNoiseScale,
          (row1 - row0) * ay.slope * kNoiseScale, all_lanes(0.0F)};
}

AB_LANE Noise noise(Floats x, Floats y, Floats z, Ints key) {
  const Along ax = along(x);
  const Along ay = along(y);
  const Along az = along(z);
  const Ints x0 = x_key(ax.whole) + key;
  const Ints x1 = x_key(ax.whole + 1U) + key;
  const Ints y0 = y_key(ay.whole);
  const Ints y1 = y_key(ay.whole + 1U);
  const Ints z0 = z_key(az.whole);
  const Ints z1 = z_key(az.whole + 1U);
  const Ints x0y0 = x0 + y0, x0y1 = x0 + y1, x1y0 = x1 + y0, x1y1 = x1 + y1;
  const Floats n000 = number_at(x0y0 + z0), n010 = number_at(x0y1 + z0);
  const Floats n001 = number_at(x0y0 + z1), n011 = number_at(x0y1 + z1);
  const Floats d00 = number_at(x1y0 + z0) - n000, d10 = number_at(x1y1 + z0) - n010;
  const Floats d01 = number_at(x1y0 + z1) - n001, d11 = number_at(x1y1 + z1) - n011;
  const Floats e00 = n000 + d00 * ax.t, e10 = n010 + d10 * ax.t;
  const Floats e01 = n001 + d01 * ax.t, e11 = n011 + d11 * ax.t;
  const Floats f0 = mix(e00, e10, ay.t), f1 = mix(e01, e11, ay.t);
  return {mix(f0, f1, az.t) * kNoiseScale,
          mix(mix(d00, d10, ay.t), mix(d01, d11, ay.t), az.t) * ax.slope * kNoiseScale,
          mix(e10 - e00, e11 - e01, az.t) * ay.slope * kNoiseScale,
          (f1 - f0) * az.slope * kNoiseScale};
}

/// A chain of octaves of noise, each of half the size of the one before and `decay` times its
/// weight.
struct Chain {
  float size;  ///< of the first, whose weight is 1
  int count;
  float decay = 0.5F;
};

/// The sum of a chain at points where `of(frequency, key)` is one octave of it. What is finer than
/// the footprint fades out and, where no lane sees it, costs nothing. The value lies around 0;
/// slopes are those of the sum times the chain's size.
template <class Octave>
AB_LANE Noise sum_of(const Chain& chain, Floats footprint, Ints key, Octave of) {
  // Not Noise{}, of which g++ 12 makes a loop over memory.
  Noise sum;
  sum.value = sum.slope_x = sum.slope_y = sum.slope_z = Floats{};
  float frequency = 1.0F / chain.size;
  float weight = 1.0F;
  float slope = 1.0F;
  for (int octave = 0; octave < chain.count; ++octave) {
    const Floats visible = seen(1.0F, footprint * frequency);
    if (!any(visible > 0.0F)) break;
    const Noise one = of(frequency, key);
    sum.value = sum.value + visible * weight * one.value;
    const Floats visible_slope = visible * slope;
    sum.slope_x = sum.slope_x + visible_slope * one.slope_x;
    sum.slope_y = sum.slope_y + visible_slope * one.slope_y;
    sum.slope_z = sum.slope_z + visible_slope * one.slope_z;
    frequency *= 2.0F;
    weight *= chain.decay;
    slope *= 2.0F * chain.decay;
    key = salted(key, 1U);
  }
  return sum;
}

AB_LANE Noise octaves(Floats x, Floats y, const Chain& chain, Floats footprint, Ints key) {
  return sum_of(chain, footprint, key, [&](float frequency, Ints octave_key) {
    return noise(x * frequency, y * frequency, octave_key);
  });
}

AB_LANE Noise octaves(Floats x, Floats y, Floats z, const Chain& chain, Floats footprint,
                      Ints key) {
  return sum_of(chain, footprint, key, [&](float frequency, Ints octave_key) {
    return noise(x * frequency, y * frequency, z * frequency, octave_key);
  });
}

/// The nearest of centres that lie one in each unit cube, anywhere in it (Worley 1996).
struct Cell {
  Floats square_distance;
  Ints hash;  ///< of the centre: the same all over its cell
};

inline Cell nearest_cell(Floats x, Floats y, Floats z, Ints key) {
  // The lattice cell that holds the point and its neighbours on the nearer side: the nearest centre
  // is nearly always there.
  const Split sx = split(x - 0.5F);
  const Split sy = split(y - 0.5F);
  const Split sz = split(z - 0.5F);
  Cell best{all_lanes(1e9F), key};
  for (unsigned i = 0; i < 8; ++i) {
    const unsigned dx = i & 1U, dy = i >> 1U & 1U, dz = i >> 2U;
    const Ints hash =
        mixed(x_key(sx.whole + dx) + y_key(sy.whole + dy) + z_key(sz.whole + dz) + key);
    // From the centre's cube, in which the point is half a unit further than in its own.
    const Floats ex = sx.rest + (0.5F - static_cast<float>(dx)) - part_of<1>(hash);
    const Floats ey = sy.rest + (0.5F - static_cast<float>(dy)) - part_of<11>(hash);
    const Floats ez = sz.rest + (0.5F - static_cast<float>(dz)) - part_of<21>(hash);
    const Floats square = ex * ex + ey * ey + ez * ez;
    best.hash = select(square < best.square_distance, hash, best.hash);
    best.square_distance = least(square, best.square_distance);
  }
  return best;
}

}  // namespace
}  // namespace avoidbench
