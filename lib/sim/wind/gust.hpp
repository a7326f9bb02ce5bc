#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "wind/wind_spec.hpp"

namespace avoidbench {

/// The part of its amplitude that a gust has so long after its beginning: ½ (1 - cos(π t / rise)),
/// then 1 for hold_s, then the same way back; 0 before and after. The discrete gust of
/// MIL-F-8785C (3.7.1.3) is the way up alone; with hold_s = 0 it is the full 1-cosine of FAR 25.341
/// and IEC 61400-1 of length 2 rise. Its integral over time is rise + hold.
double gust_profile(const GustSpec& gust, double since_start_s);

/// The velocity that gusts add at this time, which `seed` and the spec alone determine. Gust k
/// begins at start + k period + jitter, its jitter and heading drawn by its number.
Eigen::Vector3d gust_velocity_world(const GustSpec& gust, std::uint64_t seed, double time_s);

}  // namespace avoidbench
