#include "smooth_line.hpp"

#include <algorithm>

namespace omniscient {
namespace {

constexpr int kRounds = 60;
constexpr double kSlack_m = 0.02;  ///< less than that is no violation
// Of a spring between a point and its place on the line, beside the bending of a beam of points one
// apart: one as long as the fourth root of 1 / stiffness follows the beam.
constexpr double kSoft = 1e-6, kStiffer = 4.0, kFixed = 1e9;

/// The points of `bent` that are nearer than `radius_m` to a surface, or behind one as seen from
/// the same point of `line`: what is thin has free space on both sides.
std::vector<std::size_t> places_in_the_way(const Line& line, const Line& bent, double radius_m,
                                           const Clearances& clearances) {
  constexpr double kProbeStep_m = 0.1, kThrough_m = 0.06;  // more than half a step
  Line probes;
  std::vector<std::size_t> point_of;  // of each probe
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d aside = bent[i] - line[i];
    const int count = static_cast<int>(aside.norm() / kProbeStep_m) + 1;
    for (int k = 1; k <= count; ++k) {
      probes.emplace_back(line[i] + aside * (static_cast<double>(k) / count));
      point_of.push_back(i);
    }
  }
  const std::vector<double> free_m = clearances(probes);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < probes.size(); ++k) {
    const bool is_end = k + 1 == probes.size() || point_of[k + 1] != point_of[k];
    const bool is_in_the_way = free_m[k] < (is_end ? radius_m - kSlack_m : kThrough_m);
    if (is_in_the_way && (found.empty() || found.back() != point_of[k])) {
      found.push_back(point_of[k]);
    }
  }
  return found;
}

/// The beam on springs of these stiffnesses at the points of a line: the least of the sum of
/// |x[i-1] - 2 x[i] + x[i+1]|² over the inner points and stiffness[i] |x[i] - line[i]|².
/// Solved by Cholesky's decomposition of the matrix with five diagonals.
Line beam(const Line& line, const std::vector<double>& stiffness) {
  const std::size_t count = line.size();
  std::vector<double> diagonal(stiffness), first(count, 0.0), second(count, 0.0);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    diagonal[i - 1] += 1.0;
    diagonal[i] += 4.0;
    diagonal[i + 1] += 1.0;
    first[i - 1] -= 2.0;  // between i - 1 and i
    first[i] -= 2.0;
    second[i - 1] += 1.0;  // between i - 1 and i + 1
  }
  Line x(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = stiffness[i] * line[i];
    if (i >= 2) {
      diagonal[i] -= second[i - 2] * second[i - 2] * diagonal[i - 2];
      x[i] -= second[i - 2] * x[i - 2];
    }
    if (i >= 1) {
      diagonal[i] -= first[i - 1] * first[i - 1] * diagonal[i - 1];
      x[i] -= first[i - 1] * x[i - 1];
      first[i] -= second[i - 1] * diagonal[i - 1] * first[i - 1];
    }
    first[i] /= diagonal[i];
    second[i] /= diagonal[i];
  }
  for (std::size_t i = count; i-- > 0;) {
    x[i] /= diagonal[i];
    if (i + 1 < count) x[i] -= first[i] * x[i + 1];
    if (i + 2 < count) x[i] -= second[i] * x[i + 2];
  }
  return x;
}

}  // namespace

Line resampled(const Line& line, double step_m) {
  Line even{line.front()};
  double left_m = step_m;  // to the next point
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d leg = line[i + 1] - line[i];
    const double length_m = leg.norm();
    double at_m = left_m;
    while (at_m <= length_m) {
      even.push_back(line[i] + leg * (at_m / length_m));
      at_m += step_m;
    }
    left_m = at_m - length_m;
  }
  // No two points in one place.
  if ((line.back() - even.back()).norm() > 0.5 * step_m) {
    even.push_back(line.back());
  } else if (even.size() > 1) {
    even.back() = line.back();
  }
  return even;
}

Line smoothed(const Line& line, double radius_m, const Clearances& clearances,
              const std::vector<std::size_t>& held) {
  std::vector<double> stiffness(line.size(), kSoft);
  stiffness.front() = stiffness.back() = kFixed;
  for (const std::size_t i : held) stiffness[i] = kFixed;
  for (int round = 0; round < kRounds; ++round) {
    Line bent = beam(line, stiffness);
    const std::vector<std::size_t> found = places_in_the_way(line, bent, radius_m, clearances);
    if (found.empty()) return bent;
    for (const std::size_t i : found) stiffness[i] = std::min(stiffness[i] * kStiffer, kFixed);
  }
  return {};
}

}  // namespace omniscient
