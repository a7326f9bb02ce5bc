#include "maps/dotnet_random.hpp"

#include "base/check.hpp"

namespace avoidbench {
namespace {

constexpr std::int32_t kModulus = 2147483647;
constexpr std::int32_t kSeedOffset = 161803398;  // Knuth's, by the golden ratio
constexpr std::size_t kShortLag = 34;
constexpr std::size_t kSpread = 21;  // the seed's sequence goes to every 21st place
constexpr std::size_t kStirOffset = 31;
constexpr int kStirs = 4;

/// a - b, wrapping as C# does, plus the modulus where that is negative.
std::int32_t difference(std::int32_t a, std::int32_t b) {
  const auto wrapped =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
  return wrapped < 0 ? wrapped + kModulus : wrapped;
}

}  // namespace

DotnetRandom::DotnetRandom(std::int32_t seed) {
  std::int32_t magnitude = kModulus;  // of the one seed that has none
  if (seed != INT32_MIN) magnitude = seed < 0 ? -seed : seed;
  std::int32_t last = kSeedOffset - magnitude;
  state_[kLags - 1] = last;
  std::int32_t step = 1;
  for (std::size_t i = 1; i < kLags; ++i) {
    // 21 and 55 have no common factor: each place but the last is met once.
    const std::size_t place = kSpread * i % kLags - 1;
    state_[place] = step;
    step = difference(last, step);
    last = state_[place];
  }
  for (int stir = 0; stir < kStirs; ++stir) {
    for (std::size_t i = 0; i < kLags; ++i) {
      state_[i] = difference(state_[i], state_[(i + kStirOffset) % kLags]);
    }
  }
}

std::int32_t DotnetRandom::next() {
  std::int32_t value = difference(state_[at_], state_[(at_ + kLags - kShortLag) % kLags]);
  // .NET's own: it keeps next_double() below 1.
  if (value == kModulus) --value;
  state_[at_] = value;
  at_ = (at_ + 1) % kLags;
  return value;
}

std::int32_t DotnetRandom::next(std::int32_t lowest, std::int32_t end) {
  const std::int64_t range = std::int64_t{end} - lowest;
  AB_CHECK(range >= 0 && range <= kModulus, lowest, end);
  return lowest + static_cast<std::int32_t>(next_double() * static_cast<double>(range));
}

double DotnetRandom::next_double() { return next() * (1.0 / kModulus); }

}  // namespace avoidbench
