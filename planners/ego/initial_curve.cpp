#include "initial_curve.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;

constexpr std::size_t kLeastPoints = 7;
constexpr double kFinerBy = 1.5;
constexpr double kLongest = 3.0;  ///< way worth inheriting, in horizons

/// The way of several quintics, one after the other.
Vector3d position_at(const std::vector<Quintic>& pieces, double time_s) {
  for (const Quintic& piece : pieces) {
    if (time_s <= piece.duration_s || &piece == &pieces.back()) {
      return planning::motion_at(piece, time_s).position;
    }
    time_s -= piece.duration_s;
  }
  return Vector3d::Zero();
}

/// Samples it so that it takes its time, no two points farther apart than 1.5 spacings.
InitialCurve sampled(const Settings& settings, const std::vector<Quintic>& pieces) {
  double duration_s = 0.0;
  for (const Quintic& piece : pieces) duration_s += piece.duration_s;
  InitialCurve curve;
  for (double wanted_s = knot_interval_s(settings);; wanted_s /= kFinerBy) {
    const auto steps = static_cast<std::size_t>(
        std::max(std::ceil(duration_s / wanted_s), static_cast<double>(kLeastPoints - 1)));
    curve.interval_s = duration_s / static_cast<double>(steps);
    curve.way_points.clear();
    double farthest_m = 0.0;
    for (std::size_t i = 0; i <= steps; ++i) {
      const Vector3d place = position_at(pieces, static_cast<double>(i) * curve.interval_s);
      if (i > 0) farthest_m = std::max(farthest_m, (place - curve.way_points.back()).norm());
      curve.way_points.push_back(place);
    }
    constexpr std::size_t kMostSteps = 100;
    if (farthest_m <= 1.5 * settings.spacing_m || steps > kMostSteps) return curve;
  }
}

/// The rest of a trajectory and a polynomial from its end to the target, finely sampled.
std::vector<Vector3d> extended_way(const Settings& settings, const planning::Bspline& previous,
                                   double from_s, const Motion& target) {
  constexpr double kFine_s = 0.02, kThere_m = 0.05;
  const double end_s = previous.duration_s();
  std::vector<Vector3d> places;
  const int left = static_cast<int>(std::ceil(std::max(0.0, end_s - from_s) / kFine_s));
  for (int i = 0; i < left; ++i) places.push_back(position_at(previous, from_s + i * kFine_s));
  const Motion end{position_at(previous, end_s), velocity_at(previous, end_s),
                   acceleration_at(previous, end_s)};
  places.push_back(end.position);
  const double left_m = (target.position - end.position).norm();
  if (left_m < kThere_m) return places;
  const Quintic rest = quintic_between(end, target, 2.0 * left_m / settings.max_speed_mps);
  const int steps = static_cast<int>(std::ceil(rest.duration_s / kFine_s));
  for (int i = 1; i <= steps; ++i) {
    places.push_back(motion_at(rest, rest.duration_s * i / steps).position);
  }
  return places;
}

/// Way points along a way of this length, evenly spaced in time: from one speed to cruise, and to
/// another at the end, with most of the acceleration allowed.
InitialCurve timed(const Settings& settings, const std::vector<Vector3d>& places, double length_m,
                   double start_mps, double end_mps) {
  constexpr double kCruise = 0.9, kAcceleration = 0.7, kSlowest = 0.1;  // of the limits
  const double pull = kAcceleration * settings.max_acceleration_mps2;
  const auto speed_at = [&](double gone_m) {
    const double by_start = start_mps * start_mps + 2.0 * pull * gone_m;
    const double by_end = end_mps * end_mps + 2.0 * pull * std::max(0.0, length_m - gone_m);
    return std::clamp(std::sqrt(std::min(by_start, by_end)), kSlowest * settings.max_speed_mps,
                      kCruise * settings.max_speed_mps);
  };
  std::vector<double> times_s{0.0};
  double gone_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double piece_m = (places[i] - places[i - 1]).norm();
    times_s.push_back(times_s.back() + piece_m / speed_at(gone_m + 0.5 * piece_m));
    gone_m += piece_m;
  }
  const double all_s = std::max(times_s.back(), 0.1);
  const auto steps = static_cast<std::size_t>(std::max(std::ceil(all_s / knot_interval_s(settings)),
                                                       static_cast<double>(kLeastPoints - 1)));
  InitialCurve curve;
  curve.interval_s = all_s / static_cast<double>(steps);
  std::size_t at = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double wanted_s = static_cast<double>(k) * curve.interval_s;
    while (at + 2 < places.size() && times_s[at + 1] < wanted_s) ++at;
    const double piece_s = times_s[std::min(at + 1, places.size() - 1)] - times_s[at];
    const double part =
        piece_s > 1e-9 ? std::clamp((wanted_s - times_s[at]) / piece_s, 0.0, 1.0) : 0.0;
    curve.way_points.push_back(places[at] +
                               part * (places[std::min(at + 1, places.size() - 1)] - places[at]));
  }
  curve.way_points.push_back(places.back());
  return curve;
}

double duration_s(const Settings& settings, const Motion& start, const Motion& target) {
  const double distance_m = (target.position - start.position).norm();
  return std::max(0.2, planning::trapezoid_time_s(distance_m, settings.max_speed_mps,
                                                  settings.max_acceleration_mps2));
}

}  // namespace

double knot_interval_s(const Settings& settings) {
  return 1.2 * settings.spacing_m / settings.max_speed_mps;
}

InitialCurve polynomial_curve(const Settings& settings, const Motion& start, const Motion& target) {
  return sampled(settings, {quintic_between(start, target, duration_s(settings, start, target))});
}

InitialCurve random_curve(const Settings& settings, const Motion& start, const Motion& target,
                          int failures, planning::Random& random) {
  const Vector3d way = target.position - start.position;
  const double distance_m = way.norm();
  const double reach = distance_m * (0.989 - 0.978 / (failures + 0.989));
  const Vector3d across = Vector3d(-way.y(), way.x(), 0.0).normalized();
  const Vector3d upward = way.cross(across).normalized();
  const double aside = random.uniform(-0.5, 0.5), up = random.uniform(-0.5, 0.5);
  Motion middle;
  middle.position = 0.5 * (start.position + target.position) + 0.8 * reach * aside * across +
                    0.4 * reach * up * upward;
  const double half_s = 0.5 * duration_s(settings, start, target);
  middle.velocity = (target.position - start.position) / (2.0 * half_s);
  return sampled(settings,
                 {quintic_between(start, middle, half_s), quintic_between(middle, target, half_s)});
}

InitialCurve inherited_curve(const Settings& settings, const planning::Bspline& previous,
                             double from_s, const Motion& target) {
  const std::vector<Vector3d> places = extended_way(settings, previous, from_s, target);
  double length_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) length_m += (places[i] - places[i - 1]).norm();
  if (length_m > kLongest * settings.horizon_m) return {};
  return timed(settings, places, length_m, velocity_at(previous, from_s).norm(),
               target.velocity.norm());
}

}  // namespace ego
