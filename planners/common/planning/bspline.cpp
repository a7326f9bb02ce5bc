#include "planning/bspline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "avoidbench/portable_math.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

/// The knot span of a time, and how far into it, 0 to 1.
struct Place {
  Eigen::Index span = 0;
  double part = 0.0;
};

Place place_of(const Bspline& spline, double time_s) {
  const double at = std::clamp(time_s, 0.0, spline.duration_s()) / spline.interval_s;
  const auto span = std::min(static_cast<Eigen::Index>(at), spline.points.cols() - 4);
  return {span, at - static_cast<double>(span)};
}

Vector3d blended(const Bspline& spline, Eigen::Index span, const std::array<double, 4>& weights) {
  return weights[0] * spline.points.col(span) + weights[1] * spline.points.col(span + 1) +
         weights[2] * spline.points.col(span + 2) + weights[3] * spline.points.col(span + 3);
}

/// The three control points whose knot has this motion.
std::array<Vector3d, 3> ends_of(const Motion& motion, double dt) {
  // (a + 4 b + c) / 6 = p, (c - a) / (2 dt) = v, (a - 2 b + c) / dt² = acc
  const Vector3d middle = motion.position - motion.acceleration * (dt * dt / 6.0);
  const Vector3d curve = middle + 0.5 * motion.acceleration * dt * dt;
  return {curve - motion.velocity * dt, middle, curve + motion.velocity * dt};
}

}  // namespace

Vector3d position_at(const Bspline& spline, double time_s) {
  const auto [span, u] = place_of(spline, time_s);
  const double w = 1.0 - u;
  return blended(spline, span,
                 {w * w * w / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                  (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) / 6.0, u * u * u / 6.0});
}

Vector3d velocity_at(const Bspline& spline, double time_s) {
  const auto [span, u] = place_of(spline, time_s);
  const double w = 1.0 - u;
  return blended(spline, span,
                 {-0.5 * w * w, 1.5 * u * u - 2.0 * u, -1.5 * u * u + u + 0.5, 0.5 * u * u}) /
         spline.interval_s;
}

Vector3d acceleration_at(const Bspline& spline, double time_s) {
  const auto [span, u] = place_of(spline, time_s);
  return blended(spline, span, {1.0 - u, 3.0 * u - 2.0, 1.0 - 3.0 * u, u}) /
         (spline.interval_s * spline.interval_s);
}

Vector3d jerk_at(const Bspline& spline, double time_s) {
  const auto [span, u] = place_of(spline, time_s);
  static_cast<void>(u);
  return blended(spline, span, {-1.0, 3.0, -3.0, 1.0}) /
         (spline.interval_s * spline.interval_s * spline.interval_s);
}

Bspline fitted(const std::vector<Vector3d>& way_points, double interval_s, const Motion& start,
               const Motion& end) {
  const auto knots = static_cast<Eigen::Index>(way_points.size());
  const Eigen::Index count = knots + 2;
  Bspline spline{Eigen::Matrix3Xd(3, count), interval_s};
  const std::array<Vector3d, 3> first = ends_of(start, interval_s), last = ends_of(end, interval_s);
  for (Eigen::Index k = 0; k < 3; ++k) {
    spline.points.col(k) = first[static_cast<std::size_t>(k)];
    spline.points.col(count - 3 + k) = last[static_cast<std::size_t>(k)];
  }
  const Eigen::Index free = count - 6;
  if (free <= 0) return spline;
  // (Q_i + 4 Q_i+1 + Q_i+2) / 6 = way point i, for the inner ones.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(knots - 2, free);
  Eigen::MatrixX3d wanted(knots - 2, 3);
  constexpr std::array<double, 3> kWeights{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  for (Eigen::Index i = 1; i + 1 < knots; ++i) {
    Vector3d rest = way_points[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double weight = kWeights[static_cast<std::size_t>(k)];
      const Eigen::Index column = i + k - 3;
      if (column >= 0 && column < free) {
        rows(i - 1, column) = weight;
      } else {
        rest -= weight * spline.points.col(i + k);
      }
    }
    wanted.row(i - 1) = rest.transpose();
  }
  const Eigen::MatrixX3d found = rows.householderQr().solve(wanted);
  spline.points.middleCols(3, free) = found.transpose();
  return spline;
}

double stretch_needed(const Bspline& spline, const MotionLimits& limits) {
  const Eigen::Index count = spline.points.cols();
  const double dt = spline.interval_s;
  const Eigen::Matrix3Xd velocity =
      (spline.points.rightCols(count - 1) - spline.points.leftCols(count - 1)) / dt;
  const Eigen::Matrix3Xd acceleration =
      (velocity.rightCols(count - 2) - velocity.leftCols(count - 2)) / dt;
  const Eigen::Matrix3Xd jerk =
      (acceleration.rightCols(count - 3) - acceleration.leftCols(count - 3)) / dt;
  const auto greatest = [&](const Eigen::Matrix3Xd& values) {
    return limits.of == LimitOf::axes ? values.cwiseAbs().maxCoeff()
                                      : values.colwise().norm().maxCoeff();
  };
  return std::max({greatest(velocity) / limits.speed_mps,
                   std::sqrt(greatest(acceleration) / limits.acceleration_mps2),
                   avoidbench::portable::pow(greatest(jerk) / limits.jerk_mps3, 1.0 / 3.0)});
}

}  // namespace planning
