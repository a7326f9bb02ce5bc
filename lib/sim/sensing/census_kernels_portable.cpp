#include "sensing/lane_census.hpp"

namespace avoidbench::census {

const Kernels kPortableKernels{transform, sweep_down, sweep_up, median_row};

}  // namespace avoidbench::census
