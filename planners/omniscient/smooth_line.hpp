#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace omniscient {

using Line = std::vector<Eigen::Vector3d>;  ///< places in the world, m

/// Distances from places to the nearest surface, m.
using Clearances = std::function<std::vector<double>(const Line& places_world)>;

/// A polyline's points again, `step_m` apart along it, and its end.
Line resampled(const Line& line, double step_m);

/// A smooth line near this one of evenly spaced points: a beam on springs, soft at first, stiffer
/// round by round where it would come nearer to a surface than `radius_m`. Empty where none keeps
/// away from them. Its ends stay, and so do the points `held`.
Line smoothed(const Line& line, double radius_m, const Clearances& clearances,
              const std::vector<std::size_t>& held = {});

}  // namespace omniscient
