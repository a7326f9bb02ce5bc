#include "lane_network.hpp"

#ifndef __AVX2__
#error "CMakeLists.txt compiles this file for AVX2"
#endif

namespace agile::kernels {

void apply_avx2(const Layer& layer) { apply(layer); }

}  // namespace agile::kernels
