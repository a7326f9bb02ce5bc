#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "render/scene.hpp"

namespace avoidbench {

/// How hard a mission is along its reference path: the three measures of FlightBench (Yu et al.,
/// arXiv 2406.05687), from exact geometry. More is harder; NaN where the mission is invalid.
struct MissionDifficulty {
  double traversability_obstruction = std::numeric_limits<double>::quiet_NaN();
  double view_occlusion = std::numeric_limits<double>::quiet_NaN();
  double angle_over_length_1pm = std::numeric_limits<double>::quiet_NaN();
};

/// All three along `path`, a polyline of at least two points, for a ball of `radius_m`. The
/// corridor's samples are drawn from `seed`.
MissionDifficulty mission_difficulty(const Scene& scene, const std::vector<Eigen::Vector3d>& path,
                                     double radius_m, std::uint64_t seed);

/// TO: a corridor of overlapping free spheres is grown along the path (Ren et al. 2022), each the
/// best of 40 sampled ones; with r the smaller half of its N radii, less the body's and at most 4
/// m, TO = 4 m/(2N) Σ 1/r. The least of 8 corridors.
double traversability_obstruction(const Scene& scene, const std::vector<Eigen::Vector3d>& path,
                                  double radius_m, std::uint64_t seed);

/// VO: every 0.4 m of the path, looking along it, the nearest surface seen within 4 m in four rings
/// of the field of view (half angles 15°, 22.5°, 30°, 36°): Σ w · 4 m/distance with w = 0.55, 0.3,
/// 0.1, 0.05 from the middle out; the mean over the path. Distances are those of the triangles
/// themselves, in closed form.
double view_occlusion(const Scene& scene, const std::vector<Eigen::Vector3d>& path);

/// AOL: Σ (exp(2θ/π) − 1)/length over the path's bends θ [1/m].
double angle_over_length_1pm(const std::vector<Eigen::Vector3d>& path);

}  // namespace avoidbench
