#pragma once

#include "network_kernels.hpp"

// The source of both builds of the network's loops; see network_kernels.hpp. Everything is in an
// unnamed namespace. Vectors run over channels, so that no sum's order depends on their length.

#if defined(__FAST_MATH__) || __FLT_EVAL_METHOD__ != 0
#error "The network's sums must keep their order and precision: no -ffast-math."
#endif

#if defined(__clang__)
#define AGILE_UNROLL  // clang unrolls of itself
#else
#define AGILE_UNROLL _Pragma("GCC unroll 16")
#endif

namespace agile::kernels {
namespace {

#ifdef __AVX2__
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
/// The compilers' vectors: arithmetic works lane by lane.
using Vector [[gnu::vector_size(kLanes * sizeof(float))]] = float;

inline Vector load(const float* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

/// kColumns pixels beside each other, kVectors · kLanes channels of each.
template <int kColumns, int kVectors>
[[gnu::always_inline]] inline void apply_tile(const Layer& layer, const float* input,
                                              const float* weights, const float* bias,
                                              float* output) {
  constexpr auto kCount = static_cast<std::size_t>(kVectors);
  Vector sums[static_cast<std::size_t>(kColumns)][kCount];
  AGILE_UNROLL for (int c = 0; c < kColumns; ++c) {
    AGILE_UNROLL for (int v = 0; v < kVectors; ++v) sums[c][v] = load(bias + v * kLanes);
  }
  const std::ptrdiff_t step = layer.pixel_in;
  for (int row = 0; row < layer.kernel_rows; ++row) {
    for (int i = 0; i < layer.run; ++i) {
      Vector weight[kCount];
      AGILE_UNROLL for (int v = 0; v < kVectors; ++v) weight[v] = load(weights + v * kLanes);
      AGILE_UNROLL for (int c = 0; c < kColumns; ++c) {
        const float x = input[c * step + i];
        AGILE_UNROLL for (int v = 0; v < kVectors; ++v) { sums[c][v] += x * weight[v]; }
      }
      weights += kPanel;
    }
    input += layer.kernel_row;
  }
  AGILE_UNROLL for (int c = 0; c < kColumns; ++c) {
    AGILE_UNROLL for (int v = 0; v < kVectors; ++v) {
      Vector sum = sums[c][v];
      if (layer.is_rectified) sum = sum > 0.0F ? sum : Vector{};  // +0 for NaN and -0, too
      __builtin_memcpy(output + c * layer.pixel_out + v * kLanes, &sum, sizeof sum);
    }
  }
}

/// kVectors · kLanes channels of all pixels.
template <int kVectors>
void apply_channels(const Layer& layer, const float* weights, const float* bias, float* output) {
  constexpr int kTogether = 6;  // with two vectors each they fill the sixteen registers
  for (int y = 0; y < layer.rows; ++y) {
    const float* from = layer.input + y * layer.row_in;
    float* to = output + y * layer.row_out;
    int x = 0;
    for (; x + kTogether <= layer.columns; x += kTogether) {
      apply_tile<kTogether, kVectors>(layer, from + x * layer.pixel_in, weights, bias,
                                      to + x * layer.pixel_out);
    }
    for (; x < layer.columns; ++x) {
      apply_tile<1, kVectors>(layer, from + x * layer.pixel_in, weights, bias,
                              to + x * layer.pixel_out);
    }
  }
}

void apply(const Layer& layer) {
  const std::ptrdiff_t panel_weights =
      static_cast<std::ptrdiff_t>(layer.kernel_rows) * layer.run * kPanel;
  for (int panel = 0; panel < layer.panels; ++panel) {
    const float* weights = layer.weights + panel * panel_weights;
    const float* bias = layer.bias + panel * kPanel;
    float* output = layer.output + panel * kPanel;
    if (layer.columns == 1) {
      apply_channels<kPanel / kLanes>(layer, weights, bias, output);
    } else {
      for (int channel = 0; channel < kPanel; channel += 2 * kLanes) {
        apply_channels<2>(layer, weights + channel, bias + channel, output + channel);
      }
    }
  }
}

}  // namespace
}  // namespace agile::kernels
