#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/bspline.hpp"

namespace ego {

/// A point on an obstacle's surface and the unit direction away from it: what pushes one control
/// point ({p, v} of Zhou et al. 2021).
struct Anchor {
  Eigen::Vector3d point, direction;
};

/// The anchors of each control point.
using Anchors = std::vector<std::vector<Anchor>>;

/// The costs of a uniform cubic B-spline's control points (3 x n). Each returns its value times
/// `weight` and adds its gradient, likewise weighted, to `gradient` (3 x n). Equations as in
/// README.md.

/// Σ |third difference|²: jerk, except for the interval.
double add_smoothness(const Eigen::Matrix3Xd& points, double weight, Eigen::Matrix3Xd& gradient);

/// Over all anchors, with c = safety distance - (Q - p)·v: nothing below 0, then c³, then a
/// parabola that continues it. Of the points 3 to n - 4.
double add_collision(const Eigen::Matrix3Xd& points, const Anchors& anchors,
                     double safety_distance_m, double weight, Eigen::Matrix3Xd& gradient);

/// Σ of squared excess of velocity (over the interval squared) and of acceleration, by their norms
/// or along each axis. The limit of jerk does not count.
double add_feasibility(const Eigen::Matrix3Xd& points, double interval_s,
                       const planning::MotionLimits& limits, double weight,
                       Eigen::Matrix3Xd& gradient);

/// Squared distance of each knot from its reference (3 x (n - 2)), along the reference counted
/// 1/25, across it whole: "anisotropic" fitting.
double add_fitness(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& references,
                   double weight, Eigen::Matrix3Xd& gradient);

}  // namespace ego
