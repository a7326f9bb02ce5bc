#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace avoidbench::repeatable {

/// rand() of the C library, which has one state for the whole process; from seed 1 its numbers are
/// those of a process that has just started. The same as lib/sim/maps/glibc_random, which planners
/// can't use: they are built with the SDK alone.
class Random {
 public:
  explicit Random(std::uint32_t seed) {
    auto word = static_cast<std::int32_t>(seed == 0 ? 1U : seed);
    for (std::uint32_t& value : state_) {
      value = static_cast<std::uint32_t>(word);
      word = park_miller(word);
    }
    constexpr int kDiscarded = 310;
    for (int i = 0; i < kDiscarded; ++i) next();
  }

  /// r[i] = r[i - 3] + r[i - 31]: the oldest is r[i - 31], and its place takes the sum. After the
  /// 31 words that the seed gives the first three come once more.
  std::int32_t next() {
    std::uint32_t& value = state_[oldest_];
    value += state_[(oldest_ + kLags - kShortLag) % kLags];
    oldest_ = (oldest_ + 1) % kLags;
    return static_cast<std::int32_t>(value >> 1U);
  }

 private:
  static constexpr std::size_t kLags = 31, kShortLag = 3;

  /// 16807 · word modulo 2³¹ - 1, by Schrage's division.
  static std::int32_t park_miller(std::int32_t word) {
    constexpr std::int32_t kPrime = 2147483647, kQuotient = 127773, kRest = 2836;
    const std::int32_t next = 16807 * (word % kQuotient) - kRest * (word / kQuotient);
    return next < 0 ? next + kPrime : next;
  }

  std::array<std::uint32_t, kLags> state_{};
  std::size_t oldest_ = kShortLag;
};

/// What clocks and chance are at. Several threads may look at the clock: each finds a time of its
/// own.
struct State {
  std::atomic<std::int64_t> next_ns{0};
  std::atomic<std::int64_t> step_ns{1000};
  std::atomic<void (*)(std::int64_t)> sleep_for_ns{nullptr};
  Random random{1};
  std::atomic<std::uint64_t> device{0};  ///< of std::random_device
};

/// Of the instance whose call this thread is in, else of the library.
State& state();

}  // namespace avoidbench::repeatable
