#include "real_flights/judged_flight.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "base/number_text.hpp"
#include "geometry/pose.hpp"
#include "trial/collision_check.hpp"
#include "trial/goals.hpp"
#include "trial/periods.hpp"

namespace avoidbench {
namespace {

constexpr double kLeastHeadingSpeed_mps = 0.3;

/// The attitude under which thrust gives this acceleration, with the heading of the velocity.
Eigen::Quaterniond attitude_of(const PathState& state, double gravity_mps2, double yaw_rad) {
  const Eigen::Vector3d thrust = state.acceleration_world + Eigen::Vector3d(0.0, 0.0, gravity_mps2);
  if (thrust.norm() < 0.1 * gravity_mps2) return yaw_rotation(yaw_rad);
  const Eigen::Quaterniond tilt =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), thrust);
  return tilt * yaw_rotation(yaw_rad);
}

/// Where the body is at each moment. Moments must be asked for in order.
class Body {
 public:
  Body(const TrialSpec& spec, const Mission& mission, const RecordedMotion& motion)
      : motion_(&motion),
        gravity_mps2_(spec.vehicle.gravity_mps2),
        yaw_rad_(mission.start_yaw_rad) {}

  PathState state(double time_s) const { return motion_->path.at(time_s); }

  Eigen::Quaterniond attitude(const PathState& state) {
    if (motion_->attitudes.empty()) {
      const Eigen::Vector3d& v = state.velocity_world;
      if (v.head<2>().norm() >= kLeastHeadingSpeed_mps) yaw_rad_ = math::atan2(v.y(), v.x());
      return attitude_of(state, gravity_mps2_, yaw_rad_);
    }
    return logged(state.time_s);
  }

  Eigen::Vector3d rates_radps(double time_s) const {
    if (motion_->attitudes.empty()) return Eigen::Vector3d::Constant(math::kNaN);
    constexpr double kStep_s = 0.02;  // over which the attitude's change is taken
    const Eigen::Quaterniond before = logged(time_s - 0.5 * kStep_s);
    Eigen::Quaterniond turn = before.conjugate() * logged(time_s + 0.5 * kStep_s);
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    return 2.0 / kStep_s * turn.vec();
  }

 private:
  /// The log's, between two of them by proportion: no function of the C library, whose bits differ
  /// between processors.
  Eigen::Quaterniond logged(double time_s) const {
    const std::vector<MeasuredAttitude>& all = motion_->attitudes;
    if (time_s <= all.front().time_s) return all.front().q_world_body;
    if (time_s >= all.back().time_s) return all.back().q_world_body;
    const auto next = std::upper_bound(
        all.begin(), all.end(), time_s,
        [](double time, const MeasuredAttitude& one) { return time < one.time_s; });
    const MeasuredAttitude &a = *(next - 1), &b = *next;
    const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
    const double sign = a.q_world_body.dot(b.q_world_body) < 0.0 ? -1.0 : 1.0;
    return Eigen::Quaterniond((1.0 - share) * a.q_world_body.coeffs() +
                              share * sign * b.q_world_body.coeffs())
        .normalized();
  }

  const RecordedMotion* motion_;
  double gravity_mps2_, yaw_rad_;
};

/// The outcome at a tick by the rules, or nothing.
std::optional<Outcome> ended(const TrialSpec& spec, const Mission& mission, const Scene& scene,
                             CollisionCheck& check, const PathState& state, const Pose& pose,
                             TrialRecord& record) {
  const World& world = scene.world();
  const bool is_judged = spec.recording->outcome == GivenOutcome::judged;
  if (is_judged) {
    if (const auto touched = contact(check, scene, pose)) {
      const std::uint32_t obstacle = world.instances[touched->instance].obstacle;
      const double speed_mps = state.velocity_world.norm();
      record.collisions.push_back({.time_s = state.time_s,
                                   .speed_mps = speed_mps,
                                   .obstacle = obstacle,
                                   .kind = world.obstacles[obstacle].kind});
      record.reason = "its path touches " + world.obstacles[obstacle].kind + ", " +
                      fixed_digits(speed_mps, 2) + " m/s";
      return Outcome::collided;
    }
    if (!world.bounds.contains(state.position_world)) {
      record.reason = "left the map";
      return Outcome::left_bounds;
    }
  }
  const double to_goal_m =
      distance_to_goal_m(spec.mission, mission, 0, state.position_world, state.time_s);
  if (to_goal_m <= spec.mission.goal_radius_m) {
    record.reason = "reached the goal after " + fixed_digits(state.time_s, 2) + " s";
    return Outcome::reached_goal;
  }
  if (state.time_s >= spec.mission.time_limit_s) {
    record.reason = fixed_digits(to_goal_m, 2) + " m from the goal at the time limit";
    return Outcome::timed_out;
  }
  return std::nullopt;
}

Outcome outcome_of(GivenOutcome given) { return *enum_from_text<Outcome>(text(given)); }

/// That the path ended, by the rules or with the log, otherwise than is given.
std::string contradiction(const TrialSpec& spec, std::optional<Outcome> found,
                          const TrialRecord& record, double nearest_m) {
  const GivenOutcome given = spec.recording->outcome;
  if (given == GivenOutcome::judged) return "";
  const bool has_reached = found == Outcome::reached_goal;
  if (given == GivenOutcome::reached_goal && !has_reached) {
    return "is given as reached_goal, but its path comes no nearer to the goal than " +
           fixed_digits(nearest_m, 2) +
           " m within mission.time_limit_s (mission.goal_radius_m is " +
           significant_digits(spec.mission.goal_radius_m, 4) + ")";
  }
  if (given != GivenOutcome::reached_goal && has_reached) {
    return "is given as " + std::string(text(given)) + ", but its path " + record.reason;
  }
  return "";
}

}  // namespace

JudgedFlight judge(const TrialSpec& spec, const Mission& mission, const Scene& scene,
                   const RecordedMotion& motion) {
  const Tick step = required_period(spec.rates.physics_hz);
  const Tick sample_period = required_period(spec.rates.sample_hz);
  const Tick jerk_period =
      required_period(adds_jerk_samples(spec.rates) ? kJerkRate_hz : spec.rates.sample_hz);
  const auto last = static_cast<Tick>(
      std::floor(motion.duration_s * static_cast<double>(kTicksPerSecond) + 1e-6));
  CollisionCheck check{.body_size_m = to_eigen(spec.vehicle.body_size_m)};
  Body body(spec, mission, motion);
  JudgedFlight flight;
  TrialRecord& record = flight.record;
  std::optional<Outcome> outcome;
  double nearest_m = std::numeric_limits<double>::infinity();
  const auto next = [&](Tick now) {
    const auto after = [now](Tick period) { return (now / period + 1) * period; };
    return std::min({after(step), after(sample_period), after(jerk_period), last});
  };
  for (Tick now = 0;; now = next(now)) {
    const PathState state = body.state(seconds(now));
    const Eigen::Quaterniond q = body.attitude(state);
    const Pose pose = make_pose(state.position_world, q);
    nearest_m = std::min(nearest_m, distance_to_goal_m(spec.mission, mission, 0,
                                                       state.position_world, state.time_s));
    outcome = ended(spec, mission, scene, check, state, pose, record);
    const bool is_end = outcome || now >= last;
    if (is_end || now % sample_period == 0 || now % jerk_period == 0) {
      record.samples.push_back(
          {.time_s = state.time_s,
           .position_world = state.position_world,
           .velocity_world = state.velocity_world,
           .acceleration_world = state.acceleration_world,
           .q_world_body = q,
           .rates_body_radps = body.rates_radps(state.time_s),
           .clearance_m = body_clearance(check, scene, pose, kClearanceLimit_m),
           .rotor_power_w = math::kNaN});
    }
    if (is_end) break;
  }
  record.end_time_s = record.samples.back().time_s;
  flight.problem = contradiction(spec, outcome, record, nearest_m);
  const GivenOutcome given = spec.recording->outcome;
  if (given != GivenOutcome::judged && given != GivenOutcome::reached_goal) {
    record.outcome = outcome_of(given);
    record.reason =
        "given; the log ends " + fixed_digits(nearest_m, 2) + " m from the goal at best";
    if (given == GivenOutcome::collided) {
      record.collisions.push_back({.time_s = record.end_time_s,
                                   .speed_mps = record.samples.back().velocity_world.norm(),
                                   .obstacle = -1,
                                   .kind = "not recorded"});
    }
  } else if (outcome) {
    record.outcome = *outcome;
  } else {
    record.outcome = Outcome::timed_out;
    record.reason = "the log ends after " + fixed_digits(record.end_time_s, 2) + " s, " +
                    fixed_digits(nearest_m, 2) + " m from the goal at best";
  }
  return flight;
}

}  // namespace avoidbench
