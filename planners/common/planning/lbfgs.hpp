#pragma once

#include <Eigen/Core>
#include <functional>

namespace planning {

struct LbfgsSpec {
  int memory = 16;
  int most_iterations = 200;
  int most_evaluations_a_step = 40;
  double gradient_tolerance = 0.01;  ///< converged at |g| <= this · max(1, |x|)
};

enum class LbfgsEnd { converged, stopped, too_many_iterations, no_descent };

struct LbfgsResult {
  LbfgsEnd end = LbfgsEnd::converged;
  double cost = 0.0;
  int iterations = 0, evaluations = 0;
};

/// The cost at `x`; fills `gradient`, which has its size.
using CostFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Limited-memory BFGS (Nocedal 1980) with a line search for the weak Wolfe conditions by bisection
/// (Lewis and Overton 2013), which copes with costs that are only piecewise smooth. `x` ends at the
/// best place found. `stop`, asked after each iteration, ends it where it stands.
LbfgsResult minimize(const CostFunction& cost, const LbfgsSpec& spec, Eigen::VectorXd& x,
                     const std::function<bool(const Eigen::VectorXd& x)>& stop = nullptr);

}  // namespace planning
