#pragma once

#include <cstddef>

// The network's loops exist twice: for every x86-64 machine (SSE2) and for those with AVX2; both
// give the same bits. This header is compiled into both, so it holds nothing that the compiler
// could emit: a function compiled for AVX2 must not reach other machines.
namespace agile::kernels {

inline constexpr int kPanel = 16;  ///< channels that are computed together

/// A convolution, or a linear layer: a convolution of one pixel to one. Channel o of a pixel is
///   bias[o] + Σ over the kernel's rows r and i of input[r · kernel_row + i] · weight[r, i, o]
/// in this order, each product and each sum rounded. i counts the kernel's columns and channels
/// together, as they follow each other in a row of the input. All steps are in floats.
struct Layer {
  const float* input;               ///< of the first pixel
  std::ptrdiff_t kernel_row;        ///< from one row of the kernel to the next, in the input
  int kernel_rows, run;             ///< run: inputs of a row of the kernel
  std::ptrdiff_t row_in, pixel_in;  ///< between pixels' inputs

  const float* weights;  ///< [panel][kernel row][i][kPanel]
  const float* bias;     ///< [panel][kPanel]
  int panels;

  float* output;
  std::ptrdiff_t row_out, pixel_out;
  int rows, columns;  ///< pixels of the output
  bool is_rectified;  ///< ReLU: what is not above 0 is +0, NaN too
};

void apply_portable(const Layer& layer);
/// Only where has_avx2().
void apply_avx2(const Layer& layer);

/// Whether processor and system have AVX2.
bool has_avx2();

}  // namespace agile::kernels
