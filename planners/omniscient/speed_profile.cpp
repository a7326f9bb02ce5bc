#include "speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace omniscient {
namespace {

constexpr double kTimeStep_s = 0.01;
constexpr int kSmoothing = 25;  ///< time steps over which accelerations come and go

constexpr double kEased_m = 0.4;

/// The greatest speed at each point: what curves allow, then what can be braked down to and
/// accelerated up to along the way (the forward and backward pass of time-optimal path following).
/// Accelerations along and across the way share the limit.
std::vector<double> fastest(const Line& curvature, double step_m, const Limits& limits) {
  const std::size_t count = curvature.size();
  std::vector<double> speed_mps(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double bend_1pm = curvature[i].norm();
    const double curve_mps = bend_1pm > 1e-9 ? std::sqrt(limits.acceleration_mps2 / bend_1pm) : 1e9;
    speed_mps[i] = std::min(limits.speed_mps, curve_mps);
  }
  // Easing blurs the speed: what a curve asks for has to hold around it.
  const auto reach = static_cast<std::size_t>(kEased_m / step_m);
  std::vector<double> lowest_mps(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = speed_mps.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, reach));
    const auto to = speed_mps.begin() + static_cast<std::ptrdiff_t>(std::min(count, i + reach + 1));
    lowest_mps[i] = *std::min_element(from, to);
  }
  speed_mps = lowest_mps;
  const auto limit_by = [&](std::size_t before, std::size_t i) {
    const double square = speed_mps[before] * speed_mps[before];
    const double across = square * curvature[before].norm() / limits.acceleration_mps2;
    const double along_mps2 =
        limits.acceleration_mps2 * std::sqrt(std::max(0.0, 1.0 - across * across));
    speed_mps[i] = std::min(speed_mps[i], std::sqrt(square + 2.0 * along_mps2 * step_m));
  };
  speed_mps.front() = 0.0;
  if (limits.ends_at_rest) speed_mps.back() = 0.0;
  for (std::size_t i = 1; i < count; ++i) limit_by(i - 1, i);
  for (std::size_t i = count - 1; i > 0; --i) limit_by(i, i - 1);
  return speed_mps;
}

/// The way at each time step.
std::vector<double> way_over_time(const std::vector<double>& speed_mps, double step_m) {
  std::vector<double> way_m{0.0};
  double time_s = 0.0;
  for (std::size_t i = 1; i < speed_mps.size(); ++i) {
    const double mean_mps = std::max(0.5 * (speed_mps[i - 1] + speed_mps[i]), 0.01);
    const double end_s = time_s + step_m / mean_mps;
    // Acceleration is constant between two points.
    const double acceleration_mps2 = (speed_mps[i] - speed_mps[i - 1]) / (end_s - time_s);
    while (static_cast<double>(way_m.size()) * kTimeStep_s <= end_s) {
      const double since_s = static_cast<double>(way_m.size()) * kTimeStep_s - time_s;
      const double along_m = since_s * (speed_mps[i - 1] + 0.5 * acceleration_mps2 * since_s);
      way_m.push_back(static_cast<double>(i - 1) * step_m + along_m);
    }
    time_s = end_s;
  }
  return way_m;
}

/// The mean of each step and those before it, so that no acceleration jumps.
std::vector<double> eased(const std::vector<double>& way_m) {
  std::vector<double> mean_m;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    sum_m += way_m[i] - (i >= kSmoothing ? way_m[i - kSmoothing] : 0.0);
    mean_m.push_back(sum_m / kSmoothing);
  }
  return mean_m;
}

/// A value with its first and second derivative.
template <class Value>
struct Splined {
  Value value, slope, bend;
};

/// The uniform cubic B-spline with these control points: two times continuously differentiable, so
/// that positions, velocities and accelerations fit each other. Beyond the ends it goes straight
/// on.
template <class Value>
Splined<Value> spline_at(const std::vector<Value>& points, double x) {
  const auto last = static_cast<std::int64_t>(points.size()) - 1;
  const auto point = [&](std::int64_t i) -> Value {
    if (i >= 0 && i <= last) return points[static_cast<std::size_t>(i)];
    const Value& end = i < 0 ? points.front() : points.back();
    const Value& inner = i < 0 ? points[1] : points[points.size() - 2];
    return end + static_cast<double>(i < 0 ? -i : i - last) * (end - inner);
  };
  const auto i = static_cast<std::int64_t>(std::floor(x));
  const double u = x - static_cast<double>(i), v = 1.0 - u;
  const Value a = point(i - 1), b = point(i), c = point(i + 1), d = point(i + 2);
  return {(v * v * v * a + (3.0 * u * u * u - 6.0 * u * u + 4.0) * b +
           (3.0 * v * v * v - 6.0 * v * v + 4.0) * c + u * u * u * d) /
              6.0,
          (u * u * (d - c) + (2.0 * u * v + 1.0) * (c - b) + v * v * (b - a)) / 2.0,
          u * (d - 2.0 * c + b) + v * (c - 2.0 * b + a)};
}

}  // namespace

TimedLine::TimedLine(const Line& line, const Limits& limits)
    : step_m_((line[1] - line[0]).norm()), line_(line) {
  Line curvature(line.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    curvature[i] = (line[i + 1] - 2.0 * line[i] + line[i - 1]) / (step_m_ * step_m_);
  }
  std::vector<double> way_m = way_over_time(fastest(curvature, step_m_, limits), step_m_);
  // Easing lags behind: it comes to rest, too.
  if (limits.ends_at_rest) way_m.insert(way_m.end(), kSmoothing + 1, way_m.back());
  way_m_ = eased(way_m);
}

Motion TimedLine::at(double time_s) const {
  const auto way = spline_at(way_m_, time_s / kTimeStep_s);
  const auto place = spline_at(line_, way.value / step_m_);
  const double rate_1ps = way.slope / (kTimeStep_s * step_m_);  // line steps a second
  const double rate_1ps2 = way.bend / (kTimeStep_s * kTimeStep_s * step_m_);
  return {place.value, rate_1ps * place.slope,
          rate_1ps2 * place.slope + rate_1ps * rate_1ps * place.bend};
}

}  // namespace omniscient
