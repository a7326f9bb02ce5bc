#include "control/reference_governor.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// Jerk per acceleration error, 1/s.
constexpr double kAccelerationLoop = 50.0;

Vector3d with_norm_at_most(const Vector3d& v, double most) {
  const double norm = v.norm();
  return norm > most ? Vector3d(v * (most / norm)) : v;
}

/// The acceleration that closes in on a velocity `error` away so that it falls to zero at constant
/// jerk, then in proportion.
double closing_acceleration(const VehicleModel& model, double error) {
  const double gain = model.acceleration_gain, jerk = model.acceleration_jerk;
  // Where the root's slope equals the gain: both value and slope go on without a step.
  const double root_from = jerk / (gain * gain);
  const double value =
      // As for speed over distance: proportional, then a root.
      error < root_from ? gain * error : std::sqrt(2.0 * jerk * (error - 0.5 * root_from));
  return std::min(value, model.spec.max_acceleration_mps2);
}

/// The velocity error at which closing_acceleration() is `acceleration`.
/// The inverse of closing_acceleration(), part by part.
double closing_error(const VehicleModel& model, double acceleration) {
  const double gain = model.acceleration_gain, jerk = model.acceleration_jerk;
  if (acceleration < jerk / gain) return acceleration / gain;
  return 0.5 * acceleration * acceleration / jerk + 0.5 * jerk / (gain * gain);
}

struct WantedVelocity {
  Vector3d velocity, change;  ///< its time derivative as the reference moves
};

WantedVelocity wanted_velocity(const VehicleModel& model, const Reference& reference,
                               const GovernorTarget& target) {
  const double max_speed = model.spec.max_speed_mps;
  const Vector3d& v = reference.velocity_world;
  switch (target.goal) {
    case GovernorGoal::velocity:
      return {with_norm_at_most(target.value_world, max_speed), Vector3d::Zero()};
    case GovernorGoal::acceleration: {
      const Vector3d wanted =
          with_norm_at_most(target.value_world, model.spec.max_acceleration_mps2);
      const double size = wanted.norm();
      if (!(size > 0.0)) return {with_norm_at_most(v, max_speed), Vector3d::Zero()};
      // A velocity ahead by as much as makes the law below ask for this acceleration.
      return {with_norm_at_most(v + (closing_error(model, size) / size) * wanted, max_speed),
              Vector3d::Zero()};
    }
    case GovernorGoal::position:
      break;
  }
  const Vector3d way = target.value_world - reference.position_world;
  const double distance = way.norm();
  // At the goal there is no direction; the slope there is the gain.
  if (!(distance > 0.0)) return {Vector3d::Zero(), -model.speed_curve.gain * v};
  const Speed speed = allowed_speed(model.speed_curve, distance);
  const Vector3d direction = way / distance;
  const double towards = direction.dot(v);
  const double ratio = speed.value / distance;
  // The derivative of the wanted velocity as the reference moves on: fed forward, so that the
  // reference stays on the braking curve instead of lagging it.
  return {speed.value * direction, -ratio * v - ((speed.slope - ratio) * towards) * direction};
}

/// Yaw and yaw rate `dt_s` later.
void govern_yaw(const VehicleModel& model, const GovernorTarget& target, double dt_s,
                Reference& reference) {
  constexpr double kRateLoop = 12.0;
  const double max_rate = model.spec.max_yaw_rate_radps;
  const double rate = reference.yaw_rate_radps;
  double wanted = target.yaw, change = 0.0;
  if (target.yaw_is_rate) {
    wanted = std::min(std::max(wanted, -max_rate), max_rate);
  } else {
    // The shorter way round.
    const double error = math::wrapped_angle(target.yaw - reference.yaw_rad);
    const Speed speed = allowed_speed(model.yaw_curve, std::abs(error));
    wanted = error < 0.0 ? -speed.value : speed.value;
    // The wanted rate falls as the error does: fed forward, as above.
    change = -speed.slope * rate;
  }
  const double most = model.spec.max_yaw_acceleration_radps2;
  const double acceleration = std::min(std::max(kRateLoop * (wanted - rate) + change, -most), most);
  reference.yaw_rad += dt_s * (rate + 0.5 * dt_s * acceleration);
  reference.yaw_rate_radps = rate + dt_s * acceleration;
}

}  // namespace

Speed allowed_speed(const BrakingCurve& curve, double distance) {
  // From the target outwards: proportional, root, cap; the ramp between the last two is below.
  if (distance < curve.root_from) return {curve.gain * distance, curve.gain};
  if (distance < curve.ramp_from) {
    const double speed = std::sqrt(2.0 * curve.deceleration * (distance - 0.5 * curve.root_from));
    return {speed, curve.deceleration / speed};
  }
  if (distance >= curve.cap_from) return {curve.max_speed, 0.0};
  // Time t since the ramp of deceleration began: cap_from - distance = max_speed t - jerk t³/6.
  const double gone = curve.cap_from - distance;
  double t = gone / curve.max_speed;
  // Newton's method from a close start: the cubic term is small where the ramp begins. A fixed
  // number of steps, so that no test of convergence decides.
  for (int i = 0; i < 4; ++i) {
    const double speed = curve.max_speed - 0.5 * curve.jerk * t * t;
    t -= (curve.max_speed * t - curve.jerk * t * t * t / 6.0 - gone) / speed;
  }
  const double speed = curve.max_speed - 0.5 * curve.jerk * t * t;
  return {speed, curve.jerk * t / speed};
}

Reference governed(const VehicleModel& model, const Reference& reference,
                   const GovernorTarget& target, double dt_s) {
  const Vector3d& v = reference.velocity_world;
  const Vector3d& a = reference.acceleration_world;
  const WantedVelocity wanted = wanted_velocity(model, reference, target);
  const Vector3d error = wanted.velocity - v;
  const double size = error.norm();
  Vector3d acceleration = wanted.change;
  if (size > 0.0) acceleration += (closing_acceleration(model, size) / size) * error;
  acceleration = with_norm_at_most(acceleration, model.spec.max_acceleration_mps2);
  // Not faster than one step: a longer step would overshoot the wanted acceleration.
  const double loop = std::min(kAccelerationLoop, 1.0 / dt_s);
  const Vector3d jerk = with_norm_at_most(loop * (acceleration - a), model.spec.max_jerk_mps3);

  Reference next = reference;
  // Exact for a constant jerk: position, velocity and acceleration stay consistent, as controllers
  // that feed them forward need.
  next.position_world += dt_s * (v + (0.5 * dt_s) * (a + (dt_s / 3.0) * jerk));
  next.velocity_world += dt_s * (a + (0.5 * dt_s) * jerk);
  next.acceleration_world += dt_s * jerk;
  next.jerk_world = jerk;
  govern_yaw(model, target, dt_s, next);
  return next;
}

double stopping_distance_m(const VehicleModel& model, double speed_mps) {
  const double up_jerk = model.spec.max_jerk_mps3, down_jerk = model.acceleration_jerk;
  const double most = model.spec.max_acceleration_mps2;
  // Below root_from the deceleration is in proportion to the speed, above it a root of it that is 0
  // at half of that.
  const double gain = model.acceleration_gain;
  const double root_from = down_jerk / (gain * gain), root_zero = 0.5 * root_from;
  // Where the ramp of the jerk meets the law in its proportional part: j t = gain (v - j t²/2).
  const double meets_s = (std::sqrt(1.0 + 2.0 * gain * gain * speed_mps / up_jerk) - 1.0) / gain;
  if (up_jerk * meets_s <= std::min(most, gain * root_from)) {
    const double left_mps = speed_mps - 0.5 * up_jerk * meets_s * meets_s;
    return meets_s * (speed_mps - up_jerk * meets_s * meets_s / 6.0) + left_mps / gain;
  }
  // From 0 to the greatest deceleration and back: speed_mps = a²/2j + root_zero + a²/2j' at the
  // most.
  const double per_square = 0.5 / up_jerk + 0.5 / down_jerk;
  const double a = std::min(most, std::sqrt((speed_mps - root_zero) / per_square));
  const double up_s = a / up_jerk;
  const double way_up = up_s * (speed_mps - up_jerk * up_s * up_s / 6.0);
  const double after_up = speed_mps - 0.5 * a * up_s;
  const double before_down = std::min(after_up, root_zero + 0.5 * a * a / down_jerk);
  const double way_full = 0.5 * (after_up * after_up - before_down * before_down) / a;
  // Down to the deceleration at root_from, or from there where less was needed.
  const double down_s = std::max(0.0, (a - down_jerk / gain) / down_jerk);
  const double way_down = down_s * (before_down - down_s * (0.5 * a - down_jerk * down_s / 6.0));
  return way_up + way_full + way_down + root_from / gain;
}

}  // namespace avoidbench
