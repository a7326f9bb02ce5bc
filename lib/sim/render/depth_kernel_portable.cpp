#include "render/lane_depth.hpp"

namespace avoidbench {

const DepthKernel kPortableDepth{read_depths};

}  // namespace avoidbench
