#include "pilot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;
using planning::TimedMotion;
namespace portable = avoidbench::portable;

constexpr double kPointStep_s = 0.05;
constexpr double kLag_s = 0.2;    ///< the vehicle may be so far behind its trajectory
constexpr double kBraking = 0.7;  ///< of the vehicle's acceleration
constexpr double kSpeedTolerance = 0.05;
constexpr double kJerk_mps3 = 70.0;  ///< over 9.8 m/s²: 7 rad/s of roll or pitch
constexpr double kFar_m = 1e5;       ///< where the map ends, if nobody says

TimedMotion timed(const Quintic& curve) {
  return {[curve](double time_s) { return motion_at(curve, time_s); }, curve.duration_s};
}

TimedMotion timed(const Candidate& mode) {
  return {[curve = mode.curve, stop = mode.stop, end_s = mode.end_s](double time_s) {
            return time_s < end_s ? motion_at(curve, time_s) : motion_at(stop, time_s - end_s);
          },
          mode.end_s + mode.stop.duration_s};
}

bool is_place(const Vector3d& point) { return point.allFinite() && point.norm() < kFar_m; }

}  // namespace

Seen seen_of(const ab_observation& seen) {
  const ab_state& state = *seen.state;
  return {.time_s = state.time_s,
          .position_world = avoidbench::as_vector(state.position_world_m),
          .velocity_world = avoidbench::as_vector(state.velocity_world_mps),
          .depth = avoidbench::newest_depth(seen, 0)};
}

Pilot::Pilot(const Settings& settings, Think think)
    : settings_(settings), think_(std::move(think)) {}

void Pilot::reset(const ab_mission& mission) {
  goal_ = avoidbench::as_vector(mission.goal_world_m);
  has_mission_ = is_place(goal_) && is_place(avoidbench::as_vector(mission.start_world_m));
  start_yaw_rad_ = std::isfinite(mission.start_yaw_rad) ? mission.start_yaw_rad : 0.0;
  lowest_ = Vector3d::Constant(-kFar_m);
  highest_ = Vector3d::Constant(kFar_m);
  latency_s_ = 0.0;
  if (mission.struct_size >= offsetof(ab_mission, command_latency_s) + sizeof(double)) {
    const Vector3d lowest = avoidbench::as_vector(mission.lowest_world_m);
    const Vector3d highest = avoidbench::as_vector(mission.highest_world_m);
    const Vector3d start = avoidbench::as_vector(mission.start_world_m);
    // Hosts that know no box leave zeros.
    if (is_place(lowest) && is_place(highest) && (lowest.array() < start.array()).all() &&
        (start.array() < highest.array()).all()) {
      lowest_ = lowest;
      highest_ = highest;
    }
    // Where it is measured nobody knows it before.
    if (std::isfinite(mission.command_latency_s)) latency_s_ = mission.command_latency_s;
  }
  // The heights that the net was trained in: under a far higher ceiling it would climb.
  constexpr double kBelow_m = 3.0, kAbove_m = 4.4;
  double low_m = mission.start_world_m[2], high_m = low_m;
  for (const avoidbench::Vec3& goal : avoidbench::goals_of(mission)) {
    low_m = std::min(low_m, goal[2]);
    high_m = std::max(high_m, goal[2]);
  }
  lowest_.z() = std::max(lowest_.z(), low_m - kBelow_m);
  highest_.z() = std::min(highest_.z(), high_m + kAbove_m);
  is_first_ = true;
  flown_.clear();
  candidates_.clear();
  points_.clear();
}

void Pilot::fly_to(const Vector3d& goal_world) {
  goal_ = goal_world;
  has_mission_ = has_mission_ && is_place(goal_);
}

/// What was commanded for this moment.
Motion Pilot::planned_at(double time_s) const {
  const auto next = std::find_if(flown_.begin() + 1, flown_.end(),
                                 [&](const Flown& f) { return f.start_s > time_s; });
  const Flown& flown = *(next - 1);
  return flown.motion.at(std::clamp(time_s - flown.start_s, 0.0, flown.motion.duration_s));
}

/// Where the vehicle will be when the command takes effect: on its trajectory, or where it can't
/// follow that, as the odometry has it.
Motion Pilot::next_start(const Seen& seen) {
  double off_m = std::numeric_limits<double>::infinity();
  for (const double behind_s : {0.0, 0.25 * kLag_s, 0.5 * kLag_s, kLag_s}) {
    const Motion planned = planned_at(seen.time_s - behind_s);
    off_m = std::min(off_m, (planned.position - seen.position_world).norm());
  }
  if (off_m <= settings_.tracking_error_m) return planned_at(effect_s_);
  const Motion start{seen.position_world + latency_s_ * seen.velocity_world, seen.velocity_world,
                     Vector3d::Zero()};
  flown_.clear();
  stop(start);
  return start;
}

/// Full speed, and near the goal what can still be braked to a stop there.
double Pilot::desired_speed_mps(const Vector3d& position) const {
  constexpr double kLeast_mps = 0.3, kNear_hz = 2.0;
  const double way_m = (goal_ - position).norm();
  const double brakable = std::sqrt(settings_.vehicle_acceleration_mps2 * way_m);
  return std::min(settings_.max_speed_mps,
                  std::max(kLeast_mps, std::min(brakable, kNear_hz * way_m)));
}

/// The mode, and to rest from where that keeps the limits: a polynomial's end may ask for much.
Candidate Pilot::candidate(const Situation& situation, const Mode& mode) const {
  // A start beyond the limits may be kept to, lest it brakes for a trifle, but nothing more.
  constexpr double kRounding = 1e-9;
  const double speed_mps = std::max(settings_.max_speed_mps * (1.0 + kSpeedTolerance),
                                    situation.start.velocity.norm() + kRounding);
  const double acceleration_mps2 = std::max(settings_.vehicle_acceleration_mps2,
                                            situation.start.acceleration.norm() + kRounding);
  const auto is_within = [&](const Quintic& curve) {
    const Demand demand = demand_of(curve);
    return curve.coefficients.allFinite() && demand.speed_mps <= speed_mps &&
           demand.acceleration_mps2 <= acceleration_mps2 && demand.jerk_mps3 <= kJerk_mps3;
  };
  Candidate found;
  found.cost = double(mode.cost);
  // Of weights that overflow.
  if (!std::isfinite(found.cost)) return found;
  for (const double part : {1.0, 0.9, 0.8, 0.7, 0.55, 0.4}) {
    ModePoints points = mode.points;
    for (auto& point : points) {
      for (float& x : point) x *= static_cast<float>(part);
    }
    found.curve = projected(situation, points);
    if (!is_within(found.curve)) continue;
    for (const double end_s : {2.0, 1.75, 1.5, 1.25, 1.0}) {
      found.end_s = end_s;
      found.stop = planning::stopping(motion_at(found.curve, end_s),
                                      kBraking * settings_.vehicle_acceleration_mps2);
      found.is_flyable = is_within(found.stop);
      if (found.is_flyable) return found;
    }
  }
  return found;
}

/// The best, or of those that are hardly worse the one nearest to what is flown already, so that it
/// does not change its mind with each image.
const Candidate* Pilot::chosen() const {
  double best = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates_) {
    if (c.is_flyable) best = std::min(best, c.cost);
  }
  if (!(best < settings_.brake_cost)) return nullptr;
  const Flown& now = flown_.back();
  const auto off_m = [&](const Candidate& c) {
    if (now.kind != Kind::mode) return c.cost;
    double sum_m = 0.0;
    for (const double time_s : {0.4, 0.8, 1.2, 1.6}) {
      const double then_s = std::min(effect_s_ + time_s - now.start_s, now.motion.duration_s);
      sum_m += (motion_at(c.curve, time_s).position - now.motion.at(then_s).position).norm();
    }
    return sum_m;
  };
  const Candidate* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates_) {
    if (!c.is_flyable || c.cost > best + settings_.keep_cost || c.cost >= settings_.brake_cost) {
      continue;
    }
    if (const double off = off_m(c); off < least) {
      least = off;
      nearest = &c;
    }
  }
  return nearest;
}

void Pilot::think_of(const ab_depth_image& depth, const Motion& start) {
  const Situation situation{.frame = image_frame(depth),
                            .start = start,
                            .goal_world = goal_,
                            .desired_speed_mps = desired_speed_mps(start.position),
                            .lowest_world = lowest_,
                            .highest_world = highest_};
  candidates_.clear();
  for (const Mode& mode : think_(situation, net_image(depth))) {
    candidates_.push_back(candidate(situation, mode));
  }
  if (const Candidate* best = chosen()) {
    execute(Kind::mode, timed(*best));
  } else if (flown_.back().kind == Kind::mode) {
    stop(start);
  }
}

void Pilot::execute(Kind kind, TimedMotion motion) {
  // Of the earlier ones the vehicle still flies those that began before now.
  while (flown_.size() > 1 && flown_[1].start_s < effect_s_ - latency_s_ - kLag_s) {
    flown_.pop_front();
  }
  flown_.push_back({kind, effect_s_, std::move(motion)});
}

void Pilot::stop(const Motion& start) {
  const Quintic curve = planning::stopping(start, kBraking * settings_.vehicle_acceleration_mps2);
  execute(Kind::stop, timed(curve));
}

void Pilot::hover(const Vector3d& place) {
  const Motion rest{place, Vector3d::Zero(), Vector3d::Zero()};
  execute(Kind::hover, timed(planning::quintic_between(rest, rest, 1.0)));
  standing_s_ = effect_s_;
}

/// While it stands: toward the goal, then left and right of that, ever farther.
std::optional<double> Pilot::facing_rad(const Vector3d& place) const {
  if (flown_.back().kind == Kind::mode) return std::nullopt;
  constexpr double kLeastWay_m = 0.1;
  const Vector3d way = goal_ - place;
  if (way.head<2>().norm() < kLeastWay_m) return std::nullopt;
  double aside_rad = 0.0;
  if (flown_.back().kind == Kind::hover) {
    constexpr int kDirections = 7;  // 0, +1, -1, +2, -2, +3, -3 times scan_rad
    const int count = static_cast<int>((effect_s_ - standing_s_) / settings_.scan_s) % kDirections;
    const int steps = (count + 1) / 2;
    aside_rad = settings_.scan_rad * steps * (count % 2 == 1 ? 1.0 : -1.0);
  }
  return portable::atan2(way.y(), way.x()) + aside_rad;
}

const std::vector<ab_point>& Pilot::plan(const Seen& seen) {
  effect_s_ = seen.time_s + latency_s_;
  planning::Heading heading{start_yaw_rad_, 0.0};
  if (is_first_) {
    is_first_ = false;
    hover(seen.position_world);
  } else {
    heading = planning::heading_at(points_, effect_s_ - points_s_);
  }
  const Motion start = next_start(seen);
  const Flown& now = flown_.back();
  if (now.kind != Kind::hover && effect_s_ - now.start_s >= now.motion.duration_s) {
    hover(start.position);
  }
  if (seen.depth != nullptr) think_of(*seen.depth, start);
  planning::LookAhead look;
  look.look_ahead_s = settings_.look_ahead_s;
  look.limits = settings_.heading;
  const bool is_standing = flown_.back().kind == Kind::hover;
  const double from_s = is_standing ? 0.0 : effect_s_ - flown_.back().start_s;
  points_ = trajectory_points(flown_.back().motion, from_s, kPointStep_s, heading, look,
                              facing_rad(start.position));
  points_s_ = effect_s_;
  return points_;
}

}  // namespace agile
