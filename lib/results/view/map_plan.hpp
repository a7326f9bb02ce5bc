#pragma once

#include "render/scene.hpp"
#include "view/map_views.hpp"

namespace avoidbench {

inline constexpr Color kStartColor{30, 150, 60}, kGoalColor{205, 40, 40};

/// The map from above without its roof, cut at flight height (plan_color()), with the regions of
/// start (green) and goal (red), a mission's start, goal and reference path, and a scale bar. The
/// caption's end, such as "d_min 31.2 m", goes to `note`.
Picture plan_view(const World& world, const TrialSpec& trial, const MapView& view,
                  std::string& note);

/// Colour of a plan at (x, y): what stands at the height `cut_z_m` and what lies below it, by
/// height above ground; what is only above, such as a tree's crown, is shown as a pale veil over
/// that.
Color plan_color(const Scene& scene, double x_m, double y_m, double cut_z_m);

/// Colour of what lies below (x, y, `from_z_m`): of its height above ground against `highest_m`,
/// lit from the upper left. The roof, where there is one, hides what is below.
Color color_below(const Scene& scene, double x_m, double y_m, double from_z_m, double highest_m);

/// The number of one of several goals beside its circle.
void draw_goal_number(Picture& picture, std::size_t number, const Eigen::Vector2d& center_px,
                      double radius_px);

/// The size of a plan that the map fills, its longer side `longest_px`.
void fit_plan(const World& world, int longest_px, MapView& view);

}  // namespace avoidbench
