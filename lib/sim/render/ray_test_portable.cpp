#include "render/lane_ray_test.hpp"

namespace avoidbench {

const RayTestKernel kPortableRayTest{test_packet, plane_distances};

}  // namespace avoidbench
