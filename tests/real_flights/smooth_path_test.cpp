#include "real_flights/smooth_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double kVariance0[] = {30.0 * 30.0, 30.0 * 30.0};  // of the first speed, acceleration

/// The posterior mean by one dense system over all knots, those without a measurement too: what
/// filter and smoother must give.
class Dense {
 public:
  Dense(const std::vector<double>& times_s, const SmoothingSpec& smoothing)
      : times_s_(times_s),
        information_(MatrixXd::Zero(size(), size())),
        right_(MatrixXd::Zero(size(), 3)),
        variance_(smoothing.position_noise_m * smoothing.position_noise_m) {
    const double density = smoothing.jerk_mps3 * smoothing.jerk_mps3 * 0.1;
    for (std::size_t i = 0; i + 1 < times_s.size(); ++i) {
      const double h = times_s[i + 1] - times_s[i];
      Matrix3d f, q;
      f << 1, h, h * h / 2, 0, 1, h, 0, 0, 1;
      q << std::pow(h, 5) / 20, std::pow(h, 4) / 8, std::pow(h, 3) / 6, std::pow(h, 4) / 8,
          std::pow(h, 3) / 3, h * h / 2, std::pow(h, 3) / 6, h * h / 2, h;
      MatrixXd step = MatrixXd::Zero(3, size());
      step.middleCols(at(i), 3) = -f;
      step.middleCols(at(i + 1), 3) = Matrix3d::Identity();
      information_ += step.transpose() * (density * q).inverse() * step;
    }
    information_(1, 1) += 1.0 / kVariance0[0];
    information_(2, 2) += 1.0 / kVariance0[1];
  }

  void measure(std::size_t knot, const Vector3d& position) {
    information_(at(knot), at(knot)) += 1.0 / variance_;
    right_.row(at(knot)) += position.transpose() / variance_;
  }

  MatrixXd solution() const { return information_.fullPivLu().solve(right_); }
  static Eigen::Index at(std::size_t knot) { return static_cast<Eigen::Index>(3 * knot); }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(3 * times_s_.size()); }

  std::vector<double> times_s_;
  MatrixXd information_, right_;
  double variance_;
};

TEST(SmoothPath, IsTheMostLikelyPathAtAndBetweenItsKnots) {
  // Uneven times, as logs have; every second knot has no measurement.
  const std::vector<double> times_s{0.0, 0.03, 0.1, 0.12, 0.2, 0.31, 0.4, 0.41, 0.5};
  const SmoothingSpec smoothing{.position_noise_m = 0.02, .jerk_mps3 = 20.0};
  Dense dense(times_s, smoothing);
  std::vector<MeasuredPosition> measured;
  RandomStream random = stream(7, "positions");
  for (std::size_t i = 0; i < times_s.size(); i += 2) {
    const Vector3d position(times_s[i], random.uniform(-0.1, 0.1), random.uniform(1.0, 1.2));
    measured.push_back({times_s[i], position});
    dense.measure(i, position);
  }
  const SmoothPath path(measured, smoothing);
  const MatrixXd expected = dense.solution();
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const PathState state = path.at(times_s[i]);
    const Eigen::Index row = Dense::at(i);
    EXPECT_LT((state.position_world - expected.row(row).transpose()).norm(), 1e-7) << i;
    EXPECT_LT((state.velocity_world - expected.row(row + 1).transpose()).norm(), 1e-6) << i;
    EXPECT_LT((state.acceleration_world - expected.row(row + 2).transpose()).norm(), 1e-4) << i;
  }
}

/// A circle of 3 m at 3 m/s, positions without noise at 100 Hz.
TEST(SmoothPath, FollowsACircle) {
  std::vector<MeasuredPosition> measured;
  const auto place = [](double t) { return Vector3d(3 * math::cos(t), 3 * math::sin(t), 2.0); };
  for (int i = 0; i <= 600; ++i) measured.push_back({0.01 * i, place(0.01 * i)});
  const SmoothPath path(measured, {.position_noise_m = 0.001, .jerk_mps3 = 30.0});
  for (double t = 0.5; t < 5.5; t += 0.0137) {
    const PathState state = path.at(t);
    EXPECT_LT((state.position_world - place(t)).norm(), 1e-4);
    EXPECT_NEAR(state.velocity_world.norm(), 3.0, 1e-3);
    EXPECT_NEAR(state.acceleration_world.norm(), 3.0, 0.03);
  }
  EXPECT_LT(path.residual_m(), 1e-4);
}

TEST(SmoothPath, FindsTheNoiseOfItsPositions) {
  std::vector<MeasuredPosition> measured;
  RandomStream random = stream(3, "noise");
  for (int i = 0; i <= 2000; ++i) {
    const Vector3d noise(random.normal(), random.normal(), random.normal());
    measured.push_back({0.01 * i, Vector3d(0.02 * i, 0, 1) + 0.03 * noise});
  }
  const SmoothPath path(measured, {.position_noise_m = 0.03, .jerk_mps3 = 10.0});
  EXPECT_NEAR(path.residual_m(), 0.03, 0.002);
  EXPECT_NEAR(path.at(10.0).velocity_world.x(), 2.0, 0.1);
}

TEST(SmoothPath, GoesOnBeyondItsEnds) {
  const SmoothPath path({{1.0, Vector3d(4, 5, 6)}}, {});
  EXPECT_EQ(path.at(0.0).position_world, Vector3d(4, 5, 6));
  EXPECT_EQ(path.at(9.0).position_world, Vector3d(4, 5, 6));
}

}  // namespace
}  // namespace avoidbench
