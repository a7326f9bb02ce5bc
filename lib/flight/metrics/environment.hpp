#pragma once

#include "metrics/clearance_grid.hpp"

namespace avoidbench {

/// The vehicle as map metrics see it.
struct BodyMeasure {
  double radius_m = 0.25;  ///< of the largest ball in the horizontal outline: half the shorter side
  double diameter_m = 0.7071;  ///< d_drone = √(width² + length²)
};

BodyMeasure body_measure(const Eigen::Vector3d& body_size_m);

/// Traversability and its norm (AvoidBench, arXiv 2301.07430, eq. (1) and (8)).
struct Traversability {
  double value = 0.0;             ///< mean free flight over d_drone
  double normalized_ratio = 0.0;  ///< over the same with no obstacle
};

/// Mean free-flight distance of the body's ball over a grid of positions 1 m apart at flight height
/// and 16 evenly spread headings, divided by d_drone. Positions inside obstacles count 0; flights
/// end at the flight bounds. Exact geometry, by sphere tracing.
Traversability traversability(const Scene& scene, ClearanceGrid& grid, const BodyMeasure& body);

/// Traversability as the original's code computes it, from points instead of surfaces: the centres
/// of the cells of `resolution_m` that a surface touches. Positions 1 m apart in the whole flight
/// space, 8 headings, steps of one resolution until a point is within one resolution of the place:
/// not the body's radius. Throws InputError where there would be too many cells.
Traversability traversability_pointcloud(const World& world, double resolution_m,
                                         const BodyMeasure& body);

/// Share of the flight bounds' volume where the body's ball is free, on a grid of 1 m × 1 m × 0.5
/// m.
double free_volume_ratio(const Scene& scene, ClearanceGrid& grid, const BodyMeasure& body);

/// Obstacles that stand inside the flight bounds, except ground, walls and ceiling, per square
/// metre of them.
double obstacle_density_1pm2(const World& world);
std::int64_t obstacle_count(const World& world);

/// (r_poisson − ŵ_obstacle)/d_drone (AvoidBench eq. (2), as its text has it); NaN where the map is
/// not a Poisson-disc field.
double relative_gap_size(const World& world, const BodyMeasure& body);

}  // namespace avoidbench
