#include <algorithm>
#include <cmath>

#include "avoidbench/planner.hpp"
#include "avoidbench/portable_math.hpp"
#include "flight.hpp"

namespace ros_shim {
namespace {

namespace portable = avoidbench::portable;

double seconds(std::int64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

double yaw_of(const ab_state& state) {
  const double* q = state.q_world_body;
  return yaw_of_quaternion(q[1], q[2], q[3], q[0]);
}

/// The motion `after_s` later at a constant acceleration.
ab_point point_after(const SetPoint& from, double after_s) {
  ab_point point{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = from.velocity_mps[i], a = from.acceleration_mps2[i];
    point.position_world_m[i] = from.position_m[i] + (v + 0.5 * a * after_s) * after_s;
    point.velocity_world_mps[i] = v + a * after_s;
    point.acceleration_world_mps2[i] = a;
    point.jerk_world_mps3[i] = from.jerk_mps3[i];
  }
  point.yaw_rad = from.yaw_rad + from.yaw_rate_radps * after_s;
  point.yaw_rate_radps = from.yaw_rate_radps;
  return point;
}

/// Yaws go on from one point to the next without a turn of 360°.
void unwind_yaws(std::vector<ab_point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double before = points[i - 1].yaw_rad;
    points[i].yaw_rad = before + portable::wrapped_angle(points[i].yaw_rad - before);
  }
}

}  // namespace

double yaw_of_quaternion(double x, double y, double z, double w) {
  return portable::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
}

Commands::Commands(const CommandForm& form, const ab_setup& setup, const ab_mission& mission,
                   double max_speed_mps)
    : form_(form),
      plan_period_s_(setup.plan_period_s),
      gravity_mps2_(setup.gravity_mps2),
      far_m_(2.0 + max_speed_mps),
      start_world_m_{mission.start_world_m[0], mission.start_world_m[1], mission.start_world_m[2]} {
}

void Commands::take(SetPoints points) {
  if (points.empty()) return;
  if (form_.body_velocity) {
    for (SetPoint& point : points) point.in_heading_frame = true;
  }
  if (now_ns() < kStart_ns) warn_of_early(points.front());
  last_ = std::move(points);
}

/// A planner that begins by itself within lead_s is ahead of the vehicle at the trial's time 0.
void Commands::warn_of_early(const SetPoint& point) {
  // To hover where the vehicle is does no harm.
  const bool moves = (point.has_position && distance(point.position_m, start_world_m_) > 0.1) ||
                     (point.has_velocity && distance(point.velocity_mps, {}) > 0.05);
  if (has_warned_of_early_ || !moves) return;
  has_warned_of_early_ = true;
  log(Level::warning,
      formatted("a command to move came on %s %.2f s before the trial's time 0, when the vehicle "
                "does not fly yet: does the planner start by itself within lead_s?",
                form_.topic.c_str(), seconds(kStart_ns - now_ns())));
}

/// Farther than a vehicle that follows its set points lags behind.
void Commands::warn_of_far(const ab_command& command, const ab_state& state) {
  const double* place = command.position_world_m;
  if (command.kind == AB_COMMAND_TRAJECTORY) {
    place = command.points[0].position_world_m;
  } else if (command.kind != AB_COMMAND_POSITION) {
    return;
  }
  const double* at = state.position_world_m;
  const double away_m = distance({place[0], place[1], place[2]}, {at[0], at[1], at[2]});
  if (has_warned_of_far_ || !(away_m > far_m_)) return;
  has_warned_of_far_ = true;
  log(Level::warning, formatted("the set point is %.1f m from the vehicle (topic %s): does the "
                                "planner start before the trial's time 0 (lead_s)?",
                                away_m, form_.topic.c_str()));
}

std::optional<ab_command> Commands::answer(std::int64_t now_ns, const ab_state& state) {
  if (last_.empty()) return std::nullopt;
  if (seconds(now_ns - last_.back().time_ns) > form_.stale_s) return std::nullopt;
  const ab_command command =
      last_.size() == 1 ? of_one(last_[0], now_ns, state) : of_many(last_, now_ns);
  warn_of_far(command, state);
  return command;
}

ab_command Commands::of_one(const SetPoint& point, std::int64_t now_ns, const ab_state& state) {
  const double age_s = std::max(0.0, seconds(now_ns - point.time_ns));
  if (point.has_rates) {
    if (!(form_.hover_thrust > 0.0)) {
      throw std::runtime_error("thrust is commanded, and the topics file has no hover_thrust");
    }
    return avoidbench::make_rates_command(point.rates_body_radps,
                                          point.thrust / form_.hover_thrust * gravity_mps2_);
  }
  if (point.has_position && point.has_velocity) {
    // Two plan periods of it: the next answer comes after one.
    points_.assign(2, point_after(point, age_s));
    points_[1] = point_after(point, age_s + 2.0 * plan_period_s_);
    points_[1].time_s = 2.0 * plan_period_s_;
    unwind_yaws(points_);
    return avoidbench::make_trajectory_command(points_);
  }
  ab_command command{};
  const double yaw_rad = yaw_of(state);
  if (point.has_position) {
    command = avoidbench::make_position_command(point.position_m, point.yaw_rad);
    if (!point.has_yaw) command.yaw_rad = yaw_rad;
    return command;
  }
  if (point.has_velocity) {
    avoidbench::Vec3 velocity = point.velocity_mps;
    if (point.in_heading_frame) {
      const double c = portable::cos(yaw_rad), s = portable::sin(yaw_rad);
      velocity = {c * velocity[0] - s * velocity[1], s * velocity[0] + c * velocity[1],
                  velocity[2]};
    }
    command = avoidbench::make_velocity_command(velocity, point.yaw_rad);
  } else if (point.has_acceleration) {
    command = avoidbench::make_acceleration_command(point.acceleration_mps2, point.yaw_rad);
  } else {
    throw std::runtime_error("a command that says neither where nor how fast");
  }
  if (!point.has_yaw) {
    command.flags = AB_YAW_IS_RATE;
    command.yaw_rate_radps = point.has_yaw_rate ? point.yaw_rate_radps : 0.0;
  }
  return command;
}

ab_command Commands::of_many(const SetPoints& points, std::int64_t now_ns) {
  constexpr double kStep_s = 0.05;
  points_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].has_position) throw std::runtime_error("a trajectory without positions");
    const double after_s = seconds(points[i].time_ns - now_ns);
    const bool is_last_before = i + 1 == points.size() || points[i + 1].time_ns > now_ns;
    if (after_s <= 0.0) {
      // The one that holds now, brought to now.
      if (is_last_before) points_.push_back(point_after(points[i], -after_s));
      continue;
    }
    // A trajectory that begins later: its beginning holds until then.
    if (points_.empty()) points_.push_back(point_after(points[i], 0.0));
    const bool is_last = i + 1 == points.size();
    if (!is_last && after_s < points_.back().time_s + kStep_s - 1e-9) continue;
    points_.push_back(point_after(points[i], 0.0));
    points_.back().time_s = after_s;
  }
  if (points_.size() < 2) {
    points_.resize(2, points_.front());
    for (std::size_t i = 0; i < 3; ++i) {
      points_[1].velocity_world_mps[i] = points_[1].acceleration_world_mps2[i] = 0.0;
    }
    points_[1].time_s = 2.0 * plan_period_s_;
  }
  unwind_yaws(points_);
  return avoidbench::make_trajectory_command(points_);
}

}  // namespace ros_shim
