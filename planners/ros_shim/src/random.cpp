#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

// rand() of the nodes. The C library's has one state for the whole process, so that a flight would
// depend on those before it; this one belongs to the library, of which each trial has a copy. The
// numbers are the C library's: from seed 1 as in a process that has just started. The same as
// lib/sim/maps/glibc_random, which the shim can't use: planners are built with the SDK alone.
namespace {

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

Random& numbers() {
  static Random random(1);
  return random;
}

}  // namespace

// As the C library declares them.
extern "C" {
int rand() noexcept { return numbers().next(); }
void srand(unsigned seed) noexcept { numbers() = Random(seed); }
long random() noexcept { return numbers().next(); }
void srandom(unsigned seed) noexcept { numbers() = Random(seed); }
}
