#include "planning/trajectory_command.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

namespace planning {
namespace {

constexpr double kFineStep_s = 0.01;     ///< of the heading's law
constexpr double kStopJerk_mps3 = 40.0;  ///< of a stop: some 4 rad/s of roll or pitch

double wanted_yaw(const TimedMotion& motion, double time_s, const LookAhead& look,
                  double otherwise_rad) {
  const double ahead_s = std::min(time_s + look.look_ahead_s, motion.duration_s);
  const Eigen::Vector3d way = motion.at(ahead_s).position - motion.at(time_s).position;
  if (way.head<2>().norm() < look.least_way_m) return otherwise_rad;
  return avoidbench::portable::atan2(way.y(), way.x());
}

ab_point point_of(const Motion& motion, double time_s, const Heading& heading) {
  ab_point point{};
  point.time_s = time_s;
  avoidbench::as_vector(point.position_world_m) = motion.position;
  avoidbench::as_vector(point.velocity_world_mps) = motion.velocity;
  avoidbench::as_vector(point.acceleration_world_mps2) = motion.acceleration;
  point.yaw_rad = heading.yaw_rad;
  point.yaw_rate_radps = heading.rate_radps;
  return point;
}

}  // namespace

Quintic stopping(const Motion& from, double braking_mps2) {
  constexpr double kPeak = 1.5;  // of a quintic's deceleration over its mean
  const double speed = from.velocity.norm(), pull = from.acceleration.norm();
  const double duration_s =
      std::max({0.1, kPeak * speed / braking_mps2, 2.0 * pull / braking_mps2,
                std::sqrt(6.0 * speed / kStopJerk_mps3), 4.0 * pull / kStopJerk_mps3});
  Motion rest;
  rest.position = from.position + from.velocity * (0.5 * duration_s) +
                  from.acceleration * (duration_s * duration_s / 12.0);
  return quintic_between(from, rest, duration_s);
}

TimedMotion with_stop(const TimedMotion& motion, double braking_mps2) {
  const Quintic stop = stopping(motion.at(motion.duration_s), braking_mps2);
  const double end_s = motion.duration_s;
  return {[at = motion.at, stop, end_s](double time_s) {
            return time_s < end_s ? at(time_s) : motion_at(stop, time_s - end_s);
          },
          end_s + stop.duration_s};
}

std::vector<ab_point> trajectory_points(const TimedMotion& motion, double from_s, double step_s,
                                        const Heading& heading, const LookAhead& look,
                                        std::optional<double> facing) {
  const double left_s = std::max(motion.duration_s - from_s, step_s);
  const int steps = std::max(1, static_cast<int>(std::ceil(left_s / step_s - 1e-9)));
  const int fine = std::max(1, static_cast<int>(std::lround(step_s / kFineStep_s)));
  std::vector<ab_point> points;
  Heading now = heading;
  for (int i = 0; i <= steps; ++i) {
    const double time_s = i * step_s;
    const double at_s = std::min(from_s + time_s, motion.duration_s);
    points.push_back(point_of(motion.at(at_s), time_s, now));
    const double wanted = facing ? *facing : wanted_yaw(motion, at_s, look, now.yaw_rad);
    for (int k = 0; k < fine; ++k) now = turned(now, wanted, look.limits, step_s / fine);
  }
  points.back().yaw_rate_radps = 0.0;
  return points;
}

double thrust_turn_rate_radps(const TimedMotion& motion, double gravity_mps2, int count) {
  const Eigen::Vector3d up(0.0, 0.0, gravity_mps2);
  const double step_s = motion.duration_s / count;
  Eigen::Vector3d before = (motion.at(0.0).acceleration + up).normalized();
  double greatest = 0.0;
  for (int i = 1; i <= count; ++i) {
    const Eigen::Vector3d now = (motion.at(i * step_s).acceleration + up).normalized();
    greatest = std::max(greatest, (now - before).norm() / step_s);
    before = now;
  }
  return greatest;
}

Heading heading_at(const std::vector<ab_point>& points, double time_s) {
  const auto next = std::find_if(points.begin(), points.end(),
                                 [&](const ab_point& p) { return p.time_s > time_s; });
  if (next == points.begin()) return {next->yaw_rad, next->yaw_rate_radps};
  const ab_point& from = *(next - 1);
  if (next == points.end()) return {from.yaw_rad, 0.0};
  const double part = (time_s - from.time_s) / (next->time_s - from.time_s);
  return {from.yaw_rad + part * (next->yaw_rad - from.yaw_rad),
          from.yaw_rate_radps + part * (next->yaw_rate_radps - from.yaw_rate_radps)};
}

}  // namespace planning
