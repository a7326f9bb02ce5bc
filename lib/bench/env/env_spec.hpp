#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/enum_text.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// What a learner steers with.
enum class ActionKind { velocity, acceleration, rates_thrust, trajectory };

template <>
struct EnumText<ActionKind> {
  static constexpr std::pair<ActionKind, std::string_view> entries[] = {
      {ActionKind::velocity, "velocity"},
      {ActionKind::acceleration, "acceleration"},
      {ActionKind::rates_thrust, "rates_thrust"},
      {ActionKind::trajectory, "trajectory"}};
};

/// Axes of velocities, accelerations and trajectories: `world` is ENU; `heading` is level, x where
/// the nose points, y left, z up.
enum class ActionFrame { world, heading };

template <>
struct EnumText<ActionFrame> {
  static constexpr std::pair<ActionFrame, std::string_view> entries[] = {
      {ActionFrame::world, "world"}, {ActionFrame::heading, "heading"}};
};

/// One action is `width` numbers: see actions.hpp.
struct ActionSpec {
  ActionKind kind = ActionKind::velocity;
  ActionFrame frame = ActionFrame::heading;
  std::int64_t points = 10;  ///< of a trajectory, evenly spaced over `horizon_s`
  double horizon_s = 1.0;
};

/// How depth, and ranges of lidars, are written into arrays. Metric: metres; no return is
/// max_range_m. Inverse: min_range_m over that, in [0, 1]. In both 0 is invalid: nearer than
/// min_range_m, or not matched by stereo.
enum class DepthEncoding { metric, inverse };

template <>
struct EnumText<DepthEncoding> {
  static constexpr std::pair<DepthEncoding, std::string_view> entries[] = {
      {DepthEncoding::metric, "metric"}, {DepthEncoding::inverse, "inverse"}};
};

/// A step's reward: what was gained along the mission's reference path, less the time it took, and
/// what an end is worth.
struct RewardSpec {
  double progress_per_m = 1.0;
  double time_per_s = 0.1;  ///< subtracted
  double crash = 10.0;      ///< subtracted when the flight ends collided or out of the map
  double goal = 10.0;       ///< added when the goal is reached
};

/// Which trial of the sweep is flown next in a slot. Random: drawn from (seed, slot, episode)
/// alone. In turn: slot s of N flies the trials s, s + N, s + 2 N, … of the sweep, each once, then
/// begins again: its next round. Trials that can't be flown are passed over. In the rounds 0 of all
/// slots each trial is flown once: a slot without a trial of its own begins with round 1.
enum class EpisodeOrder { random, in_turn };

template <>
struct EnumText<EpisodeOrder> {
  static constexpr std::pair<EpisodeOrder, std::string_view> entries[] = {
      {EpisodeOrder::random, "random"}, {EpisodeOrder::in_turn, "in_turn"}};
};

/// Many flights that a learner steps together.
struct EnvSpec {
  SweepSpec sweep;                ///< whose trials the episodes are; its planners are not looked at
  std::string policy = "policy";  ///< who flies: the planner's label in keys
  std::int64_t slots = 1;
  std::int64_t threads = 1;
  std::uint64_t seed = 1;  ///< of the choice of trials
  EpisodeOrder order = EpisodeOrder::random;
  std::uint32_t needs = 0;   ///< AB_INPUT_DEPTH, _STEREO, _COLOR, _IMU, _POINTS
  bool sees_ranges = false;  ///< of lidars, by `depth`; with AB_INPUT_POINTS
  DepthEncoding depth = DepthEncoding::inverse;
  ActionSpec action;
  RewardSpec reward;
  std::int64_t kept_maps = 16;  ///< in memory, beside those that fly
};

}  // namespace avoidbench
