#pragma once

#include <string>

#include "config/flights_file.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {

struct Alignment {
  Pose T_map_log = Pose::Identity();
  double residual_m = 0.0;  ///< root mean square over the points; 0 where none are given
};

/// The rotation and translation that take the logs' points nearest to the map's (Umeyama 1991,
/// without scale). Throws InputError at the file's block where the points lie on one line.
Alignment align(const AlignmentSpec& spec, const InputProblem& place);

}  // namespace avoidbench
