#include "planning/lbfgs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace planning {
namespace {

using Eigen::VectorXd;

TEST(Lbfgs, FindsTheMinimumOfAQuadraticAndOfRosenbrocksValley) {
  const LbfgsSpec spec{.gradient_tolerance = 1e-8};
  VectorXd x = VectorXd::LinSpaced(20, -3.0, 5.0);
  const LbfgsResult quadratic = minimize(
      [](const VectorXd& at, VectorXd& gradient) {
        double cost = 0.0;
        for (Eigen::Index i = 0; i < at.size(); ++i) {
          const auto weight = static_cast<double>(i + 1);
          cost += weight * (at[i] - 1.0) * (at[i] - 1.0);
          gradient[i] = 2.0 * weight * (at[i] - 1.0);
        }
        return cost;
      },
      spec, x);
  EXPECT_EQ(quadratic.end, LbfgsEnd::converged);
  EXPECT_LT((x - VectorXd::Ones(20)).norm(), 1e-6);

  VectorXd y(2);
  y << -1.2, 1.0;
  const LbfgsResult valley = minimize(
      [](const VectorXd& at, VectorXd& gradient) {
        const double a = 1.0 - at[0], b = at[1] - at[0] * at[0];
        gradient[0] = -2.0 * a - 400.0 * at[0] * b;
        gradient[1] = 200.0 * b;
        return a * a + 100.0 * b * b;
      },
      spec, y);
  EXPECT_EQ(valley.end, LbfgsEnd::converged);
  EXPECT_LT((y - VectorXd::Ones(2)).norm(), 1e-6);
  EXPECT_LT(valley.evaluations, 100);
}

TEST(Lbfgs, CopesWithACostThatIsSmoothInPiecesAlone) {
  VectorXd x = VectorXd::Constant(5, 4.0);
  const LbfgsResult result = minimize(
      [](const VectorXd& at, VectorXd& gradient) {
        double cost = 0.0;
        for (Eigen::Index i = 0; i < at.size(); ++i) {  // a hinge on each axis, a weak bowl beneath
          const double over = std::max(0.0, std::abs(at[i]) - 0.5);
          cost += over * over * over + 0.01 * at[i] * at[i];
          gradient[i] = (at[i] > 0 ? 3.0 : -3.0) * over * over + 0.02 * at[i];
        }
        return cost;
      },
      {.gradient_tolerance = 1e-5}, x);
  EXPECT_EQ(result.end, LbfgsEnd::converged);
  EXPECT_LT(x.norm(), 0.01);
}

TEST(Lbfgs, StopsWhenTold) {
  VectorXd x = VectorXd::Constant(3, 10.0);
  int asked = 0;
  const LbfgsResult result = minimize(
      [](const VectorXd& at, VectorXd& gradient) {
        gradient = 2.0 * at;
        return at.squaredNorm();
      },
      {.gradient_tolerance = 0.0}, x, [&](const VectorXd&) { return ++asked == 1; });
  EXPECT_EQ(result.end, LbfgsEnd::stopped);
  EXPECT_EQ(asked, 1);
}

TEST(Lbfgs, SaysWhenNothingDescends) {
  VectorXd x = VectorXd::Constant(1, 1.0);
  const LbfgsResult result = minimize(
      [](const VectorXd& at, VectorXd& gradient) {
        gradient[0] = -1.0;  // a gradient that lies
        return at[0];
      },
      {}, x);
  EXPECT_EQ(result.end, LbfgsEnd::no_descent);
  EXPECT_EQ(x[0], 1.0);
}

}  // namespace
}  // namespace planning
