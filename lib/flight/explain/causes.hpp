#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "base/enum_text.hpp"
#include "base/fields.hpp"

namespace avoidbench {

/// Why a trial failed: of collisions, of time-outs, of the rest. docs/explain.md has the order in
/// which the rules are tried.
enum class Cause {
  moved_into,
  tracking,
  blind,
  out_of_view,
  occluded,
  too_late_for_speed,
  not_sensed,
  sensed_not_mapped,
  mapped_not_avoided,
  sensed_not_avoided,
  no_plan_found,
  blocked_goal,
  hover_without_plan,
  commanded_hover,
  trap,
  slow,
  detour,
  flew_out,
  gave_up,
  planner_failed,
  unexplained
};

template <>
struct EnumText<Cause> {
  static constexpr std::pair<Cause, std::string_view> entries[] = {
      {Cause::moved_into, "moved_into"},
      {Cause::tracking, "tracking"},
      {Cause::blind, "blind"},
      {Cause::out_of_view, "out_of_view"},
      {Cause::occluded, "occluded"},
      {Cause::too_late_for_speed, "too_late_for_speed"},
      {Cause::not_sensed, "not_sensed"},
      {Cause::sensed_not_mapped, "sensed_not_mapped"},
      {Cause::mapped_not_avoided, "mapped_not_avoided"},
      {Cause::sensed_not_avoided, "sensed_not_avoided"},
      {Cause::no_plan_found, "no_plan_found"},
      {Cause::blocked_goal, "blocked_goal"},
      {Cause::hover_without_plan, "hover_without_plan"},
      {Cause::commanded_hover, "commanded_hover"},
      {Cause::trap, "trap"},
      {Cause::slow, "slow"},
      {Cause::detour, "detour"},
      {Cause::flew_out, "flew_out"},
      {Cause::gave_up, "gave_up"},
      {Cause::planner_failed, "planner_failed"},
      {Cause::unexplained, "unexplained"}};
};

/// A cause as people are told of it. `rule`: over the names of Facts, as docs/explain.md has it.
struct CauseDef {
  Cause cause;
  std::string_view doc, rule;
};

/// One a Cause, in their order.
std::span<const CauseDef> cause_table();

/// A stored explanation is told anew where the rules have changed since.
inline constexpr int kCauseRulesVersion = 5;

/// What was measured of a failed flight; NaN where it has no meaning for this one, or never was.
/// Times are of the flight. "Patch": the surface within 0.25 m of where the body touched it.
/// "Last chance": the last moment at which reaction and braking would have fitted into the way that
/// was left to the contact.
struct Facts {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  // Of a collision.
  double contact_s = kNone, contact_speed_mps = kNone;
  double reaction_s = kNone;
  double last_chance_s = kNone, last_chance_speed_mps = kNone, last_chance_way_m = kNone,
         last_chance_need_m = kNone;
  double in_cone_s = kNone, unoccluded_s = kNone, in_range_s = kNone, sensed_s = kNone,
         mapped_s = kNone;
  double seen_way_m = kNone, seen_need_m = kNone;
  double sight_input_count = kNone;
  double depth_image_count = kNone, sweep_count = kNone;
  double sensed_image_count = kNone, longest_gap_s = kNone;
  double lately_s = kNone, sensed_lately_count = kNone;
  double mapped_share = kNone;
  double no_plan_share = kNone;
  double tracking_error_m = kNone, commanded_clearance_m = kNone;
  double wind_mps = kNone;
  double obstacle_way_m = kNone, still_clearance_m = kNone;

  // Of a time-out.
  double flown_m = kNone, reference_length_m = kNone, mean_speed_mps = kNone;
  double closest_m = kNone, closest_s = kNone, progress_s = kNone;
  double hover_share = kNone, late_no_plan_share = kNone;
  double return_count = kNone;
  double goal_clearance_m = kNone;

  // Of a flight that left the map.
  double commanded_outside_m = kNone;
};

template <class Visitor, ConstOr<Facts> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("contact_s", s.contact_s, "Time of the contact that ended the flight, s.");
  v.field("contact_speed_mps", s.contact_speed_mps, "Speed at the contact, m/s.");
  v.field("reaction_s", s.reaction_s,
          "From light to command: delay of images, plan period and latency, s.");
  v.field("last_chance_s", s.last_chance_s,
          "Last time at which the way left was enough to react and brake, s.");
  v.field("last_chance_speed_mps", s.last_chance_speed_mps, "Speed then, m/s.");
  v.field("last_chance_way_m", s.last_chance_way_m,
          "Way left then to the contact, along the flown path, m.");
  v.field("last_chance_need_m", s.last_chance_need_m,
          "Way that reacting and braking needed then, m.");
  v.field("in_cone_s", s.in_cone_s,
          "Time from which the patch was in the field of view of three exposures; if it was within "
          "the camera's distance by the last chance, only those exposures count, s.");
  v.field("unoccluded_s", s.unoccluded_s, "The same, with nothing in front of it, s.");
  v.field("in_range_s", s.in_range_s, "The same, and within the camera's range, s.");
  v.field("sensed_s", s.sensed_s,
          "Time from which three images that the planner got showed it at its depth, s.");
  v.field("mapped_s", s.mapped_s, "Time from which the planner's map had it as occupied, s.");
  v.field("seen_way_m", s.seen_way_m, "Way left to the contact at in_range_s, m.");
  v.field("seen_need_m", s.seen_need_m, "Way that reacting and braking needed then, m.");
  v.field(
      "sight_input_count", s.sight_input_count,
      "Inputs that the planner declares and that can show an obstacle: depth, pictures, points, "
      "tracks, the map.");
  v.field("depth_image_count", s.depth_image_count,
          "Depth images and sweeps of lidars that the planner was shown.");
  v.field("sweep_count", s.sweep_count, "The sweeps among them.");
  v.field("sensed_image_count", s.sensed_image_count, "Those that showed it at its depth.");
  v.field("longest_gap_s", s.longest_gap_s, "Longest time between two of these, s.");
  v.field("lately_s", s.lately_s,
          "When the last 15 exposures began that had it in range by the last chance, s.");
  v.field("sensed_lately_count", s.sensed_lately_count,
          "Images from then to the last chance that showed it at its depth.");
  v.field("mapped_share", s.mapped_share,
          "Share of the patch that the planner's map had as occupied at the last chance.");
  v.field("no_plan_share", s.no_plan_share,
          "Share of calls without a plan from the last chance on.");
  v.field("tracking_error_m", s.tracking_error_m,
          "From the commanded place to the vehicle at the contact, m.");
  v.field("commanded_clearance_m", s.commanded_clearance_m,
          "Least clearance of the body on the commanded path, in the last two seconds, m.");
  v.field("wind_mps", s.wind_mps, "Speed of the air at the contact, m/s.");
  v.field("obstacle_way_m", s.obstacle_way_m,
          "How far the obstacle had moved since the call whose command was flown, m.");
  v.field("still_clearance_m", s.still_clearance_m,
          "Least clearance of the body from there on, had the obstacle stood still, m.");
  v.field("flown_m", s.flown_m, "Length of the flown path, m.");
  v.field("reference_length_m", s.reference_length_m, "Length of the shortest path, m.");
  v.field("mean_speed_mps", s.mean_speed_mps, "Flown length over time, m/s.");
  v.field("closest_m", s.closest_m, "Least horizontal distance to the goal's centre, m.");
  v.field("closest_s", s.closest_s, "When it was first that near, s.");
  v.field("progress_s", s.progress_s, "When it was first within 0.5 m of closest_m, s.");
  v.field("hover_share", s.hover_share, "Share of the flight's second half below 0.1 m/s.");
  v.field("late_no_plan_share", s.late_no_plan_share,
          "Share of calls without a plan in the flight's second half.");
  v.field("return_count", s.return_count,
          "How often it came back to within 1 m of where it had been more than 2 m away from "
          "since.");
  v.field("goal_clearance_m", s.goal_clearance_m,
          "Greatest distance to a surface within the goal's circle, m.");
  v.field(
      "commanded_outside_m", s.commanded_outside_m,
      "How far outside the map the vehicle was commanded to be at the end; inside: negative, m.");
}

/// As stored: those that have a value, by name.
std::string facts_json(const Facts& facts);
/// Throws std::exception where the text is no JSON object of numbers.
Facts facts_from_json(const std::string& text);

struct CauseFound {
  Cause cause = Cause::unexplained;
  Facts facts;
};

/// The rules of cause_table(), in the order in which they are tried. A fact that is NaN makes no
/// rule true.
/// Of a collision. `is_watched`: the facts hold what the planner was shown and knew.
Cause collision_cause(const Facts& facts, bool is_watched);
/// Of a time-out at `end_s`. `body_width_m`: the greater horizontal size.
Cause timeout_cause(const Facts& facts, double end_s, double body_width_m);
/// Of a flight that left the map.
Cause leaving_cause(const Facts& facts);

}  // namespace avoidbench
