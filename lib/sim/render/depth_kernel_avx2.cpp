#include "render/lane_depth.hpp"

#ifndef __AVX2__
#error "CMakeLists.txt compiles this file for AVX2"
#endif

namespace avoidbench {

const DepthKernel kAvx2Depth{read_depths};

}  // namespace avoidbench
