#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "statistics/limit_curve.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// A sweep that looks for the value of a field at which success crosses a rate, `avoidbench limit`:
/// one of the sweep's axes, or a parameter of all its planners, has the values; of their trials
/// those are flown that tell most of where it crosses.
struct LimitRule {
  /// Of the trials as Database::read_sweep() knows it: "map.poisson_radius_m",
  /// "planner.max_speed_mps", "wind.mean_world_mps.0". Empty: no such sweep.
  std::string field;
  std::string unit;            ///< for people: "m/s"
  std::vector<double> values;  ///< equally spaced, rising; at least two
  double success_rate = 0.9;
  /// A mission counts as a success with this goal velocity (d_min / T) or more; 0: however slowly
  /// the goal is reached. The limit is then where v90 is this speed.
  double reach_mps = 0.0;
  double width = 0.0;  ///< of the 95 % interval that is narrow enough, in units of the field
  std::int64_t most_trials = 400;  ///< of a planner
  /// All planners fly what one of them needs, so that they are compared on the same missions.
  bool is_paired = false;
  /// Whether success falls or rises with the field, where that is known beforehand.
  LimitDirection direction = LimitDirection::unknown;

  bool is_success(Outcome outcome, double goal_velocity_mps) const {
    return outcome == Outcome::reached_goal && goal_velocity_mps >= reach_mps;
  }
  LimitCurve curve() const { return {values.size(), success_rate, direction}; }
  bool is_set() const { return !field.empty(); }
  /// From a position of LimitCurve to the field.
  double value_at(double position) const {
    return values.front() + position * (values.back() - values.front());
  }
  /// `width` as a share of the range.
  double relative_width() const { return width / (values.back() - values.front()); }
};

/// What a field begins with that is a parameter of all planners.
inline constexpr std::string_view kOfPlanner = "planner.";

nlohmann::json to_json(const LimitRule& rule);

/// The rule in a sweep's stored spec; nothing where it has none. Throws InputError for one that is
/// none.
std::optional<LimitRule> limit_rule_of(const std::string& spec_json);

/// Which of the rule's values this one is, or nothing.
std::optional<std::size_t> level_of(const LimitRule& rule, double value);

/// A planner's label without the rule's field: "ego" of "ego[max_speed_mps=3]".
std::string label_without(const std::string& label, const LimitRule& rule);

/// What makes maps of one place alike, whatever the field's value: the map's spec without the
/// field, and its seed.
std::string map_place(nlohmann::json map_spec, std::uint64_t map_seed, const LimitRule& rule);

}  // namespace avoidbench
