// Compiled for AVX2 and called only where the processor has it (CMakeLists.txt). It includes
// nothing with functions but intrinsics: the linker could take one compiled here for all of the
// program.
#include <immintrin.h>

#include <cstddef>

#include "network_kernels.hpp"

namespace agile::kernels {
namespace {

using Vector = __m256;
constexpr int kLanes = 8;

inline Vector load(const float* from) { return _mm256_loadu_ps(from); }
inline void store(float* to, Vector v) { _mm256_storeu_ps(to, v); }
inline Vector broadcast(const float* from) { return _mm256_broadcast_ss(from); }
inline Vector add(Vector a, Vector b) { return _mm256_add_ps(a, b); }
inline Vector multiply(Vector a, Vector b) { return _mm256_mul_ps(a, b); }
/// The second operand is what the instruction gives for NaN and for −0.
inline Vector above_zero(Vector v) { return _mm256_max_ps(v, _mm256_setzero_ps()); }

}  // namespace
}  // namespace agile::kernels

#include "network_kernels_body.hpp"

namespace agile::kernels {

void apply_avx2(const Layer& layer) { apply(layer); }

}  // namespace agile::kernels
