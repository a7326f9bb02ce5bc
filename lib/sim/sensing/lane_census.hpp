#pragma once

#include "sensing/census_kernels.hpp"
#include "sensing/census_lanes.hpp"

/// The source of both builds of the census matcher's loops; see census_kernels.hpp.
#if defined(__clang__)
#define AB_UNROLL  // clang unrolls of itself
#else
#define AB_UNROLL _Pragma("GCC unroll 16")
#endif

namespace avoidbench::census {
namespace {

/// Bit: pixel >= its mirror through the centre, for each pair of the window.
void transform(const PaddedImage& image, std::uint8_t* planes, std::ptrdiff_t plane_stride) {
  std::ptrdiff_t offsets[kMostPairs];
  int count = 0;
  for (int dy = -image.reach_y_px; dy <= 0; ++dy) {
    // Half of the window; each pixel of it has its mirror in the other half: of 9 × 7 pixels
    // (9 · 7 - 1) / 2 = 31 pairs.
    for (int dx = -image.reach_x_px; dx <= (dy < 0 ? image.reach_x_px : -1); ++dx) {
      offsets[count++] = dy * image.stride + (image.mirrored ? -dx : dx);
    }
  }
  const int plane_count = (count + 7) / 8;
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint8_t* row = image.pixels + y * image.stride;
    for (int k = 0; k < plane_count; ++k) {
      std::uint8_t* plane = planes + (y * plane_count + k) * plane_stride;
      const int end = 8 * k + 8 < count ? 8 * k + 8 : count;
      for (int x = 0; x < image.width_px; x += kBytes) {
        Bytes bits{};
        for (int i = 8 * k; i < end; ++i) {
          const auto pixel = load<Bytes>(row + x + offsets[i]);
          const auto is_set =
              bits_as<Bytes>(greatest(pixel, load<Bytes>(row + x - offsets[i])) == pixel);
          // Shifts the bits by one and adds the new one.
          bits = bits + bits - is_set;  // a mask is −1
        }
        store(plane + x, bits);
      }
    }
  }
}

/// One pixel's values for all disparities.
template <int kVectors>
struct Disparities {
  Bytes at[static_cast<std::size_t>(kVectors)];
};

/// Hamming distances of the left pixel's census and the right ones' at all disparities.
template <int kVectors, int kPlanes>
[[gnu::always_inline]] inline void count_differing(const Frame& frame, int x, int y,
                                                   Disparities<kVectors>& costs) {
  const std::uint8_t* left = frame.left_planes + y * kPlanes * frame.plane_stride + x;
  const std::uint8_t* right =
      frame.right_planes + y * kPlanes * frame.plane_stride + (frame.width_px - 1 - x);
  Bytes census[static_cast<std::size_t>(kPlanes)];
  AB_UNROLL
  for (int k = 0; k < kPlanes; ++k) census[k] = all_bytes(left[k * frame.plane_stride]);
  AB_UNROLL
  for (int j = 0; j < kVectors; ++j) {
    Bytes differing[static_cast<std::size_t>(kPlanes)];
    AB_UNROLL
    for (int k = 0; k < kPlanes; ++k) {
      differing[k] = census[k] ^ load<Bytes>(right + k * frame.plane_stride + j * kBytes);
    }
    if constexpr (kPlanes == 4) {
      costs.at[j] = count_bits(differing[0], differing[1], differing[2], differing[3]);
    } else {
      costs.at[j] = count_bits(differing[0], differing[1]);
    }
  }
}

/// What is padded costs 255: with saturating sums, more than all else.
template <int kVectors>
[[gnu::always_inline]] inline void find_costs(const Frame& frame, int x, int y, Bytes padding,
                                              Disparities<kVectors>& costs) {
  frame.planes == 4 ? count_differing<kVectors, 4>(frame, x, y, costs)
                    : count_differing<kVectors, 2>(frame, x, y, costs);
  costs.at[kVectors - 1] |= padding;
}

struct Penalties {
  Bytes small, large;
};

/// A path's next value. `lowest` is the least of the values before: they are taken less it.
[[gnu::always_inline]] inline Bytes next_on_path(Bytes same, Bytes nearer, Bytes farther,
                                                 Bytes lowest, const Penalties& penalties,
                                                 Bytes cost) {
  const Bytes stepped = add_saturated(least(nearer, farther), penalties.small);
  // As Hirschmüller's (2008): the least of the row before is taken off at once, so that values stay
  // below cost + large penalty and within a byte.
  const Bytes before = least(least(same, stepped) - lowest, penalties.large);
  return add_saturated(before, cost);
}

/// A path along the row; its values stay in registers.
template <int kVectors>
struct RowPath {
  Disparities<kVectors> values;
  Bytes lowest;

  void start() {
    AB_UNROLL
    for (int j = 0; j < kVectors; ++j) values.at[j] = Bytes{};
    lowest = Bytes{};
  }

  [[gnu::always_inline]] void advance(const Penalties& penalties,
                                      const Disparities<kVectors>& costs) {
    const Bytes all = all_bytes(255);
    Disparities<kVectors> next;
    Bytes lowest_now = all;
    AB_UNROLL
    for (int j = 0; j < kVectors; ++j) {
      const Bytes before = j > 0 ? values.at[j > 0 ? j - 1 : 0] : all;
      const Bytes after = j + 1 < kVectors ? values.at[j + 1 < kVectors ? j + 1 : j] : all;
      const Bytes nearer = part_of_both<kBytes - 1>(before, values.at[j]);
      const Bytes farther = part_of_both<1>(values.at[j], after);
      next.at[j] = next_on_path(values.at[j], nearer, farther, lowest, penalties, costs.at[j]);
      lowest_now = least(lowest_now, next.at[j]);
    }
    values = next;
    lowest = spread_least(lowest_now);
  }
};

/// A path from the row before: its values there are in a slot, which takes the new ones.
template <int kVectors>
[[gnu::always_inline]] inline void advance_slot(std::uint8_t* slot, std::uint8_t* slot_least,
                                                const Penalties& penalties,
                                                const Disparities<kVectors>& costs,
                                                Disparities<kVectors>& next) {
  const Bytes lowest = all_bytes(*slot_least);
  Bytes lowest_now = all_bytes(255);
  AB_UNROLL
  for (int j = 0; j < kVectors; ++j) {
    const std::uint8_t* at = slot + j * kBytes;
    next.at[j] = next_on_path(load<Bytes>(at), load<Bytes>(at - 1), load<Bytes>(at + 1), lowest,
                              penalties, costs.at[j]);
    lowest_now = least(lowest_now, next.at[j]);
  }
  AB_UNROLL
  for (int j = 0; j < kVectors; ++j) store(slot + j * kBytes, next.at[j]);
  *slot_least = spread_least(lowest_now)[0];
}

/// The values of a path that starts at the border: what comes out is the cost alone.
void clear_slot(const Frame& frame, int path, std::ptrdiff_t slot) {
  std::uint8_t* values = frame.slots[path] + slot * (frame.padded + kGuard);
  for (int d = 0; d < frame.padded; d += kBytes) store(values + d, Bytes{});
  frame.least[path][slot] = 0;
}

void clear_slots(const Frame& frame) {
  for (int path = 0; path < (frame.paths == 8 ? 3 : 1); ++path) {
    for (int slot = 0; slot < frame.width_px; ++slot) clear_slot(frame, path, slot);
    for (int slot = 0; slot <= frame.width_px; ++slot) {
      std::uint8_t* guard = frame.slots[path] + slot * (frame.padded + kGuard) - kGuard;
      for (int i = 0; i < kGuard; i += kBytes) store(guard + i, all_bytes(255));
    }
  }
}

/// A right pixel x' is met at x' + d by disparity d, so its candidates lie on a diagonal. The
/// window holds the least key so far of the right pixel x − d at d; from one pixel to the next,
/// leftwards, it moves on by one. What has then passed the chunk's disparities leaves it. `w`
/// counts words; chunks are apart, because keys compare only within one.
[[gnu::always_inline]] inline void keep_right_winners(std::uint16_t* window, int w,
                                                      bool last_of_chunk, Words keys) {
  std::uint16_t* at = window + w * kWords;
  const Words above = last_of_chunk ? all_words(0xFFFF) : load<Words>(window + (w + 1) * kWords);
  store(at, least(part_of_both<2>(load<Words>(at), above), keys));
}

/// The disparity in 1/16 px where two lines of equal and opposite slopes through the sums beside
/// the least one meet; at the ends of the range there are none.
inline int refine(const std::uint16_t* keys, int d, int disparities) {
  if (d == 0 || d + 1 >= disparities) return 16 * d;
  const int before = keys[d - 1] >> 6;
  const int after = keys[d + 1] >> 6;
  const int slope = (before > after ? before : after) - (keys[d] >> 6);
  // Three equal sums: anywhere between is as good.
  if (slope == 0) return 16 * d;
  // d + (before − after) / (2 slope), which is within half a pixel, to the nearest 1/16. All are
  // whole numbers below 2^16, of which the quotient in float is cut down to the same whole number.
  const auto sixteenths = static_cast<float>(16 * (before - after) + 17 * slope);
  return 16 * d - 8 + static_cast<int>(sixteenths / static_cast<float>(2 * slope));
}

/// Whether another sum, not beside the least one, is below its bound of frame.rival_bounds.
template <int kVectors>
[[gnu::always_inline]] inline bool has_rival(const Frame& frame, int best_sum, int best_d) {
  // All ones at the winner and beside it.
  const std::uint16_t* hidden = frame.three_words - best_d;
  Words others = all_words(0xFFFF);
  AB_UNROLL
  for (int w = 0; w < 2 * kVectors; ++w) {
    const Words keys = load<Words>(frame.keys + w * kWords);
    others = least(others, keys | load<Words>(hidden + w * kWords));
  }
  return (least_word(others) >> 6) < frame.rival_bounds[best_sum];
}

constexpr std::uint16_t kFirstDisparities[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                 8, 9, 10, 11, 12, 13, 14, 15};

/// Picks the left pixel's winner and gives every right pixel in reach its candidate. A key is a sum
/// of paths · 64 + the disparity within the chunk: the least one is that of the least sum and among
/// equal ones of the least disparity. Sums are at most 1016, so that a key has 16 bits.
template <int kVectors, int kPaths>
[[gnu::always_inline]] inline void pick_winner(const Frame& frame, int x, int y,
                                               const std::uint8_t* stored,
                                               const Disparities<kVectors>& first,
                                               const Disparities<kVectors>& second) {
  const bool keeps_keys = frame.subpixel || frame.is_unique;
  int best_key = 0xFFFF;
  int best_d = 0;
  Words lowest = all_words(0xFFFF);
  Words disparity = load<Words>(kFirstDisparities);
  AB_UNROLL
  for (int j = 0; j < kVectors; ++j) {
    const auto stored_first = load<Bytes>(stored + j * kBytes);
    Words keys[2] = {sum_of_half<false>(stored_first, first.at[j]),
                     sum_of_half<true>(stored_first, first.at[j])};
    if constexpr (kPaths == 8) {
      const auto stored_second = load<Bytes>(stored + (kVectors + j) * kBytes);
      keys[0] += sum_of_half<false>(stored_second, second.at[j]);
      keys[1] += sum_of_half<true>(stored_second, second.at[j]);
    }
    put_in_order(keys[0], keys[1]);
    const bool chunk_starts = j * kBytes % kChunk == 0;
    const bool chunk_ends = (j + 1) * kBytes % kChunk == 0 || j + 1 == kVectors;
    if (chunk_starts) disparity = load<Words>(kFirstDisparities);
    AB_UNROLL
    for (int half = 0; half < 2; ++half) {
      keys[half] += disparity;
      disparity += all_words(kWords);
      lowest = least(lowest, keys[half]);
      keep_right_winners(frame.window, 2 * j + half, chunk_ends && half == 1, keys[half]);
      if (keeps_keys) {
        store(frame.keys + (2 * j + half) * kWords, keys[half]);
      }
    }
    if (!chunk_ends) continue;
    const int chunk_key = least_word(lowest);
    const int chunk = j * kBytes / kChunk;
    // Between chunks only sums compare, and the first, nearer to zero, wins ties.
    if ((chunk_key >> 6) < (best_key >> 6)) {
      best_key = chunk_key;
      best_d = chunk * kChunk + (chunk_key & (kChunk - 1));
    }
    lowest = all_words(0xFFFF);
    // The chunk's first disparity is the last one that its right pixel meets.
    if (x >= chunk * kChunk) {
      frame.right_keys[chunk * frame.right_keys_stride + x - chunk * kChunk] =
          frame.window[chunk * kChunk];
    }
  }
  int winner = frame.subpixel ? refine(frame.keys, best_d, frame.disparities) : 16 * best_d;
  if (frame.is_unique && has_rival<kVectors>(frame, best_key >> 6, best_d)) winner = kNoWinner;
  frame.left_disparity[y * frame.disparity_stride + x] = static_cast<std::int16_t>(winner);
}

/// The best of the chunks, the nearer to zero where equal.
void write_right_row(const Frame& frame, int y) {
  std::int16_t* out = frame.right_disparity + y * frame.disparity_stride;
  for (int x = 0; x < frame.width_px; ++x) {
    int best_key = frame.right_keys[x];
    int best_d = best_key & (kChunk - 1);
    for (int chunk = 1; chunk * kChunk < frame.padded; ++chunk) {
      const int key = frame.right_keys[chunk * frame.right_keys_stride + x];
      if ((key >> 6) >= (best_key >> 6)) continue;
      best_key = key;
      best_d = chunk * kChunk + (key & (kChunk - 1));
    }
    out[x] = static_cast<std::int16_t>(best_d);
  }
}

/// One sweep over the image, downwards and to the right or, turned by 180°, upwards and to the
/// left: the path along the row and those from the row before. A diagonal keeps its slot, so the
/// slots of the two diagonals turn by one a row, and a slot is free again where its diagonal has
/// left the image. (The original's diagonals wrap around to the other border's column; ours start
/// again.)
template <int kVectors, int kPaths, bool kUp>
void sweep(const Frame& given) {
  const Frame frame = given;  // a copy, which stores of bytes cannot alias
  const int width = frame.width_px;
  const std::ptrdiff_t slot_stride = frame.padded + kGuard;
  const Penalties penalties{all_bytes(frame.small_penalty), all_bytes(frame.large_penalty)};
  const Bytes padding = frame.padded > frame.disparities ? last_sixteen() : Bytes{};
  clear_slots(frame);
  for (int step = 0; step < frame.height_px; ++step) {
    const int y = kUp ? frame.height_px - 1 - step : step;
    RowPath<kVectors> row;
    row.start();
    int behind = (width - step % width) % width;  // (column − step) mod width
    int ahead = step % width;                     // (column + step) mod width
    if constexpr (kPaths == 8) {
      // The diagonals that enter the image in this row begin with nothing behind them.
      clear_slot(frame, 1, behind);
      clear_slot(frame, 2, (ahead + width - 1) % width);
    }
    if constexpr (kUp) {
      for (int d = 0; d < frame.padded; d += kWords) {
        store(frame.window + d, all_words(0xFFFF));
      }
    }
    for (int column = 0; column < width; ++column) {
      const int x = kUp ? width - 1 - column : column;
      Disparities<kVectors> costs;
      find_costs(frame, x, y, padding, costs);
      row.advance(penalties, costs);
      Disparities<kVectors> first;
      Disparities<kVectors> second;
      advance_slot(frame.slots[0] + column * slot_stride, frame.least[0] + column, penalties, costs,
                   first);
      AB_UNROLL
      for (int j = 0; j < kVectors; ++j) {
        first.at[j] = add_saturated(first.at[j], row.values.at[j]);
      }
      if constexpr (kPaths == 8) {
        Disparities<kVectors> other;
        advance_slot(frame.slots[1] + behind * slot_stride, frame.least[1] + behind, penalties,
                     costs, second);
        advance_slot(frame.slots[2] + ahead * slot_stride, frame.least[2] + ahead, penalties, costs,
                     other);
        AB_UNROLL
        for (int j = 0; j < kVectors; ++j) {
          second.at[j] = add_saturated(second.at[j], other.at[j]);
        }
        behind = behind + 1 == width ? 0 : behind + 1;
        ahead = ahead + 1 == width ? 0 : ahead + 1;
      }
      std::uint8_t* stored = frame.volume + (static_cast<std::ptrdiff_t>(y) * width + x) *
                                                (kPaths / 4 * kVectors * kBytes);
      if constexpr (kUp) {
        pick_winner<kVectors, kPaths>(frame, x, y, stored, first, second);
      } else {
        AB_UNROLL
        for (int j = 0; j < kVectors; ++j) store(stored + j * kBytes, first.at[j]);
        if constexpr (kPaths == 8) {
          AB_UNROLL
          for (int j = 0; j < kVectors; ++j) {
            store(stored + (kVectors + j) * kBytes, second.at[j]);
          }
        }
      }
    }
    if constexpr (kUp) write_right_row(frame, y);
  }
}

template <int kPaths, bool kUp>
void sweep_padded(const Frame& frame) {
  constexpr int kStep = kDisparityStep / kBytes;
  switch (frame.padded / kDisparityStep) {
    case 1:
      return sweep<1 * kStep, kPaths, kUp>(frame);
    case 2:
      return sweep<2 * kStep, kPaths, kUp>(frame);
    case 3:
      return sweep<3 * kStep, kPaths, kUp>(frame);
    case 4:
      return sweep<4 * kStep, kPaths, kUp>(frame);
    case 5:
      return sweep<5 * kStep, kPaths, kUp>(frame);
    case 6:
      return sweep<6 * kStep, kPaths, kUp>(frame);
    case 7:
      return sweep<7 * kStep, kPaths, kUp>(frame);
    default:
      return sweep<8 * kStep, kPaths, kUp>(frame);
  }
}

void sweep_down(const Frame& frame) {
  frame.paths == 8 ? sweep_padded<8, false>(frame) : sweep_padded<4, false>(frame);
}

void sweep_up(const Frame& frame) {
  frame.paths == 8 ? sweep_padded<8, true>(frame) : sweep_padded<4, true>(frame);
}

/// Puts the lesser first.
inline void sort(SignedWords& a, SignedWords& b) {
  const SignedWords lesser = least(a, b);
  b = greatest(a, b);
  a = lesser;
}

void median_row(const std::int16_t* above, const std::int16_t* at, const std::int16_t* below,
                int width_px, std::int16_t* out) {
  for (int x = 0; x < width_px; x += kWords) {
    const std::int16_t* rows[3] = {above + x - 1, at + x - 1, below + x - 1};
    SignedWords low[3];
    SignedWords middle[3];
    SignedWords high[3];
    AB_UNROLL
    for (int column = 0; column < 3; ++column) {
      SignedWords a = load<SignedWords>(rows[0] + column);
      SignedWords b = load<SignedWords>(rows[1] + column);
      SignedWords c = load<SignedWords>(rows[2] + column);
      sort(a, b);
      sort(b, c);
      sort(a, b);
      low[column] = a;
      middle[column] = b;
      high[column] = c;
    }
    // Median of the columns' greatest minimum, median middle and least maximum.
    SignedWords a = greatest(greatest(low[0], low[1]), low[2]);
    sort(middle[0], middle[1]);
    SignedWords b = greatest(middle[0], least(middle[1], middle[2]));
    SignedWords c = least(least(high[0], high[1]), high[2]);
    sort(a, b);
    store(out + x, greatest(a, least(b, c)));
  }
}

}  // namespace
}  // namespace avoidbench::census
