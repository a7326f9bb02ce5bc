#include "avoidbench/repeatable/state.hpp"

namespace {

/// A counter, mixed as by SplitMix64.
std::uint32_t device_number() {
  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15U;
  std::uint64_t z = avoidbench::repeatable::state().device.fetch_add(kGoldenRatio) + kGoldenRatio;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<std::uint32_t>((z ^ (z >> 31U)) >> 32U);
}

}  // namespace

// In the place of the C and the C++ library's, as in clocks.cpp.
#define AB_IN_PLACE_OF(symbol) __asm__(symbol) __attribute__((visibility("hidden")))

extern "C" {

int repeatable_rand() AB_IN_PLACE_OF("rand");
void repeatable_srand(unsigned) AB_IN_PLACE_OF("srand");
long repeatable_random() AB_IN_PLACE_OF("random");
void repeatable_srandom(unsigned) AB_IN_PLACE_OF("srandom");
// What std::random_device of libstdc++ gets its numbers by.
std::uint32_t repeatable_random_device(void*) AB_IN_PLACE_OF("_ZNSt13random_device9_M_getvalEv");

int repeatable_rand() { return avoidbench::repeatable::state().random.next(); }
void repeatable_srand(unsigned seed) {
  avoidbench::repeatable::state().random = avoidbench::repeatable::Random(seed);
}
long repeatable_random() { return avoidbench::repeatable::state().random.next(); }
void repeatable_srandom(unsigned seed) { repeatable_srand(seed); }
std::uint32_t repeatable_random_device(void*) { return device_number(); }
}
