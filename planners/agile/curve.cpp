#include "curve.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace agile {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;
using Free = Eigen::Matrix<double, 3, kPoints>;

/// From the ten points, less what the start's motion gives, to the coefficients of s³, s⁴, s⁵ with
/// s = t/T that are nearest to them.
Free least_squares() {
  Eigen::Matrix<double, kPoints, 3> powers;
  for (int i = 0; i < kPoints; ++i) {
    const double s = (i + 1.0) / kPoints;
    powers.row(i) << s * s * s, s * s * s * s, s * s * s * s * s;
  }
  const Eigen::Matrix3d normal = powers.transpose() * powers;
  return normal.inverse() * powers.transpose();
}

}  // namespace

Quintic projected(const Situation& situation, const ModePoints& points) {
  static const Free kFree = least_squares();
  constexpr double T = kHorizon_s;
  const Motion& start = situation.start;
  Eigen::Matrix<double, 3, kPoints> left;
  for (int i = 0; i < kPoints; ++i) {
    const std::array<float, 3>& point = points[static_cast<std::size_t>(i)];
    const double t = T * (i + 1.0) / kPoints;
    left.col(i) = turned_to_world(situation.frame,
                                  Vector3d(double(point[0]), double(point[1]), double(point[2]))) *
                      reach_m(situation) -
                  start.velocity * t - start.acceleration * (0.5 * t * t);
  }
  const Eigen::Matrix3d free = left * kFree.transpose();
  Quintic curve;
  curve.duration_s = T;
  curve.coefficients.col(0) = start.position;
  curve.coefficients.col(1) = start.velocity;
  curve.coefficients.col(2) = 0.5 * start.acceleration;
  double scale = T * T * T;
  for (int k = 0; k < 3; ++k, scale *= T) curve.coefficients.col(3 + k) = free.col(k) / scale;
  return curve;
}

ModePoints points_of(const Situation& situation, const Quintic& curve) {
  ModePoints points{};
  for (int i = 0; i < kPoints; ++i) {
    const Vector3d place = motion_at(curve, kHorizon_s * (i + 1.0) / kPoints).position;
    const Vector3d in_frame =
        turned_to_frame(situation.frame, place - situation.start.position) / reach_m(situation);
    for (int axis = 0; axis < 3; ++axis) {
      points[std::size_t(i)][std::size_t(axis)] = static_cast<float>(in_frame[axis]);
    }
  }
  return points;
}

Demand demand_of(const Quintic& curve) {
  constexpr int kSteps = 40;
  Demand most;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = curve.duration_s * i / kSteps;
    const Motion motion = motion_at(curve, t);
    most.jerk_mps3 = std::max(most.jerk_mps3, jerk_at(curve, t).norm());
    most.speed_mps = std::max(most.speed_mps, motion.velocity.norm());
    most.acceleration_mps2 = std::max(most.acceleration_mps2, motion.acceleration.norm());
  }
  return most;
}

}  // namespace agile
