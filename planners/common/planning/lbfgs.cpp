#include "planning/lbfgs.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

namespace planning {
namespace {

using Eigen::VectorXd;

/// One remembered step.
struct Pair {
  VectorXd step, change;  ///< of x and of the gradient
  double inverse_product;
};

/// The two-loop recursion: -H g.
VectorXd direction_of(const std::deque<Pair>& pairs, const VectorXd& gradient) {
  VectorXd direction = -gradient;
  std::vector<double> weights(pairs.size());
  for (std::size_t i = pairs.size(); i-- > 0;) {
    weights[i] = pairs[i].inverse_product * pairs[i].step.dot(direction);
    direction -= weights[i] * pairs[i].change;
  }
  if (!pairs.empty()) {
    const Pair& last = pairs.back();
    direction *= 1.0 / (last.inverse_product * last.change.squaredNorm());
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double weight = pairs[i].inverse_product * pairs[i].change.dot(direction);
    direction += (weights[i] - weight) * pairs[i].step;
  }
  return direction;
}

struct Point {
  VectorXd x, gradient;
  double cost = 0.0;
};

/// Moves `at` along the direction; false where no step descends enough.
bool line_search(const CostFunction& cost, const LbfgsSpec& spec, const VectorXd& direction,
                 double first_step, Point& at, LbfgsResult& result) {
  // The usual constants of the weak Wolfe conditions (Nocedal and Wright).
  constexpr double kDecrease = 1e-4, kCurvature = 0.9;
  const double slope = at.gradient.dot(direction);
  if (!(slope < 0.0)) return false;
  double low = 0.0, high = std::numeric_limits<double>::infinity(), step = first_step;
  Point tried = at;
  for (int i = 0; i < spec.most_evaluations_a_step; ++i) {
    tried.x = at.x + step * direction;
    tried.cost = cost(tried.x, tried.gradient);
    ++result.evaluations;
    if (!(tried.cost <= at.cost + kDecrease * step * slope)) {
      high = step;
    } else if (tried.gradient.dot(direction) < kCurvature * slope) {
      low = step;
    } else {
      at = std::move(tried);
      return true;
    }
    // Lewis and Overton's bisection: it needs no smooth second derivative, which costs in pieces
    // lack.
    step = std::isfinite(high) ? 0.5 * (low + high) : 2.0 * low;
  }
  if (tried.cost < at.cost) {  // it descends, if not by the rule
    at = std::move(tried);
    return true;
  }
  return false;
}

}  // namespace

LbfgsResult minimize(const CostFunction& cost, const LbfgsSpec& spec, VectorXd& x,
                     const std::function<bool(const VectorXd& x)>& stop) {
  LbfgsResult result;
  Point at{x, VectorXd::Zero(x.size()), 0.0};
  at.cost = cost(at.x, at.gradient);
  result.evaluations = 1;
  std::deque<Pair> pairs;
  result.end = LbfgsEnd::too_many_iterations;
  while (result.iterations < spec.most_iterations) {
    if (at.gradient.norm() <= spec.gradient_tolerance * std::max(1.0, at.x.norm())) {
      result.end = LbfgsEnd::converged;
      break;
    }
    const Point before = at;
    const VectorXd direction = direction_of(pairs, at.gradient);
    // Without a memory of curvature the gradient's length says nothing: a first step of unit length
    // at most.
    const double first_step = pairs.empty() ? 1.0 / std::max(1.0, at.gradient.norm()) : 1.0;
    if (!line_search(cost, spec, direction, first_step, at, result)) {
      if (!pairs.empty()) {  // once more, straight down
        pairs.clear();
        continue;
      }
      result.end = LbfgsEnd::no_descent;
      break;
    }
    ++result.iterations;
    if (stop && stop(at.x)) {
      result.end = LbfgsEnd::stopped;
      break;
    }
    Pair pair{at.x - before.x, at.gradient - before.gradient, 0.0};
    const double product = pair.step.dot(pair.change);
    // Else the step says nothing of a positive curvature, and the directions could cease to
    // descend.
    if (product > 1e-12 * pair.change.squaredNorm()) {
      pair.inverse_product = 1.0 / product;
      pairs.push_back(std::move(pair));
      if (pairs.size() > static_cast<std::size_t>(spec.memory)) pairs.pop_front();
    }
  }
  x = at.x;
  result.cost = at.cost;
  return result;
}

}  // namespace planning
