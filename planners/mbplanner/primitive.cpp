#include "primitive.hpp"

#include <algorithm>
#include <cmath>

namespace mbplanner {
namespace {

using Eigen::Vector3d;
using planning::Quintic;

constexpr double kSpeedShare = 0.95;  ///< of the limit that roll-outs go up to
constexpr double kJerkShare = 0.4;    ///< of the jerk counted on to end an acceleration in time

/// `pull` without what would lead beyond the speed.
Vector3d within_speed(const Vector3d& pull, const Vector3d& velocity, const Limits& limits) {
  const double speed = velocity.norm();
  if (speed < 1e-6) return pull;
  const Vector3d along = velocity / speed;
  const double room = kSpeedShare * limits.speed_mps - speed;
  const double most = room > 0.0 ? std::sqrt(2.0 * kJerkShare * limits.jerk_mps3 * room)
                                 : std::max(4.0 * room, -0.8 * limits.acceleration_mps2);
  const double wanted = pull.dot(along);
  if (wanted <= most) return pull;
  const Vector3d across = pull - wanted * along;
  return across + most * along;
}

/// What of a change of acceleration one step's jerk allows: along the velocity first, so that the
/// speed keeps its limit however the vehicle turns.
Vector3d within_jerk(const Vector3d& change, const Vector3d& velocity, const Limits& limits) {
  const double most = limits.jerk_mps3 * kStep_s;
  if (change.squaredNorm() <= most * most) return change;
  const double speed = velocity.norm();
  if (speed < 0.5 * limits.speed_mps) return change * (most / change.norm());
  const Vector3d way = velocity / speed;
  const double along = std::clamp(change.dot(way), -most, most);
  const Vector3d across = change - change.dot(way) * way;
  const double left = std::sqrt(most * most - along * along), size = across.norm();
  return along * way + across * (size > left ? left / size : 1.0);
}

/// Of a quintic, at some moments.
struct Peaks {
  double acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
};

Peaks peaks_of(const Quintic& quintic) {
  Peaks peaks;
  for (int i = 0; i <= 8; ++i) {
    const double t = quintic.duration_s * i / 8;
    const Vector3d jerk = 6.0 * quintic.coefficients.col(3) +
                          24.0 * t * quintic.coefficients.col(4) +
                          60.0 * t * t * quintic.coefficients.col(5);
    const Vector3d acceleration = planning::motion_at(quintic, t).acceleration;
    peaks.jerk_mps3 = std::max(peaks.jerk_mps3, jerk.norm());
    peaks.acceleration_mps2 = std::max(peaks.acceleration_mps2, acceleration.norm());
  }
  return peaks;
}

std::vector<Motion> knots_of(const Quintic& quintic) {
  const int steps = std::max(1, static_cast<int>(std::ceil(quintic.duration_s / kStep_s - 1e-9)));
  std::vector<Motion> knots;
  for (int i = 1; i <= steps; ++i) knots.push_back(planning::motion_at(quintic, i * kStep_s));
  knots.back().velocity.setZero();
  knots.back().acceleration.setZero();
  return knots;
}

/// The shortest quintic to rest along the motion that keeps acceleration and jerk.
std::vector<Motion> settled(const Motion& from, const Limits& limits) {
  const double most_mps2 = std::max(limits.acceleration_mps2, 1.01 * from.acceleration.norm());
  Quintic stop;
  constexpr int kTries = 28;  // up to 5 s
  double least_s = 2.0 * kStep_s;
  for (int i = 0; i < kTries; ++i, least_s *= 1.15) {
    // Whole steps, so that the knots are the quintic itself.
    const double duration_s = kStep_s * std::ceil(least_s / kStep_s - 1e-9);
    Motion rest;
    rest.position = from.position + from.velocity * (0.5 * duration_s) +
                    from.acceleration * (duration_s * duration_s / 12.0);
    stop = planning::quintic_between(from, rest, duration_s);
    const Peaks peaks = peaks_of(stop);
    if (peaks.jerk_mps3 <= limits.jerk_mps3 && peaks.acceleration_mps2 <= most_mps2) break;
  }
  return knots_of(stop);
}

}  // namespace

Motion stepped(const Motion& from, const Vector3d& pull, const Limits& limits) {
  constexpr double h = kStep_s;
  Vector3d change = within_jerk(within_speed(pull, from.velocity, limits) - from.acceleration,
                                from.velocity, limits);
  Motion to;
  to.acceleration = from.acceleration + change;
  // Back into the ball: that makes no change greater.
  const double most = std::max(limits.acceleration_mps2, from.acceleration.norm());
  const double size = to.acceleration.norm();
  if (size > most) to.acceleration *= most / size;
  change = to.acceleration - from.acceleration;
  to.velocity = from.velocity + h * from.acceleration + 0.5 * h * change;
  to.position =
      from.position + h * from.velocity + 0.5 * h * h * from.acceleration + h * h / 6.0 * change;
  return to;
}

std::vector<Motion> rolled_out(const Motion& from, const Vector3d& pull, const Limits& limits,
                               int steps) {
  std::vector<Motion> knots;
  for (int i = 0; i < steps; ++i) {
    knots.push_back(stepped(i == 0 ? from : knots.back(), pull, limits));
  }
  return knots;
}

std::vector<Motion> stop_from(const Motion& from, double braking_mps2, const Limits& limits) {
  constexpr int kMostSteps = 200;
  const double jerk_mps3 = 0.9 * limits.jerk_mps3;
  const Limits braking{limits.speed_mps, std::max(limits.acceleration_mps2, braking_mps2),
                       jerk_mps3};
  std::vector<Motion> knots;
  Motion now = from;
  for (int i = 0; i < kMostSteps; ++i) {
    const double speed = now.velocity.norm();
    if (speed < 1e-6) break;
    // The deceleration ends in time to be none at rest.
    const double slowing = std::max(-now.acceleration.dot(now.velocity) / speed, 0.0);
    const double next_speed = speed - slowing * kStep_s;
    if (next_speed <= 0.5 * slowing * slowing / jerk_mps3 + 0.5 * jerk_mps3 * kStep_s * kStep_s) {
      break;
    }
    now = stepped(now, now.velocity * (-braking_mps2 / speed), braking);
    knots.push_back(now);
  }
  const std::vector<Motion> rest = settled(now, limits);
  knots.insert(knots.end(), rest.begin(), rest.end());
  return knots;
}

std::vector<Motion> stop_at(const Motion& from, const Vector3d& place, const Limits& limits) {
  const double way_m = (place - from.position).norm();
  Motion rest;
  rest.position = place;
  const double least_s =
      std::max(planning::trapezoid_time_s(way_m, limits.speed_mps, limits.acceleration_mps2), 0.3);
  double factor = 0.7;
  for (int i = 0; i < 13; ++i, factor *= 1.15) {
    const double duration_s = kStep_s * std::ceil(factor * least_s / kStep_s);
    const Quintic quintic = planning::quintic_between(from, rest, duration_s);
    if (peaks_of(quintic).jerk_mps3 > limits.jerk_mps3) continue;
    std::vector<Motion> knots = knots_of(quintic);
    const bool is_fair = std::all_of(knots.begin(), knots.end(), [&](const Motion& knot) {
      return knot.velocity.norm() <= limits.speed_mps &&
             knot.acceleration.norm() <= limits.acceleration_mps2;
    });
    if (is_fair) return knots;
  }
  return {};
}

}  // namespace mbplanner
