#pragma once

namespace avoidbench {

/// The standard normal quantile of `p` in (0, 1): Wichura, algorithm AS 241 (1988), PPND16;
/// relative error below 1e-15.
double normal_quantile(double p);

}  // namespace avoidbench
