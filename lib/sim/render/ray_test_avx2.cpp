#include "render/lane_ray_test.hpp"

#ifndef __AVX2__
#error "CMakeLists.txt compiles this file for AVX2"
#endif

namespace avoidbench {

const RayTestKernel kAvx2RayTest{test_packet, plane_distances};

}  // namespace avoidbench
