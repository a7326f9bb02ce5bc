#include "cost.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "planning/random.hpp"

namespace ego {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3Xd random_points(std::uint64_t seed, Index count) {
  planning::Random random(seed);
  Matrix3Xd points(3, count);
  for (Index i = 0; i < count; ++i) {
    for (Index k = 0; k < 3; ++k) {
      points(k, i) = random.uniform(-0.3, 0.3) + (k == 0 ? 0.4 * static_cast<double>(i) : 0.0);
    }
  }
  return points;
}

/// Expects that `add` returns a cost whose central differences are the gradient it adds.
void expect_gradient(const std::function<double(const Matrix3Xd&, Matrix3Xd&)>& add,
                     const Matrix3Xd& points, Index first, Index last) {
  Matrix3Xd gradient = Matrix3Xd::Constant(3, points.cols(), 1.0);  // it adds, and does not set
  Matrix3Xd ignored = gradient;
  ASSERT_GT(add(points, gradient), 0.0);
  double largest = 0.0;
  for (Index i = first; i <= last; ++i) {
    for (Index k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-6;
      Matrix3Xd moved = points;
      moved(k, i) += kStep;
      const double above = add(moved, ignored);
      moved(k, i) -= 2.0 * kStep;
      const double slope = (above - add(moved, ignored)) / (2.0 * kStep);
      EXPECT_NEAR(gradient(k, i) - 1.0, slope, 1e-5 * std::max(1.0, std::abs(slope)))
          << i << ", " << k;
      largest = std::max(largest, std::abs(slope));
    }
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(Cost, GradientsAreThoseOfFiniteDifferences) {
  const Matrix3Xd points = random_points(1, 14);
  const Matrix3Xd references = random_points(2, 12);
  Anchors anchors(14);
  planning::Random random(3);
  for (int i = 3; i < 11; ++i) {
    for (int k = 0; k < 3; ++k) {  // near enough for the cubic, and deep enough for the parabola
      const Vector3d way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      anchors[static_cast<std::size_t>(i)].push_back(
          {points.col(i) + random.uniform(-0.3, 0.9) * way.normalized(), way.normalized()});
    }
  }
  expect_gradient([](const auto& p, auto& g) { return add_smoothness(p, 0.7, g); }, points, 0, 13);
  expect_gradient([&](const auto& p, auto& g) { return add_collision(p, anchors, 0.5, 2.0, g); },
                  points, 3, 10);
  for (const planning::LimitOf of : {planning::LimitOf::norm, planning::LimitOf::axes}) {
    const planning::MotionLimits limits{1.0, 2.0, 0.0, of};
    expect_gradient([&](const auto& p, auto& g) { return add_feasibility(p, 0.2, limits, 0.3, g); },
                    points, 0, 13);
  }
  expect_gradient([&](const auto& p, auto& g) { return add_fitness(p, references, 1.5, g); },
                  points, 0, 13);
}

TEST(Cost, EvenFlightCostsNothing) {
  Matrix3Xd points(3, 10), gradient = Matrix3Xd::Zero(3, 10);
  for (Index i = 0; i < 10; ++i) points.col(i) = static_cast<double>(i) * Vector3d(0.3, 0.1, 0.0);
  EXPECT_NEAR(add_smoothness(points, 1.0, gradient), 0.0, 1e-20);
  EXPECT_EQ(add_feasibility(points, 0.2, {3.0, 4.0, 0.0}, 1.0, gradient), 0.0);
  EXPECT_NEAR(add_fitness(points, points.middleCols(1, 8), 1.0, gradient), 0.0, 1e-20);
  EXPECT_NEAR(gradient.norm(), 0.0, 1e-12);
}

/// 2 m/s along each axis are 2.8 m/s along a diagonal.
TEST(Cost, LimitsOfAxesLetDiagonalsBeFaster) {
  Matrix3Xd points(3, 10), gradient = Matrix3Xd::Zero(3, 10);
  for (Index i = 0; i < 10; ++i) points.col(i) = static_cast<double>(i) * Vector3d(0.38, 0.38, 0);
  const planning::MotionLimits axes{2.0, 3.0, 0.0, planning::LimitOf::axes};
  EXPECT_EQ(add_feasibility(points, 0.2, axes, 1.0, gradient), 0.0);
  EXPECT_EQ(gradient.norm(), 0.0);
  EXPECT_GT(add_feasibility(points, 0.2, {2.0, 3.0, 0.0}, 1.0, gradient), 0.0);
  points.row(1) *= 1.1;  // 2.09 m/s
  EXPECT_NEAR(add_feasibility(points, 0.2, axes, 1.0, gradient), 9 * 0.09 * 0.09 * 25.0, 1e-9);
}

TEST(Cost, CollisionIsTheCubicAndItsParabola) {
  Matrix3Xd points = Matrix3Xd::Zero(3, 7), gradient = Matrix3Xd::Zero(3, 7);
  Anchors anchors(7);
  anchors[3].push_back({Vector3d(0, 0, 0), Vector3d(1, 0, 0)});
  const auto cost_at = [&](double x) {
    points.col(3) = Vector3d(x, 0, 0);
    return add_collision(points, anchors, 0.5, 1.0, gradient);
  };
  EXPECT_EQ(cost_at(0.6), 0.0);
  EXPECT_NEAR(cost_at(0.3), 0.2 * 0.2 * 0.2, 1e-12);
  EXPECT_NEAR(cost_at(0.0), 0.125, 1e-12);
  EXPECT_NEAR(cost_at(-0.5), 3 * 0.5 - 0.75 + 0.125, 1e-12);  // c = 1
  EXPECT_NEAR(cost_at(1e-6), cost_at(-1e-6), 2e-6);           // continuous where they join
}

TEST(Cost, FitnessCountsAcrossMoreThanAlong) {
  Matrix3Xd points(3, 10), gradient = Matrix3Xd::Zero(3, 10);
  for (Index i = 0; i < 10; ++i) points.col(i) = static_cast<double>(i) * Vector3d(0.4, 0, 0);
  const Matrix3Xd references = points.middleCols(1, 8);
  Matrix3Xd along = points, across = points;
  along.row(0).array() += 0.1;
  across.row(1).array() += 0.1;
  EXPECT_NEAR(add_fitness(across, references, 1.0, gradient),
              25.0 * add_fitness(along, references, 1.0, gradient), 1e-9);
}

}  // namespace
}  // namespace ego
