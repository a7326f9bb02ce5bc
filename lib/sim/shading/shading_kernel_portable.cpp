#include "shading/lane_shading.hpp"

namespace avoidbench {

const ShadingKernel kPortableShading{locate, shade};

}  // namespace avoidbench
