#include "local_planner.hpp"

#include <algorithm>
#include <cmath>

#include "optimizer.hpp"
#include "planning/trajectory_command.hpp"

namespace ego {
namespace {

using Eigen::Vector3d;
using planning::Bspline;
using planning::Motion;

constexpr double kTooNear_m = 0.2;  ///< a target that is no flight

/// Whether the curve keeps what the vehicle can do; the start's own motion does not count.
bool is_flyable(const Settings& settings, const Bspline& curve, const Motion& start) {
  constexpr int kSteps = 60;
  const double most_speed =
      std::max((1.0 + 2.0 * settings.feasibility_tolerance) * settings.max_speed_mps,
               1.02 * start.velocity.norm());
  const double most_pull =
      std::max(settings.vehicle_acceleration_mps2, 1.02 * start.acceleration.norm());
  for (int i = 0; i <= kSteps; ++i) {
    const Vector3d velocity = velocity_at(curve, curve.duration_s() * i / kSteps);
    const bool is_by_axes = settings.limits_per_axis != 0;
    if ((is_by_axes ? velocity.cwiseAbs().maxCoeff() : velocity.norm()) > most_speed) return false;
  }
  for (Eigen::Index i = 0; i + 2 < curve.points.cols(); ++i) {  // piecewise linear between these
    const Vector3d pull =
        (curve.points.col(i + 2) - 2.0 * curve.points.col(i + 1) + curve.points.col(i)) /
        (curve.interval_s * curve.interval_s);
    if (pull.norm() > most_pull) return false;
  }
  const planning::TimedMotion motion{[&](double time_s) {
                                       Motion at;
                                       at.acceleration = acceleration_at(curve, time_s);
                                       return at;
                                     },
                                     curve.duration_s()};
  return thrust_turn_rate_radps(motion, settings.gravity_mps2) <= settings.max_turn_rate_radps;
}

/// The curve made slow enough for the limits and smooth again; the slower one itself where the
/// refined one is blocked. Nothing where neither can be flown.
std::optional<Bspline> within_limits(const Surroundings& surroundings, const Settings& settings,
                                     const Request& request, Bspline curve) {
  constexpr int kMostTimes = 4;
  for (int time = 0; time < kMostTimes; ++time) {
    const double stretch = stretch_needed(curve, limits_of(settings));
    if (stretch <= 1.0 + settings.feasibility_tolerance) break;
    const Bspline slower = slowed(curve, std::min(stretch, 2.0), request.start, request.target);
    const Bspline smooth = refined(settings, slower);
    curve = first_blocked_s(surroundings, settings, smooth) ? slower : smooth;
  }
  if (!is_flyable(settings, curve, request.start)) return std::nullopt;
  if (first_blocked_s(surroundings, settings, curve)) return std::nullopt;
  return curve;
}

std::optional<Bspline> plan_from(Surroundings& surroundings, const Settings& settings,
                                 const Request& request, const InitialCurve& initial,
                                 std::vector<Bspline>* candidates) {
  if (initial.way_points.size() < 4) return std::nullopt;
  const Bspline curve =
      fitted(initial.way_points, initial.interval_s, request.start, request.target);
  if (candidates != nullptr) candidates->push_back(curve);
  const auto free = rebounded(surroundings, settings, curve);
  if (!free) return std::nullopt;
  return within_limits(surroundings, settings, request, *free);
}

}  // namespace

Bspline slowed(const Bspline& curve, double ratio, const Motion& start, const Motion& target) {
  // Two intervals at each end keep their pace, so that the ends keep their motions.
  const auto spans = static_cast<int>(curve.points.cols()) - 3;
  const int kept = std::min(2, (spans - 1) / 2);
  std::vector<double> knots_s{0.0};
  for (int i = 0; i < spans; ++i) {
    const bool is_end = i < kept || i >= spans - kept;
    knots_s.push_back(knots_s.back() + (is_end ? 1.0 : ratio) * curve.interval_s);
  }
  const double interval_s = knots_s.back() / spans;
  std::vector<Vector3d> way_points;
  std::size_t knot = 0;
  for (int i = 0; i < spans; ++i) {
    const double time_s = i * interval_s;
    while (knot + 2 < knots_s.size() && knots_s[knot + 1] < time_s) ++knot;
    const double part = (time_s - knots_s[knot]) / (knots_s[knot + 1] - knots_s[knot]);
    way_points.push_back(position_at(curve, (static_cast<double>(knot) + part) * curve.interval_s));
  }
  way_points.push_back(position_at(curve, curve.duration_s()));
  return fitted(way_points, interval_s, start, target);
}

std::optional<Bspline> plan_trajectory(Surroundings& surroundings, const Settings& settings,
                                       const Request& request, planning::Random& random,
                                       std::vector<Bspline>* candidates) {
  if ((request.target.position - request.start.position).norm() < kTooNear_m) return std::nullopt;
  if (request.previous != nullptr) {
    const InitialCurve initial =
        inherited_curve(settings, *request.previous, request.previous_s, request.target);
    if (auto found = plan_from(surroundings, settings, request, initial, candidates)) return found;
  }
  const InitialCurve direct = polynomial_curve(settings, request.start, request.target);
  if (auto found = plan_from(surroundings, settings, request, direct, candidates)) return found;
  for (int i = 1; i <= request.random_tries; ++i) {
    const InitialCurve aside =
        random_curve(settings, request.start, request.target, request.failures + i, random);
    if (auto found = plan_from(surroundings, settings, request, aside, candidates)) return found;
  }
  return std::nullopt;
}

Motion local_target(const Surroundings& surroundings, const Settings& settings,
                    const Vector3d& line_start, const Vector3d& goal, const Vector3d& position) {
  const Vector3d line = goal - line_start;
  const double length_m = line.norm();
  Motion target;
  target.position = goal;
  if (length_m < kTooNear_m || (goal - position).norm() <= settings.horizon_m) {
    // A curve can't end where the map, rightly or not, has something: it ends beside it.
    constexpr double kBeside_m = 1.5;
    if (surroundings.is_blocked(goal)) {
      target.position = nearest_free(surroundings, goal, kBeside_m, Reach::any).value_or(goal);
    }
    return target;
  }
  const Vector3d along = line / length_m;
  const double beside_m = std::clamp((position - line_start).dot(along), 0.0, length_m);
  const Vector3d foot = line_start + beside_m * along;
  const double aside_m = (position - foot).norm();
  const double ahead_m =
      std::sqrt(std::max(settings.horizon_m * settings.horizon_m - aside_m * aside_m, 1.0));
  const double wanted_m = std::min(beside_m + ahead_m, length_m);
  const double step_m = surroundings.grid.spec().resolution_m;
  double at_m = wanted_m;
  // The nearest free place on the line, forward first.
  for (int i = 0; surroundings.is_blocked(line_start + at_m * along); ++i) {
    const int steps = i / 2 + 1;
    const double away_m = steps * step_m;
    if (away_m > 0.6 * settings.horizon_m) {
      at_m = wanted_m;
      break;
    }
    at_m = std::clamp(i % 2 == 0 ? wanted_m + away_m : wanted_m - away_m, beside_m, length_m);
  }
  target.position = line_start + at_m * along;
  const double left_m = length_m - at_m;
  const double speed =
      std::min(settings.max_speed_mps, std::sqrt(2.0 * settings.max_acceleration_mps2 * left_m));
  target.velocity = speed * along;
  return target;
}

}  // namespace ego
