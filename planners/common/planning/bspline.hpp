#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/polynomial.hpp"

namespace planning {

/// A uniform cubic B-spline: twice continuously differentiable, within the hull of its control
/// points. Valid for times 0 to duration.
struct Bspline {
  Eigen::Matrix3Xd points;  ///< control points, at least 4
  double interval_s = 0.0;  ///< between knots

  double duration_s() const { return static_cast<double>(points.cols() - 3) * interval_s; }
};

Eigen::Vector3d position_at(const Bspline& spline, double time_s);
Eigen::Vector3d velocity_at(const Bspline& spline, double time_s);
Eigen::Vector3d acceleration_at(const Bspline& spline, double time_s);
Eigen::Vector3d jerk_at(const Bspline& spline, double time_s);

/// The spline that has the motions `start` and `end` at its ends exactly and passes the way points
/// (one a knot, the first and last being the ends' positions) as closely as it can, in the
/// least-squares sense. At least 4 way points.
Bspline fitted(const std::vector<Eigen::Vector3d>& way_points, double interval_s,
               const Motion& start, const Motion& end);

/// What limits hold: the length of a vector, or each of its parts along the world's axes.
enum class LimitOf { norm, axes };

struct MotionLimits {
  double speed_mps, acceleration_mps2, jerk_mps3;
  LimitOf of = LimitOf::norm;
};

/// By how much time must be stretched for a motion to keep the limits at all times; 1 or less: it
/// does. By the control points, which bound it.
double stretch_needed(const Bspline& spline, const MotionLimits& limits);

}  // namespace planning
