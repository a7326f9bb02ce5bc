#include "maps/glibc_random.hpp"

namespace avoidbench {
namespace {

constexpr int kDiscarded = 310;  // draws that srand() makes and drops

/// 16807 · word modulo 2³¹ - 1 (Park and Miller 1988), by Schrage's division as glibc has it: a
/// negative word gives what that gives.
std::int32_t park_miller(std::int32_t word) {
  constexpr std::int32_t kPrime = 2147483647, kQuotient = 127773, kRest = 2836;
  const std::int32_t next = 16807 * (word % kQuotient) - kRest * (word / kQuotient);
  return next < 0 ? next + kPrime : next;
}

}  // namespace

GlibcRandom::GlibcRandom(std::uint32_t seed) {
  // As srand() does: 0 would stay 0 for ever.
  auto word = static_cast<std::int32_t>(seed == 0 ? 1U : seed);
  for (std::uint32_t& value : state_) {
    value = static_cast<std::uint32_t>(word);
    word = park_miller(word);
  }
  for (int i = 0; i < kDiscarded; ++i) next();
}

std::int32_t GlibcRandom::next() {
  // r[i] = r[i - 3] + r[i - 31]: the oldest is r[i - 31], and its place takes the sum.
  std::uint32_t& value = state_[oldest_];
  value += state_[(oldest_ + kLags - kShortLag) % kLags];
  oldest_ = (oldest_ + 1) % kLags;
  return static_cast<std::int32_t>(value >> 1U);
}

}  // namespace avoidbench
