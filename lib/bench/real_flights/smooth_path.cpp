#include "real_flights/smooth_path.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;

/// Position, velocity and acceleration as rows, x y z as columns: the axes share their covariance.
using State = Matrix3d;

Matrix3d transition(double dt) {
  Matrix3d f;
  f << 1.0, dt, 0.5 * dt * dt, 0.0, 1.0, dt, 0.0, 0.0, 1.0;
  return f;
}

/// What white jerk of this density adds to the covariance in a step.
Matrix3d step_noise(double density, double dt) {
  const double dt2 = dt * dt, dt3 = dt2 * dt;
  Matrix3d q;
  q << dt3 * dt2 / 20.0, dt2 * dt2 / 8.0, dt3 / 6.0, dt2 * dt2 / 8.0, dt3 / 3.0, dt2 / 2.0,
      dt3 / 6.0, dt2 / 2.0, dt;
  return density * q;
}

struct Filtered {
  State state;
  Matrix3d covariance;
};

/// Takes in a measured position.
void update(Filtered& now, const Eigen::Vector3d& position, double variance) {
  const Eigen::Vector3d gain = now.covariance.col(0) / (now.covariance(0, 0) + variance);
  now.state += gain * (position.transpose() - now.state.row(0));
  // Joseph's form stays symmetric and positive.
  Matrix3d rest = Matrix3d::Identity();
  rest.col(0) -= gain;
  now.covariance = rest * now.covariance * rest.transpose() + variance * gain * gain.transpose();
}

/// The quintic from one knot to the next that has their positions, velocities and accelerations:
/// what white jerk makes most likely between them.
PathState between(const PathState& a, const PathState& b, double time_s) {
  const double h = b.time_s - a.time_s, u = time_s - a.time_s;
  const Eigen::Vector3d p = b.position_world - a.position_world - h * a.velocity_world -
                            0.5 * h * h * a.acceleration_world;
  const Eigen::Vector3d v = b.velocity_world - a.velocity_world - h * a.acceleration_world;
  const Eigen::Vector3d w = b.acceleration_world - a.acceleration_world;
  const double h2 = h * h;
  const Eigen::Vector3d c3 = (10.0 * p / h2 - 4.0 * v / h + 0.5 * w) / h;
  const Eigen::Vector3d c4 = (-15.0 * p / h2 + 7.0 * v / h - w) / h2;
  const Eigen::Vector3d c5 = (6.0 * p / h2 - 3.0 * v / h + 0.5 * w) / (h2 * h);
  PathState state{.time_s = time_s};
  state.position_world =
      a.position_world +
      u * (a.velocity_world + u * (0.5 * a.acceleration_world + u * (c3 + u * (c4 + u * c5))));
  state.velocity_world = a.velocity_world + u * (a.acceleration_world +
                                                 u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)));
  state.acceleration_world =
      a.acceleration_world + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
  return state;
}

/// With constant acceleration from a knot at an end.
PathState beyond(const PathState& knot, double time_s) {
  const double u = time_s - knot.time_s;
  return {.time_s = time_s,
          .position_world =
              knot.position_world + u * knot.velocity_world + 0.5 * u * u * knot.acceleration_world,
          .velocity_world = knot.velocity_world + u * knot.acceleration_world,
          .acceleration_world = knot.acceleration_world};
}

}  // namespace

SmoothPath::SmoothPath(const std::vector<MeasuredPosition>& measured,
                       const SmoothingSpec& smoothing) {
  AB_CHECK(!measured.empty());
  constexpr double kLasts_s = 0.1;
  // Whatever a multirotor does: the first positions decide.
  constexpr double kSpeed_mps = 30.0, kAcceleration_mps2 = 30.0;
  const double variance = smoothing.position_noise_m * smoothing.position_noise_m;
  const double density = smoothing.jerk_mps3 * smoothing.jerk_mps3 * kLasts_s;

  std::vector<Filtered> filtered(measured.size());
  Filtered now;
  now.state << measured.front().position_world.transpose(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  now.covariance =
      Eigen::Vector3d(variance, kSpeed_mps * kSpeed_mps, kAcceleration_mps2 * kAcceleration_mps2)
          .asDiagonal();
  filtered.front() = now;
  for (std::size_t i = 1; i < measured.size(); ++i) {
    const double dt = measured[i].time_s - measured[i - 1].time_s;
    AB_CHECK(dt > 0.0, dt);
    const Matrix3d f = transition(dt);
    now.state = f * now.state;
    now.covariance = f * now.covariance * f.transpose() + step_noise(density, dt);
    update(now, measured[i].position_world, variance);
    filtered[i] = now;
  }

  knots_.resize(measured.size());
  State smooth = filtered.back().state;
  double squares_m2 = 0.0;
  for (std::size_t i = measured.size(); i-- > 0;) {
    if (i + 1 < measured.size()) {
      const double dt = measured[i + 1].time_s - measured[i].time_s;
      const Matrix3d f = transition(dt);
      const Matrix3d& p = filtered[i].covariance;
      const Matrix3d predicted = f * p * f.transpose() + step_noise(density, dt);
      // gain = p fᵀ predicted⁻¹, of symmetric matrices.
      const Matrix3d gain = predicted.ldlt().solve(f * p).transpose();
      smooth = filtered[i].state + gain * (smooth - f * filtered[i].state);
    }
    knots_[i] = {.time_s = measured[i].time_s,
                 .position_world = smooth.row(0).transpose(),
                 .velocity_world = smooth.row(1).transpose(),
                 .acceleration_world = smooth.row(2).transpose()};
    squares_m2 += (measured[i].position_world - knots_[i].position_world).squaredNorm();
  }
  residual_m_ = std::sqrt(squares_m2 / (3.0 * static_cast<double>(measured.size())));
}

PathState SmoothPath::at(double time_s) const {
  if (time_s <= knots_.front().time_s) return beyond(knots_.front(), time_s);
  if (time_s >= knots_.back().time_s) return beyond(knots_.back(), time_s);
  const auto next =
      std::upper_bound(knots_.begin(), knots_.end(), time_s,
                       [](double time, const PathState& knot) { return time < knot.time_s; });
  return between(*(next - 1), *next, time_s);
}

}  // namespace avoidbench
