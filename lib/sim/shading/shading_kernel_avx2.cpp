#include "shading/lane_shading.hpp"

#ifndef __AVX2__
#error "CMakeLists.txt compiles this file for AVX2"
#endif

namespace avoidbench {

const ShadingKernel kAvx2Shading{locate, shade};

}  // namespace avoidbench
