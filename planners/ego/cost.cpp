#include "cost.hpp"

namespace ego {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// What of a vector's parts lies beyond ±most.
Vector3d beyond(const Vector3d& value, double most) {
  return value - value.cwiseMax(-most).cwiseMin(most);
}

/// As add_feasibility(), along each axis.
double add_excess_of_axes(const Matrix3Xd& points, double interval_s,
                          const planning::MotionLimits& limits, double weight,
                          Matrix3Xd& gradient) {
  const double inverse = 1.0 / interval_s, inverse2 = inverse * inverse;
  double cost = 0.0;
  for (Index i = 0; i + 1 < points.cols(); ++i) {
    const Vector3d excess = beyond((points.col(i + 1) - points.col(i)) * inverse, limits.speed_mps);
    cost += excess.squaredNorm() * inverse2;
    const Vector3d slope = (2.0 * weight * inverse2 * inverse) * excess;
    gradient.col(i) -= slope;
    gradient.col(i + 1) += slope;
  }
  for (Index i = 0; i + 2 < points.cols(); ++i) {
    const Vector3d excess =
        beyond((points.col(i + 2) - 2.0 * points.col(i + 1) + points.col(i)) * inverse2,
               limits.acceleration_mps2);
    cost += excess.squaredNorm();
    const Vector3d slope = (2.0 * weight * inverse2) * excess;
    gradient.col(i) += slope;
    gradient.col(i + 1) -= 2.0 * slope;
    gradient.col(i + 2) += slope;
  }
  return weight * cost;
}

}  // namespace

double add_smoothness(const Matrix3Xd& points, double weight, Matrix3Xd& gradient) {
  double cost = 0.0;
  for (Index i = 0; i + 3 < points.cols(); ++i) {
    const Vector3d jerk =
        points.col(i + 3) - 3.0 * points.col(i + 2) + 3.0 * points.col(i + 1) - points.col(i);
    cost += jerk.squaredNorm();
    const Vector3d slope = 2.0 * weight * jerk;
    gradient.col(i) -= slope;
    gradient.col(i + 1) += 3.0 * slope;
    gradient.col(i + 2) -= 3.0 * slope;
    gradient.col(i + 3) += slope;
  }
  return weight * cost;
}

double add_collision(const Matrix3Xd& points, const Anchors& anchors, double safety_distance_m,
                     double weight, Matrix3Xd& gradient) {
  const double s = safety_distance_m;
  double cost = 0.0;
  for (Index i = 3; i + 3 < points.cols(); ++i) {
    for (const Anchor& anchor : anchors[static_cast<std::size_t>(i)]) {
      const double c = s - (points.col(i) - anchor.point).dot(anchor.direction);
      if (c <= 0.0) continue;
      double slope = 0.0;  // dcost/dc
      if (c < s) {
        cost += c * c * c;
        slope = 3.0 * c * c;
      } else {
        cost += 3.0 * s * c * c - 3.0 * s * s * c + s * s * s;
        slope = 6.0 * s * c - 3.0 * s * s;
      }
      gradient.col(i) -= weight * slope * anchor.direction;
    }
  }
  return weight * cost;
}

double add_feasibility(const Matrix3Xd& points, double interval_s,
                       const planning::MotionLimits& limits, double weight, Matrix3Xd& gradient) {
  if (limits.of == planning::LimitOf::axes) {
    return add_excess_of_axes(points, interval_s, limits, weight, gradient);
  }
  const double inverse = 1.0 / interval_s, inverse2 = inverse * inverse;
  double cost = 0.0;
  for (Index i = 0; i + 1 < points.cols(); ++i) {
    const Vector3d velocity = (points.col(i + 1) - points.col(i)) * inverse;
    const double speed = velocity.norm(), excess = speed - limits.speed_mps;
    if (excess <= 0.0) continue;
    cost += excess * excess * inverse2;
    const Vector3d slope = (2.0 * weight * excess * inverse2 * inverse / speed) * velocity;
    gradient.col(i) -= slope;
    gradient.col(i + 1) += slope;
  }
  for (Index i = 0; i + 2 < points.cols(); ++i) {
    const Vector3d acceleration =
        (points.col(i + 2) - 2.0 * points.col(i + 1) + points.col(i)) * inverse2;
    const double size = acceleration.norm(), excess = size - limits.acceleration_mps2;
    if (excess <= 0.0) continue;
    cost += excess * excess;
    const Vector3d slope = (2.0 * weight * excess * inverse2 / size) * acceleration;
    gradient.col(i) += slope;
    gradient.col(i + 1) -= 2.0 * slope;
    gradient.col(i + 2) += slope;
  }
  return weight * cost;
}

double add_fitness(const Matrix3Xd& points, const Matrix3Xd& references, double weight,
                   Matrix3Xd& gradient) {
  constexpr double kAlong = 1.0 / 25.0;
  double cost = 0.0;
  for (Index i = 2; i + 2 < points.cols(); ++i) {
    const Vector3d off =
        (points.col(i - 1) + 4.0 * points.col(i) + points.col(i + 1)) / 6.0 - references.col(i - 1);
    const Vector3d way = references.col(i) - references.col(i - 2);
    const double length = way.norm();
    const Vector3d direction = length > 1e-9 ? Vector3d(way / length) : Vector3d::Zero();
    const double along = off.dot(direction);
    const Vector3d across = off - along * direction;
    cost += kAlong * along * along + across.squaredNorm();
    const Vector3d slope = (2.0 * weight / 6.0) * (kAlong * along * direction + across);
    gradient.col(i - 1) += slope;
    gradient.col(i) += 4.0 * slope;
    gradient.col(i + 1) += slope;
  }
  return weight * cost;
}

}  // namespace ego
