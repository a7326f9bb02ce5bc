// The network's loops for every x86-64 machine: SSE2, which all of them have.
#include <emmintrin.h>

#include <cstddef>

#include "network_kernels.hpp"

namespace agile::kernels {
namespace {

using Vector = __m128;
constexpr int kLanes = 4;

inline Vector load(const float* from) { return _mm_loadu_ps(from); }
inline void store(float* to, Vector v) { _mm_storeu_ps(to, v); }
inline Vector broadcast(const float* from) { return _mm_load1_ps(from); }
inline Vector add(Vector a, Vector b) { return _mm_add_ps(a, b); }
inline Vector multiply(Vector a, Vector b) { return _mm_mul_ps(a, b); }
/// The second operand is what the instruction gives for NaN and for −0.
inline Vector above_zero(Vector v) { return _mm_max_ps(v, _mm_setzero_ps()); }

}  // namespace
}  // namespace agile::kernels

#include "network_kernels_body.hpp"

namespace agile::kernels {

void apply_portable(const Layer& layer) { apply(layer); }

}  // namespace agile::kernels
