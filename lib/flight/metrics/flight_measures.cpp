#include "metrics/flight_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trial/periods.hpp"

namespace avoidbench {
namespace {

using Samples = std::vector<Sample>;

/// Σ of value(a, b) over neighbouring samples.
template <class Value>
double sum_of_steps(const Samples& samples, Value value) {
  double sum = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) sum += value(samples[i - 1], samples[i]);
  return sum;
}

double duration_s(const Samples& samples) {
  return samples.empty() ? 0.0 : samples.back().time_s - samples.front().time_s;
}

double ratio(double numerator, double denominator) {
  return denominator > 0.0 ? numerator / denominator : 0.0;
}

}  // namespace

double flown_length_m(const Samples& samples) {
  return sum_of_steps(samples, [](const Sample& a, const Sample& b) {
    return (b.position_world - a.position_world).norm();
  });
}

std::optional<std::vector<Eigen::Vector3d>> accelerations_world(const Samples& samples) {
  constexpr double kSameMoment_s = 1e-9;  // ticks are 28 µs
  std::vector<Eigen::Vector3d> accelerations;
  if (samples.empty()) return accelerations;
  double next_s = samples.front().time_s;
  for (const Sample& sample : samples) {
    if (sample.time_s < next_s - kSameMoment_s) continue;
    if (sample.time_s > next_s + kSameMoment_s) return std::nullopt;
    accelerations.push_back(sample.acceleration_world);
    // From the first by multiplying: a running sum would drift off the grid.
    next_s = samples.front().time_s + static_cast<double>(accelerations.size()) / kJerkRate_hz;
  }
  return accelerations;
}

double jerk_integral_mps2(const Samples& samples) {
  const auto accelerations = accelerations_world(samples);
  if (!accelerations) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (std::size_t i = 1; i < accelerations->size(); ++i) {
    // |jerk| dt of a step is the change of the acceleration.
    sum += ((*accelerations)[i] - (*accelerations)[i - 1]).norm();
  }
  return sum;
}

double mean_speed_mps(const Samples& samples) {
  return ratio(flown_length_m(samples), duration_s(samples));
}

double max_speed_mps(const Samples& samples) {
  double fastest = 0.0;
  for (const Sample& sample : samples) fastest = std::max(fastest, sample.velocity_world.norm());
  return fastest;
}

double min_clearance_m(const Samples& samples) {
  double least = samples.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples) least = std::min(least, sample.clearance_m);
  return least;
}

double mean_clearance_m(const Samples& samples) {
  const double integral = sum_of_steps(samples, [](const Sample& a, const Sample& b) {
    return 0.5 * (a.clearance_m + b.clearance_m) * (b.time_s - a.time_s);
  });
  const double duration = duration_s(samples);
  if (duration > 0.0) return integral / duration;
  return samples.empty() ? 0.0 : samples.front().clearance_m;
}

double mean_curvature_1pm(const Samples& samples) {
  // Nearer points, as a hovering vehicle makes, would count its trembling as bends.
  constexpr double kSpacing_m = 0.05;
  std::vector<Eigen::Vector3d> points;
  for (const Sample& sample : samples) {
    if (points.empty() || (sample.position_world - points.back()).norm() >= kSpacing_m) {
      points.push_back(sample.position_world);
    }
  }
  double bending = 0.0, length_m = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d before = points[i] - points[i - 1], after = points[i + 1] - points[i];
    // Menger's curvature: four times the triangle's area over the product of its sides.
    const double sides = before.norm() * after.norm() * (points[i + 1] - points[i - 1]).norm();
    const double step_m = 0.5 * (before.norm() + after.norm());
    bending += ratio(2.0 * before.cross(after).norm(), sides) * step_m;
    length_m += step_m;
  }
  return ratio(bending, length_m);
}

double acceleration_effort(const Samples& samples) {
  const double integral = sum_of_steps(samples, [](const Sample& a, const Sample& b) {
    return 0.5 * (a.acceleration_world.squaredNorm() + b.acceleration_world.squaredNorm()) *
           (b.time_s - a.time_s);
  });
  return ratio(integral, flown_length_m(samples));
}

double jerk_effort(const Samples& samples) {
  const auto accelerations = accelerations_world(samples);
  if (!accelerations) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (std::size_t i = 1; i < accelerations->size(); ++i) {
    // |jerk|² dt of a step is (Δa / dt)² dt.
    sum += ((*accelerations)[i] - (*accelerations)[i - 1]).squaredNorm() * kJerkRate_hz;
  }
  return ratio(sum, flown_length_m(samples));
}

double tracking_rmse_m(const Samples& samples) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Sample& sample : samples) {
    // Under body rates no position is commanded.
    if (!sample.reference_world.allFinite()) continue;
    sum += (sample.reference_world - sample.position_world).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count))
                   : std::numeric_limits<double>::quiet_NaN();
}

double rotor_energy_j(const Samples& samples) {
  return sum_of_steps(samples, [](const Sample& a, const Sample& b) {
    return 0.5 * (a.rotor_power_w + b.rotor_power_w) * (b.time_s - a.time_s);
  });
}

double progress_pct(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                    const Eigen::Vector3d& end) {
  // AvoidBench eq. (7): of the way that is left, the part along the line from start to goal.
  const Eigen::Vector3d a = goal - start;
  const Eigen::Vector3d c = a - (end - start);
  return (1.0 - std::abs(a.dot(c) / a.squaredNorm())) * 100.0;
}

}  // namespace avoidbench
