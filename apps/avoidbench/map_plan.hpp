#pragma once

#include "map_views.hpp"

namespace avoidbench {

/// The map from above without its roof, coloured by height above ground, with the regions of start
/// (green) and goal (red), a mission's start, goal and reference path, and a scale bar. The
/// caption's end, such as "d_min 31.2 m", goes to `note`.
Picture plan_view(const World& world, const TrialSpec& trial, const MapView& view,
                  std::string& note);

}  // namespace avoidbench
