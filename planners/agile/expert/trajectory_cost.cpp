#include "trajectory_cost.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/portable_math.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;
using planning::Motion;

constexpr int kSteps = 20;
constexpr double kMaxAcceleration_mps2 = 6.0, kJerk_mps3 = 40.0;

double square(double x) { return x * x; }

/// 0 beyond 0.8 m, 1 at 0.4 m, 4 at a surface, and more inside; no step between.
double penalty(double clearance_m) {
  constexpr double kFar_m = 0.8, kNear_m = 0.4;
  if (clearance_m >= kFar_m) return 0.0;
  if (clearance_m >= kNear_m) return (kFar_m - clearance_m) / (kFar_m - kNear_m);
  if (clearance_m >= 0.0) return 1.0 + 3.0 * (1.0 - square(clearance_m / kNear_m));
  return 4.0 - 8.0 * clearance_m;
}

/// Also to where the map ends, except for its floor.
double clearance_m(const ClearanceField& field, const Situation& situation, const Vector3d& place) {
  double least_m = field.at(place);
  for (int axis = 0; axis < 2; ++axis) {
    least_m = std::min(least_m, place[axis] - situation.lowest_world[axis]);
    least_m = std::min(least_m, situation.highest_world[axis] - place[axis]);
  }
  return std::min(least_m, situation.highest_world.z() - place.z());
}

/// Beyond 40° of the image's axis, while that counts.
double view_penalty(const Situation& situation, const Vector3d& way) {
  constexpr double kLeastWay_m = 0.3, kPerRadian_deg = 180.0 / 3.14159265358979323846;
  const double way_m = way.norm();
  if (way_m < kLeastWay_m) return 0.0;
  const Vector3d axis = turned_to_world(situation.frame, Vector3d::UnitX());
  const double angle = avoidbench::portable::acos(std::clamp(way.dot(axis) / way_m, -1.0, 1.0));
  return 0.02 * square(std::max(0.0, angle * kPerRadian_deg - 40.0) / 10.0);
}

}  // namespace

TrajectoryCost trajectory_cost(const ClearanceField& field, const Situation& situation,
                               const planning::Quintic& curve) {
  TrajectoryCost cost;
  const double speed_mps = situation.desired_speed_mps, dt = kHorizon_s / kSteps;
  constexpr double kMeanWeight = 1.5 - 0.5 * (1.0 + 1.0 / kSteps);
  const Vector3d to_goal = goal_direction_world(situation);
  for (int i = 1; i <= kSteps; ++i) {
    const double t = i * dt;
    const Motion motion = motion_at(curve, t);
    const double weight = (1.5 - double(i) / kSteps) / kMeanWeight / kSteps;
    cost.collision += weight * penalty(clearance_m(field, situation, motion.position));
    cost.effort += 0.1 / kSteps *
                   (motion.acceleration.squaredNorm() / square(kMaxAcceleration_mps2) +
                    jerk_at(curve, t).squaredNorm() / square(kJerk_mps3));
    const double fast = std::max(0.0, motion.velocity.norm() / speed_mps - 1.0);
    const double hard = std::max(0.0, motion.acceleration.norm() / kMaxAcceleration_mps2 - 1.0);
    cost.limits += (20.0 * square(fast) + 4.0 * square(hard)) / kSteps;
    const Vector3d way = motion.position - situation.start.position;
    cost.height += 0.1 / kSteps * square(way.z() - way.dot(to_goal) * to_goal.z());
    constexpr int kSeen = 8;
    if (i <= kSeen) {
      cost.view += view_penalty(situation, way) / kSeen;
    }
  }
  const double reach = reach_m(situation);
  const Vector3d& start = situation.start.position;
  const Vector3d goal = start + 1.5 * reach * to_goal;
  const Vector3d end = motion_at(curve, kHorizon_s).position;
  cost.progress = 1.0 - ((goal - start).norm() - (goal - end).norm()) / reach;
  return cost;
}

}  // namespace agile
