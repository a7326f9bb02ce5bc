#include "flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"
#include "emergency_stop.hpp"
#include "optimizer.hpp"

namespace ego {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;
namespace portable = avoidbench::portable;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPointStep_s = 0.05;
constexpr int kExpansions = 12000;  ///< cells that the searches of one call may expand
constexpr double kRetry_s = 0.1;    ///< between tries where there is no trajectory to follow
constexpr double kDeadEnd_s = 0.7;  ///< of resting without a plan, before it steps aside
constexpr double kAside_mps = 1.0;  ///< speed of a step aside
constexpr double kLag_s = 0.2;      ///< the vehicle may be so far behind its trajectory

planning::PathSearchSpec search_spec(const Settings& settings) {
  planning::PathSearchSpec spec;
  spec.half_size_cells =
      static_cast<int>(std::ceil(0.5 * settings.horizon_m / settings.grid.resolution_m)) + 15;
  spec.most_expansions = 10000;
  return spec;
}

/// For a plan from this speed: no curve reaches more in a horizon. Planned for more, its points lie
/// too close in time, and it is made slower as a whole.
Settings reachable_from(double speed_mps, const Settings& settings) {
  // Of the greatest acceleration, on the mean: a least-jerk curve begins and ends without any.
  constexpr double kMeanPull = 0.35;
  const double gained = 2.0 * kMeanPull * settings.max_acceleration_mps2 * settings.horizon_m;
  Settings reachable = settings;
  reachable.max_speed_mps =
      std::min(settings.max_speed_mps, std::sqrt(speed_mps * speed_mps + gained));
  return reachable;
}

double braking(const Settings& settings) { return kBraking * settings.vehicle_acceleration_mps2; }

}  // namespace

Flight::Flight(const Settings& settings)
    : settings_(settings),
      surroundings_{planning::RollingGrid(settings.grid),
                    planning::PathSearch(search_spec(settings)), 0.0, 0.0, settings.body_size_m} {}

void Flight::see(const ab_depth_image& image) {
  if (settings_.map_period_s > 0.0) {
    const double tick = std::floor(image.time_s / settings_.map_period_s + 1e-9);
    if (image.camera >= map_ticks_.size()) map_ticks_.resize(image.camera + 1, -kInfinity);
    if (!(tick > map_ticks_[image.camera])) return;
    map_ticks_[image.camera] = tick;
  }
  surroundings_.grid.integrate(planning::without_border(image, settings_.image_border_ratio));
}

void Flight::reset(const ab_mission& mission) {
  line_start_ = avoidbench::as_vector(mission.start_world_m);
  goal_ = avoidbench::as_vector(mission.goal_world_m);
  has_mission_ = planning::is_place(line_start_) && planning::is_place(goal_);
  start_yaw_rad_ = std::isfinite(mission.start_yaw_rad) ? mission.start_yaw_rad : 0.0;
  random_ = planning::Random(mission.seed);
  map_ticks_.clear();
  surroundings_.grid.reset(line_start_);
  double low = line_start_.z(), high = low;
  for (const avoidbench::Vec3& goal : avoidbench::goals_of(mission)) {
    low = std::min(low, goal[2]);
    high = std::max(high, goal[2]);
  }
  surroundings_.lowest_m =
      std::min(std::max(low - settings_.departure_m, settings_.least_height_m), low);
  surroundings_.highest_m =
      std::max(std::min(high + settings_.departure_m, settings_.ceiling_m), high);
  surroundings_.search.use_heights(surroundings_.lowest_m, surroundings_.highest_m);
  is_first_ = true;
  now_ = target_ = {};
  executed_ = {};
  failures_ = 0;
  has_come_out_ = false;
  tried_s_ = -kInfinity;
  candidates_.clear();
  points_.clear();
}

void Flight::fly_to(const avoidbench::CurrentGoal& goal) {
  goal_ = avoidbench::as_vector(goal.place_world_m());
  has_mission_ = has_mission_ && planning::is_place(goal_);
  executed_.ends_at_goal = false;
  if (!goal.is_next()) return;
  line_start_ = now_.position;
  tried_s_ = -kInfinity;
  failures_ = 0;
}

/// Where the trajectory under way stands now; from the vehicle's own motion at first, and where it
/// can't follow.
void Flight::follow(const ab_state& state) {
  now_s_ = state.time_s;
  const Vector3d position = avoidbench::as_vector(state.position_world_m);
  const Vector3d velocity = avoidbench::as_vector(state.velocity_world_mps);
  surroundings_.grid.move_to(position);
  if (is_first_) {
    is_first_ = false;
    now_ = {position, Vector3d::Zero(), Vector3d::Zero()};
    heading_ = {start_yaw_rad_, 0.0};
    hover();
    return;
  }
  heading_ = planning::heading_at(points_, now_s_ - points_s_);
  const double phase_s = std::min(now_s_ - executed_.start_s, executed_.motion.duration_s);
  now_ = executed_.motion.at(phase_s);
  double off_m = (now_.position - position).norm();
  for (double behind_s : {0.25 * kLag_s, 0.5 * kLag_s, kLag_s}) {
    const Motion before = executed_.motion.at(std::max(0.0, phase_s - behind_s));
    off_m = std::min(off_m, (before.position - position).norm());
  }
  if (off_m <= settings_.tracking_error_m) return;
  now_ = {position, velocity, Vector3d::Zero()};
  stop();
}

/// When the trajectory under way is blocked, as far as it is to be flown before the next one.
std::optional<double> Flight::blocked_s(double phase_s) const {
  if (executed_.kind == Kind::hover) return std::nullopt;
  double until_s = executed_.motion.duration_s;
  if (executed_.curve) {
    constexpr double kLeast_s = 1.2;
    until_s = std::max(checked_s(*executed_.curve), std::min(until_s, phase_s + kLeast_s));
  }
  const double step_s = settings_.grid.resolution_m / settings_.max_speed_mps;
  return ego::first_blocked_s(
      surroundings_, [&](double time_s) { return executed_.motion.at(time_s).position; }, phase_s,
      until_s, step_s);
}

bool Flight::is_plan_due(double phase_s, const std::optional<double>& blocked) const {
  const bool is_throttled = now_s_ - tried_s_ < kRetry_s;
  if (executed_.kind == Kind::step_aside) return blocked && !is_throttled;
  if (executed_.kind != Kind::curve) return !is_throttled;
  if (blocked) return failures_ == 0 || !is_throttled;
  if (executed_.ends_at_goal && (goal_ - now_.position).norm() < settings_.keep_distance_m) {
    return false;
  }
  const double way_m = (now_.position - executed_.motion.at(0.0).position).norm();
  const bool is_old = settings_.replan_period_s > 0.0 && phase_s >= settings_.replan_period_s;
  const bool is_over = phase_s >= executed_.curve->duration_s();
  const bool is_wanted = way_m > settings_.replan_distance_m || is_old || is_over;
  return is_wanted && (failures_ == 0 || !is_throttled);
}

bool Flight::replan(double phase_s) {
  tried_s_ = now_s_;
  const Settings settings = reachable_from(now_.velocity.norm(), settings_);
  target_ = local_target(surroundings_, settings, line_start_, goal_, now_.position);
  Request request;
  request.start = now_;
  request.target = target_;
  request.failures = failures_;
  if (executed_.curve && phase_s < executed_.curve->duration_s()) {
    request.previous = &*executed_.curve;
    request.previous_s = phase_s;
  }
  candidates_.clear();
  surroundings_.search.use_budget(kExpansions);
  auto found = plan_trajectory(surroundings_, settings, request, random_, &candidates_);
  if (!found) {
    ++failures_;
    return false;
  }
  failures_ = 0;
  has_come_out_ = false;
  executed_.kind = Kind::curve;
  executed_.curve = std::move(found);
  executed_.start_s = now_s_;
  executed_.ends_at_goal = target_.position == goal_;
  const planning::Bspline& curve = *executed_.curve;
  const planning::TimedMotion motion{[curve](double time_s) {
                                       return Motion{position_at(curve, time_s),
                                                     velocity_at(curve, time_s),
                                                     acceleration_at(curve, time_s)};
                                     },
                                     curve.duration_s()};
  executed_.motion = with_stop(motion, braking(settings_));
  return true;
}

void Flight::execute(Kind kind, const Quintic& quintic) {
  executed_.kind = kind;
  executed_.curve.reset();
  executed_.start_s = now_s_;
  executed_.motion = {[quintic](double time_s) { return motion_at(quintic, time_s); },
                      quintic.duration_s};
  resting_since_s_ = now_s_ + quintic.duration_s;
}

void Flight::stop() { execute(Kind::stop, emergency_stop(surroundings_, settings_, now_)); }

void Flight::hover() {
  const Motion rest{now_.position, Vector3d::Zero(), Vector3d::Zero()};
  execute(Kind::hover, quintic_between(rest, rest, 1.0));
  resting_since_s_ = now_s_;
}

/// From rest to a free place near by: out of an obstacle's reach, or to another point of view. Both
/// in turn, since what a stereo matcher makes up goes along with the camera.
void Flight::leave_dead_end() {
  constexpr double kReach_m = 2.0;  // a stop may have ended so far below the least height
  const bool is_blocked = surroundings_.is_blocked(now_.position);
  const auto out_of_reach = [&] {
    return nearest_free(surroundings_, now_.position, kReach_m, Reach::straight);
  };
  std::optional<Vector3d> place;
  if (is_blocked && !has_come_out_) place = out_of_reach();
  has_come_out_ = place.has_value();
  constexpr int kTries = 60;
  for (int i = 0; i < kTries && !place; ++i) {
    const double azimuth = random_.uniform(-portable::kPi, portable::kPi);
    const double distance_m = random_.uniform(0.8, 3.0);
    const Vector3d tried =
        now_.position + distance_m * Vector3d(portable::cos(azimuth), portable::sin(azimuth), 0.0);
    const auto at = [&](double part) {
      return Vector3d(now_.position + part * (tried - now_.position));
    };
    constexpr double kStep = 0.02;
    const bool is_known =
        surroundings_.grid.state(surroundings_.grid.cell_of(tried)) != planning::CellState::unknown;
    if (is_known && !ego::first_blocked_s(surroundings_, at, 0.0, 1.0, kStep)) place = tried;
  }
  if (!place && is_blocked) place = out_of_reach();
  if (!place) return;
  constexpr double kPeak = 1.875;  // of a quintic's speed over its mean
  const double distance_m = (*place - now_.position).norm();
  const double duration_s = std::max(0.6, kPeak * distance_m / kAside_mps);
  execute(Kind::step_aside,
          quintic_between(now_, {*place, Vector3d::Zero(), Vector3d::Zero()}, duration_s));
}

const std::vector<ab_point>& Flight::plan(const ab_state& state) {
  follow(state);
  constexpr double kMargin_m = 0.1;
  surroundings_.grid.clear_box(avoidbench::as_vector(state.position_world_m),
                               settings_.body_size_m + Vector3d::Constant(kMargin_m));
  double phase_s = now_s_ - executed_.start_s;
  if (executed_.kind != Kind::hover && phase_s >= executed_.motion.duration_s) {
    hover();
    phase_s = 0.0;
  }
  const std::optional<double> blocked = blocked_s(phase_s);
  if (is_plan_due(phase_s, blocked) && !replan(phase_s)) {
    const bool is_urgent = blocked && *blocked - phase_s < settings_.emergency_s;
    if (is_urgent && executed_.kind != Kind::stop) {
      stop();
    } else if (executed_.kind == Kind::hover && now_s_ - resting_since_s_ > kDeadEnd_s) {
      leave_dead_end();
    }
  }
  planning::LookAhead look;
  look.look_ahead_s = settings_.look_ahead_s;
  look.limits = settings_.heading;
  std::optional<double> facing;
  if (executed_.kind == Kind::hover || executed_.kind == Kind::stop) {
    const Vector3d way = goal_ - now_.position;
    if (way.head<2>().norm() > look.least_way_m) facing = portable::atan2(way.y(), way.x());
  }
  points_ = trajectory_points(executed_.motion, now_s_ - executed_.start_s, kPointStep_s, heading_,
                              look, facing);
  points_s_ = now_s_;
  return points_;
}

}  // namespace ego
