#pragma once

#include "render/scene.hpp"
#include "view/map_views.hpp"

namespace avoidbench {

/// The map from above without its roof, coloured by height above ground, with the regions of start
/// (green) and goal (red), a mission's start, goal and reference path, and a scale bar. The
/// caption's end, such as "d_min 31.2 m", goes to `note`.
Picture plan_view(const World& world, const TrialSpec& trial, const MapView& view,
                  std::string& note);

/// Colour of what lies below (x, y, `from_z_m`): of its height above ground against `highest_m`,
/// lit from the upper left. The roof, where there is one, hides what is below.
Color color_below(const Scene& scene, double x_m, double y_m, double from_z_m, double highest_m);

}  // namespace avoidbench
