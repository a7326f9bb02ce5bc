#include "world/motion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// 2π(t/period + phase), whole turns taken off first: a large argument would lose digits of its
/// fraction.
double angle_at(double time_s, double period_s, double phase) {
  const double turns = time_s / period_s + phase;
  return math::kTau * (turns - std::floor(turns));
}

MotionState at(const Sway& sway, double time_s) {
  const double angle_rad = angle_at(time_s, sway.period_s, sway.phase);
  MotionState state;
  state.offset_world = sway.amplitude_world * math::sin(angle_rad);
  state.velocity_world = sway.amplitude_world * (math::kTau / sway.period_s * math::cos(angle_rad));
  return state;
}

MotionState at(const Route& route, double time_s) {
  const auto after = std::upper_bound(route.knots.begin(), route.knots.end(), time_s,
                                      [](double time, const Knot& k) { return time < k.time_s; });
  const Knot& from = after == route.knots.begin() ? route.knots.front() : *std::prev(after);
  MotionState state{.offset_world = from.offset_world, .turn_rad = from.turn_rad};
  if (after == route.knots.begin() || after == route.knots.end()) return state;
  const double length_s = after->time_s - from.time_s;
  const Vector3d way = after->offset_world - from.offset_world;
  const double share = (time_s - from.time_s) / length_s;
  state.offset_world += share * way;
  state.velocity_world = way / length_s;
  state.turn_rad += share * (after->turn_rad - from.turn_rad);
  return state;
}

Vector3d turned(double x, double y, double z, double heading_rad) {
  const double c = math::cos(heading_rad), s = math::sin(heading_rad);
  return {c * x - s * y, s * x + c * y, z};
}

MotionState at(const Trefoil& knot, double time_s) {
  const double a = angle_at(time_s, knot.period_s, knot.phase);
  const double reach_m = knot.reach_m / 3.0;
  const double rate_radps = math::kTau / knot.period_s;
  const double sin_1 = math::sin(a), sin_2 = math::sin(2.0 * a), sin_3 = math::sin(3.0 * a);
  const double cos_1 = math::cos(a), cos_2 = math::cos(2.0 * a), cos_3 = math::cos(3.0 * a);
  MotionState state;
  state.offset_world = turned(reach_m * (sin_1 + 2.0 * sin_2), reach_m * (cos_1 - 2.0 * cos_2),
                              knot.rise_m * sin_3, knot.heading_rad);
  state.velocity_world =
      rate_radps * turned(reach_m * (cos_1 + 4.0 * cos_2), reach_m * (4.0 * sin_2 - sin_1),
                          3.0 * knot.rise_m * cos_3, knot.heading_rad);
  return state;
}

/// The greatest of `per_s` over a route's legs.
template <class PerSecond>
double greatest_of_legs(const Route& route, PerSecond per_s) {
  double greatest = 0.0;
  for (std::size_t i = 1; i < route.knots.size(); ++i) {
    const Knot& from = route.knots[i - 1];
    const Knot& to = route.knots[i];
    greatest = std::max(greatest, per_s(from, to) / (to.time_s - from.time_s));
  }
  return greatest;
}

double greatest_speed(const Sway& sway) {
  return sway.amplitude_world.norm() * math::kTau / sway.period_s;
}

double greatest_speed(const Route& route) {
  return greatest_of_legs(route, [](const Knot& from, const Knot& to) {
    return (to.offset_world - from.offset_world).norm();
  });
}

double greatest_speed(const Trefoil& knot) {
  // Horizontally reach/3 · √(17 + 8 cos 3a), upwards 3 rise · cos 3a: both are greatest at a = 0.
  return math::hypot(5.0 / 3.0 * knot.reach_m, 3.0 * knot.rise_m) * math::kTau / knot.period_s;
}

}  // namespace

MotionState state_at(const Motion& motion, double time_s) {
  return std::visit([time_s](const auto& path) { return at(path, time_s); }, motion.path);
}

double greatest_speed_mps(const Motion& motion) {
  return std::visit([](const auto& path) { return greatest_speed(path); }, motion.path);
}

double greatest_turn_radps(const Motion& motion) {
  const auto* route = std::get_if<Route>(&motion.path);
  if (route == nullptr) return 0.0;
  return greatest_of_legs(*route, [](const Knot& from, const Knot& to) {
    return std::abs(to.turn_rad - from.turn_rad);
  });
}

Eigen::Matrix3f upright_turn(double yaw_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = math::cos(yaw_rad);
  turn(1, 0) = math::sin(yaw_rad);
  turn(0, 1) = -turn(1, 0);
  return turn.cast<float>();
}

Eigen::Affine3f moved(const Eigen::Affine3f& T_world_prototype, const Motion& motion,
                      double time_s) {
  const MotionState state = state_at(motion, time_s);
  Eigen::Affine3f T = T_world_prototype;
  T.translation() += state.offset_world.cast<float>();
  // What never turns keeps its linear part exact.
  if (state.turn_rad != 0.0) {
    T.linear() = upright_turn(state.turn_rad) * T_world_prototype.linear();
  }
  return T;
}

}  // namespace avoidbench
