#include "control/trajectory.hpp"

#include "base/check.hpp"
#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Reference at_point(const TrajectoryPoint& point) {
  return {point.position_world, point.velocity_world, point.acceleration_world,
          Vector3d::Zero(),     point.yaw_rad,        point.yaw_rate_radps};
}

}  // namespace

Reference sample_trajectory(std::span<const TrajectoryPoint> points, double time_s,
                            std::size_t& piece) {
  AB_CHECK(points.size() >= 2, points.size());
  if (time_s <= points.front().time_s) return at_point(points.front());
  if (time_s >= points.back().time_s) return at_point(points.back());
  // Another trajectory, or a time that went back: from the beginning.
  if (piece + 1 >= points.size() || points[piece].time_s > time_s) piece = 0;
  while (points[piece + 1].time_s <= time_s) ++piece;

  // Quintic in s = t / T by its start's derivatives and what is left to the end's.
  const TrajectoryPoint& from = points[piece];
  const TrajectoryPoint& to = points[piece + 1];
  const double T = to.time_s - from.time_s;
  const double t = time_s - from.time_s;
  const Vector3d& v = from.velocity_world;
  const Vector3d& a = from.acceleration_world;
  const Vector3d dp =
      (to.position_world - (from.position_world + T * (v + 0.5 * T * a))) / (T * T * T);
  const Vector3d dv = (to.velocity_world - (v + T * a)) / (T * T);
  const Vector3d da = (to.acceleration_world - a) / T;
  // From the three conditions at t = T, whose 3 × 3 system has this inverse.
  const Vector3d c3 = 10.0 * dp - 4.0 * dv + 0.5 * da;
  const Vector3d c4 = (-15.0 * dp + 7.0 * dv - da) / T;
  const Vector3d c5 = (6.0 * dp - 3.0 * dv + 0.5 * da) / (T * T);
  Reference reference;
  // Horner's rule; below, its derivatives.
  reference.position_world =
      from.position_world + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5))));
  reference.velocity_world = v + t * (a + t * (3.0 * c3 + t * (4.0 * c4 + t * (5.0 * c5))));
  reference.acceleration_world = a + t * (6.0 * c3 + t * (12.0 * c4 + t * (20.0 * c5)));
  reference.jerk_world = 6.0 * c3 + t * (24.0 * c4 + t * (60.0 * c5));

  // The shorter way round; a cubic by the same steps.
  const double turn = math::wrapped_angle(to.yaw_rad - from.yaw_rad);
  const double r = from.yaw_rate_radps;
  const double dy = (turn - T * r) / (T * T);
  const double dr = (to.yaw_rate_radps - r) / T;
  const double b2 = 3.0 * dy - dr;
  const double b3 = (dr - 2.0 * dy) / T;
  reference.yaw_rad = from.yaw_rad + t * (r + t * (b2 + t * b3));
  reference.yaw_rate_radps = r + t * (2.0 * b2 + t * (3.0 * b3));
  return reference;
}

}  // namespace avoidbench
