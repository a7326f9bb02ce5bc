#include "optimizer.hpp"

#include "anchors.hpp"
#include "planning/lbfgs.hpp"

namespace ego {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::Matrix3Xd;
using Eigen::VectorXd;
using planning::Bspline;

constexpr int kMostRebounds = 20, kMostTries = 3;
constexpr double kSmoothEnough = 0.1;  ///< a point, before new obstacles are looked for

/// The points that may move: all but three at each end.
auto free_points(Matrix3Xd& points) { return points.middleCols(3, points.cols() - 6); }

VectorXd as_variables(Matrix3Xd& points) {
  const Matrix3Xd free = free_points(points);
  return Map<const VectorXd>(free.data(), free.size());
}

void set_variables(const VectorXd& x, Matrix3Xd& points) {
  free_points(points) = Map<const Matrix3Xd>(x.data(), 3, x.size() / 3);
}

/// Minimizes what `add_costs` says of the points; it adds to the gradient of all of them.
template <class AddCosts>
planning::LbfgsEnd optimize(const AddCosts& add_costs, double gradient_tolerance,
                            const std::function<bool()>& stop, Matrix3Xd& points) {
  Matrix3Xd gradient(3, points.cols());
  const auto cost = [&](const VectorXd& x, VectorXd& slope) {
    set_variables(x, points);
    gradient.setZero();
    const double value = add_costs(gradient);
    slope = as_variables(gradient);
    return value;
  };
  planning::LbfgsSpec spec;
  spec.gradient_tolerance = gradient_tolerance;
  VectorXd x = as_variables(points);
  const auto result = planning::minimize(cost, spec, x, [&](const VectorXd& at) {
    set_variables(at, points);
    return stop && stop();
  });
  set_variables(x, points);
  return result.end;
}

/// Anchors for all blocked parts; false where one of them has no way around.
bool anchor_all(Surroundings& surroundings, const Matrix3Xd& points, Anchors& anchors) {
  bool is_all = true;
  for (const Segment& segment : blocked_segments(surroundings, points)) {
    is_all = anchor_segment(surroundings, points, segment, anchors) && is_all;
  }
  return is_all;
}

/// Anchors for what the known ones don't know; false where there is nothing new, or no way around.
bool anchor_new(Surroundings& surroundings, const Matrix3Xd& points, Anchors& anchors) {
  bool is_any = false;
  for (const Segment& segment : blocked_segments(surroundings, points)) {
    if (!is_new(surroundings, points, segment, anchors)) continue;
    is_any = anchor_segment(surroundings, points, segment, anchors) || is_any;
  }
  return is_any;
}

/// Minimizes with these anchors; new obstacles that it runs into on the way get anchors too.
void push_out(Surroundings& surroundings, const Settings& settings, double collision_weight,
              Anchors& anchors, Bspline& curve) {
  const Index free_count = curve.points.cols() - 6;
  const Weights& weights = settings.weights;
  double smoothness = 0.0;
  const auto add_costs = [&](Matrix3Xd& gradient) {
    smoothness = add_smoothness(curve.points, weights.smoothness, gradient);
    return smoothness +
           add_collision(curve.points, anchors, settings.safety_distance_m, collision_weight,
                         gradient) +
           add_feasibility(curve.points, curve.interval_s, limits_of(settings), weights.feasibility,
                           gradient);
  };
  for (int rebound = 0; rebound < kMostRebounds; ++rebound) {
    int iterations = 0;
    const auto stop = [&] {
      const bool is_smooth = smoothness < kSmoothEnough * static_cast<double>(free_count);
      return ++iterations > 3 && is_smooth && anchor_new(surroundings, curve.points, anchors);
    };
    constexpr double kTolerance = 0.01;
    if (optimize(add_costs, kTolerance, stop, curve.points) != planning::LbfgsEnd::stopped) return;
  }
}

}  // namespace

std::optional<double> first_blocked_s(const Surroundings& surroundings, const Settings& settings,
                                      const Bspline& curve) {
  const double step_s = surroundings.grid.spec().resolution_m / settings.max_speed_mps;
  return first_blocked_s(
      surroundings, [&](double time_s) { return position_at(curve, time_s); }, 0.0,
      checked_s(curve), step_s);
}

std::optional<Bspline> rebounded(Surroundings& surroundings, const Settings& settings,
                                 Bspline curve) {
  double collision_weight = settings.weights.collision;
  for (int tried = 0; tried < kMostTries; ++tried) {
    Anchors anchors(static_cast<std::size_t>(curve.points.cols()));
    if (!anchor_all(surroundings, curve.points, anchors)) return std::nullopt;
    push_out(surroundings, settings, collision_weight, anchors, curve);
    const auto blocked_s = first_blocked_s(surroundings, settings, curve);
    if (!blocked_s) return curve;
    if (*blocked_s <= curve.interval_s) return std::nullopt;  // what can't be moved is blocked
    collision_weight *= 2.0;
  }
  return std::nullopt;
}

Bspline refined(const Settings& settings, const Bspline& slower) {
  const Index knots = slower.points.cols() - 2;
  const Matrix3Xd references =
      (slower.points.leftCols(knots) + 4.0 * slower.points.middleCols(1, knots) +
       slower.points.rightCols(knots)) /
      6.0;
  Bspline curve = slower;
  const auto add_costs = [&](Matrix3Xd& gradient) {
    return add_smoothness(curve.points, settings.weights.smoothness, gradient) +
           add_fitness(curve.points, references, settings.weights.fitness, gradient) +
           add_feasibility(curve.points, curve.interval_s, limits_of(settings),
                           settings.weights.feasibility, gradient);
  };
  constexpr double kTolerance = 0.001;
  optimize(add_costs, kTolerance, nullptr, curve.points);
  return curve;
}

}  // namespace ego
