#include "emergency_stop.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "avoidbench/portable_math.hpp"
#include "planning/trajectory_command.hpp"

namespace ego {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;
namespace portable = avoidbench::portable;

constexpr int kSamples = 24;

bool is_flyable(const Settings& settings, const Quintic& quintic, double most_at_start) {
  const double most = std::max(settings.vehicle_acceleration_mps2, 1.02 * most_at_start);
  for (int i = 0; i <= kSamples; ++i) {
    const Motion motion = motion_at(quintic, quintic.duration_s * i / kSamples);
    if (motion.acceleration.norm() > most) return false;
  }
  const planning::TimedMotion motion{[&](double time_s) { return motion_at(quintic, time_s); },
                                     quintic.duration_s};
  return thrust_turn_rate_radps(motion, settings.gravity_mps2) <= settings.max_turn_rate_radps;
}

/// The share of its way that is free: 2 where nothing near is blocked, 1 where nothing is touched.
double freedom(const Surroundings& surroundings, const Quintic& quintic) {
  bool is_blocked = false;
  for (int i = 1; i <= kSamples; ++i) {
    const Vector3d place = motion_at(quintic, quintic.duration_s * i / kSamples).position;
    if (surroundings.is_touching(place)) return static_cast<double>(i) / (kSamples + 1);
    is_blocked = is_blocked || surroundings.is_blocked(place);
  }
  return is_blocked ? 1.0 : 2.0;
}

}  // namespace

Quintic emergency_stop(const Surroundings& surroundings, const Settings& settings,
                       const Motion& from) {
  const Quintic straight = planning::stopping(from, kBraking * settings.vehicle_acceleration_mps2);
  double best = freedom(surroundings, straight);
  Quintic found = straight;
  const Vector3d way = motion_at(straight, straight.duration_s).position - from.position;
  const Vector3d level(-way.y(), way.x(), 0.0);
  if (best >= 2.0 || level.norm() < 0.1) return found;
  const Vector3d aside = level.normalized();
  const Vector3d upward = way.cross(aside).normalized();
  for (const double longer : {1.0, 1.25, 1.6}) {
    for (const double angle : {0.3, 0.6, 0.9}) {
      for (const Vector3d& across : {aside, Vector3d(-aside), upward, Vector3d(-upward)}) {
        Motion rest;
        rest.position = from.position + portable::cos(angle) * way +
                        (portable::sin(angle) * way.norm()) * across;
        const Quintic tried = quintic_between(from, rest, longer * straight.duration_s);
        if (!is_flyable(settings, tried, from.acceleration.norm())) continue;
        const double free = freedom(surroundings, tried);
        if (free <= best) continue;
        best = free;
        found = tried;
      }
    }
  }
  return found;
}

}  // namespace ego
