#include "env/actions.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "plugin/command_check.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPointWidth = 4;  // x, y, z, yaw

Vector3d vector_at(std::span<const double> numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

void put(double (&to)[3], const Vector3d& from) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// Positions, velocities and accelerations at evenly spaced times of a cubic spline.
struct Spline {
  double period_s = 0.0;
  std::vector<Vector3d> position, velocity, acceleration;  ///< the first at time 0
};

/// The cubic spline through `position`, with this velocity at its beginning and no acceleration at
/// its end (Thomas' algorithm on its second derivatives).
Spline make_spline(std::vector<Vector3d> position, const Vector3d& start_velocity,
                   double period_s) {
  // Two at least: the vehicle's own place and the action's first.
  const std::size_t last = position.size() - 1;
  const double h = period_s;
  std::vector<double> above(last + 1, 0.0);  // of the diagonal, after elimination
  std::vector<Vector3d> acceleration(last + 1, Vector3d::Zero());
  // First row, divided by its diagonal: 2 a[0] + a[1] = 6/h ((p[1] - p[0]) / h - v[0]).
  above[0] = 0.5;
  acceleration[0] = ((position[1] - position[0]) / h - start_velocity) * (3.0 / h);
  for (std::size_t i = 1; i < last; ++i) {
    // The rows between: a[i-1] + 4 a[i] + a[i+1] = 6/h² (p[i+1] - 2 p[i] + p[i-1]).
    const Vector3d bend = (position[i + 1] - 2.0 * position[i] + position[i - 1]) * (6.0 / (h * h));
    const double diagonal = 4.0 - above[i - 1];
    above[i] = 1.0 / diagonal;
    acceleration[i] = (bend - acceleration[i - 1]) / diagonal;
  }
  acceleration[last].setZero();
  for (std::size_t i = last; i-- > 0;) acceleration[i] -= above[i] * acceleration[i + 1];
  Spline spline{.period_s = h,
                .position = std::move(position),
                .velocity = {start_velocity},
                .acceleration = std::move(acceleration)};
  // The acceleration is linear in a piece, so the mean of its ends integrates it exactly.
  for (std::size_t i = 1; i <= last; ++i) {
    spline.velocity.push_back(spline.velocity[i - 1] +
                              0.5 * h * (spline.acceleration[i - 1] + spline.acceleration[i]));
  }
  return spline;
}

ab_point point_of(double time_s, const Vector3d& position, const Vector3d& velocity,
                  const Vector3d& acceleration, double yaw_rad, double yaw_rate_radps) {
  ab_point point{};
  point.time_s = time_s;
  put(point.position_world_m, position);
  put(point.velocity_world_mps, velocity);
  put(point.acceleration_world_mps2, acceleration);
  point.yaw_rad = yaw_rad;
  point.yaw_rate_radps = yaw_rate_radps;
  return point;
}

/// The spline `time_s` after its beginning, which is before its end.
ab_point point_at(const Spline& spline, const std::vector<double>& yaw_rad, double time_s) {
  // Rounding may put the end into a piece behind the last one.
  const auto piece =
      std::min(static_cast<std::size_t>(time_s / spline.period_s), spline.position.size() - 2);
  const double h = spline.period_s, t = time_s - static_cast<double>(piece) * h;
  const Vector3d& a0 = spline.acceleration[piece];
  const Vector3d jerk = (spline.acceleration[piece + 1] - a0) / h;
  const double yaw_rate = (yaw_rad[piece + 1] - yaw_rad[piece]) / h;
  return point_of(
      0.0, spline.position[piece] + t * (spline.velocity[piece] + t * (0.5 * a0 + t / 6.0 * jerk)),
      spline.velocity[piece] + t * (a0 + 0.5 * t * jerk), a0 + t * jerk,
      yaw_rad[piece] + t * yaw_rate, yaw_rate);
}

std::vector<ab_point> trajectory_points(const ActionSpec& spec, std::span<const double> action,
                                        const PlannerView& view, const Eigen::Matrix3d& R_world,
                                        double latency_s) {
  // Yaws are not wrapped: an action is a turn from the present yaw, which may pass 180°.
  const Vector3d nose = view.q_world_body * Vector3d::UnitX();
  std::vector<Vector3d> positions{view.position_world};
  std::vector<double> yaws{math::atan2(nose.y(), nose.x())};
  for (std::size_t first = 0; first < action.size(); first += kPointWidth) {
    positions.push_back(view.position_world + R_world * vector_at(action, first));
    yaws.push_back(yaws[0] + action[first + 3]);
  }
  const double period_s = spec.horizon_s / static_cast<double>(spec.points);
  const Spline spline = make_spline(std::move(positions), view.velocity_world, period_s);
  std::vector<ab_point> points;
  // A planner's latency may be longer than the horizon: then the end alone is left, held.
  // A thousandth of a period is left, since a trajectory needs two points.
  const double begin_s = std::min(latency_s, spec.horizon_s - 1e-3 * period_s);
  points.push_back(point_at(spline, yaws, begin_s));
  for (std::size_t i = 1; i < spline.position.size(); ++i) {
    const double time_s = static_cast<double>(i) * period_s - begin_s;
    // That knot is the beginning itself, and times must rise.
    if (time_s <= 1e-6 * period_s) continue;
    points.push_back(point_of(time_s, spline.position[i], spline.velocity[i],
                              spline.acceleration[i], yaws[i], (yaws[i] - yaws[i - 1]) / period_s));
  }
  return points;
}

}  // namespace

std::size_t action_width(const ActionSpec& action) {
  if (action.kind == ActionKind::trajectory) {
    return kPointWidth * static_cast<std::size_t>(action.points);
  }
  return 4;
}

ActionLimits action_limits(const ActionSpec& action, const VehicleSpec& vehicle) {
  std::vector<double> lowest, highest;
  const auto add = [&](double low, double high) {
    lowest.push_back(low);
    highest.push_back(high);
  };
  const double yaw_rate = vehicle.max_yaw_rate_radps;
  switch (action.kind) {
    case ActionKind::velocity:
    case ActionKind::acceleration: {
      const double most = action.kind == ActionKind::velocity ? vehicle.max_speed_mps
                                                              : vehicle.max_acceleration_mps2;
      for (int i = 0; i < 3; ++i) add(-most, most);
      add(-yaw_rate, yaw_rate);
      break;
    }
    case ActionKind::rates_thrust: {
      for (const double rate : vehicle.max_rates_radps) add(-rate, rate);
      const VehicleModel model = make_model(vehicle);
      // All rotors at full thrust; per kilogram, as thrust_mps2 of a command is.
      add(0.0, model.max_rotor_thrust_n * model.rotor_count * model.inverse_mass);
      break;
    }
    case ActionKind::trajectory: {
      // As far as the vehicle comes in a straight line: what lies beyond can't be flown in time.
      const double farthest_m = vehicle.max_speed_mps * action.horizon_s;
      for (std::int64_t point = 0; point < action.points; ++point) {
        for (int i = 0; i < 3; ++i) add(-farthest_m, farthest_m);
        add(-math::kPi, math::kPi);
      }
      break;
    }
  }
  return {std::move(lowest), std::move(highest)};
}

std::string action_problem(const ActionSpec& spec, std::span<const double> action) {
  // Less than of a command: a trajectory's yaw is added to the vehicle's.
  constexpr double kMostOfYaw = 0.9 * kMostYaw;
  for (std::size_t i = 0; i < action.size(); ++i) {
    const std::string name = "number " + std::to_string(i) + " of the action";
    if (!std::isfinite(action[i])) return name + " is not finite";
    const bool is_yaw = spec.kind != ActionKind::rates_thrust && i % kPointWidth == 3;
    const double most = is_yaw ? kMostOfYaw : kMostOfCommand;
    if (std::abs(action[i]) > most) {
      return name + " is " + significant_digits(action[i], 3) + ", beyond ±" +
             significant_digits(most, 3) + ": the action is out of range";
    }
  }
  return "";
}

PlanResult plan_result(const ActionSpec& spec, std::span<const double> action,
                       const PlannerView& view, double latency_s) {
  AB_CHECK(action.size() == action_width(spec), action.size());
  PlanResult result;
  result.status = PlanStatus::command;
  result.cpu_time_s = result.wall_time_s = math::kNaN;
  const Eigen::Matrix3d R_world = spec.frame == ActionFrame::world
                                      ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                      : rotation_world_heading(view.q_world_body);
  ab_command& command = result.command;
  command.struct_size = sizeof(ab_command);
  switch (spec.kind) {
    case ActionKind::velocity:
      command.kind = AB_COMMAND_VELOCITY;
      put(command.velocity_world_mps, R_world * vector_at(action, 0));
      break;
    case ActionKind::acceleration:
      command.kind = AB_COMMAND_ACCELERATION;
      put(command.acceleration_world_mps2, R_world * vector_at(action, 0));
      break;
    case ActionKind::rates_thrust:
      command.kind = AB_COMMAND_RATES;
      // Of the body, whatever frame the spec names.
      put(command.rates_body_radps, vector_at(action, 0));
      command.thrust_mps2 = action[3];
      return result;
    case ActionKind::trajectory:
      command.kind = AB_COMMAND_TRAJECTORY;
      result.points = trajectory_points(spec, action, view, R_world, latency_s);
      command.point_count = static_cast<std::uint32_t>(result.points.size());
      return result;
  }
  // Of velocities and accelerations: a rate, so that a policy that gives 0 keeps its heading.
  command.flags = AB_YAW_IS_RATE;
  command.yaw_rate_radps = action[3];
  return result;
}

Eigen::Matrix3d rotation_world_heading(const Eigen::Quaterniond& q_world_body) {
  // Straight up or down has no heading of its own; the left wing's is as good as any.
  constexpr double kSteep = 1e-6;
  Vector3d nose = q_world_body * Vector3d::UnitX();
  nose.z() = 0.0;
  if (nose.squaredNorm() < kSteep) {
    const Vector3d left = q_world_body * Vector3d::UnitY();
    nose = Vector3d(left.y(), -left.x(), 0.0);
  }
  nose.normalize();
  Eigen::Matrix3d R_world_heading;
  R_world_heading.col(0) = nose;
  R_world_heading.col(1) = Vector3d(-nose.y(), nose.x(), 0.0);
  R_world_heading.col(2) = Vector3d::UnitZ();
  return R_world_heading;
}

}  // namespace avoidbench
