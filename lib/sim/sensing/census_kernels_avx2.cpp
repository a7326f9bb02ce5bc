#include "sensing/lane_census.hpp"

#ifndef __AVX2__
#error "CMakeLists.txt compiles this file for AVX2"
#endif

namespace avoidbench::census {

const Kernels kAvx2Kernels{transform, sweep_down, sweep_up, median_row};

}  // namespace avoidbench::census
