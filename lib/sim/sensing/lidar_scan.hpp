#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sensing/lidar_spec.hpp"

namespace avoidbench {

/// Where shot `shot` of sweep `sweep` points in the lidar's frame (FLU): a unit vector.
Eigen::Vector3d shot_direction(const LidarSpec& lidar, std::int64_t sweep, std::int64_t shot);

/// Whether all sweeps fire in the same directions.
bool repeats(const LidarScan& scan);

/// The share of light at 905 nm that comes back from a material: round numbers, between which
/// surfaces of one kind differ more than the kinds.
double reflectance(Material material);

}  // namespace avoidbench
