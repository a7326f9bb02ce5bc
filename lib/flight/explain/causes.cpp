#include "explain/causes.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "explain/sight.hpp"

namespace avoidbench {
namespace {

constexpr CauseDef kCauses[] = {
    {Cause::moved_into, "the obstacle had moved into its way since the planner's last command",
     "obstacle_way_m > 0 and still_clearance_m > 0.02"},
    {Cause::tracking, "the commanded path was clear, but the vehicle left it",
     "commanded_clearance_m > 0.05 and tracking_error_m > commanded_clearance_m"},
    {Cause::blind, "the planner takes no input that could show it", "sight_input_count = 0"},
    {Cause::out_of_view, "the obstacle came into the field of view too late or never",
     "not in_cone_s <= last_chance_s"},
    {Cause::occluded, "something hid it until too late", "not unoccluded_s <= last_chance_s"},
    {Cause::too_late_for_speed, "it came into range too late for the speed",
     "not in_range_s <= last_chance_s"},
    {Cause::not_sensed,
     "it was in view, but the planner's images and sweeps did not show it in time",
     "not (sensed_s <= last_chance_s and sensed_lately_count >= 3), and not mapped_share >= 0.1"},
    {Cause::sensed_not_mapped, "the images showed it, but the planner's map did not have it",
     "mapped_share < 0.1"},
    {Cause::mapped_not_avoided, "the planner's map had it, but it flew there",
     "mapped_share >= 0.1 and no_plan_share < 0.5"},
    {Cause::sensed_not_avoided,
     "the images showed it, but it flew there; the planner does not report its map",
     "no mapped_share and no_plan_share < 0.5"},
    {Cause::no_plan_found, "the planner had seen it and had no plan from then on",
     "no_plan_share >= 0.5"},
    {Cause::blocked_goal, "the body does not fit anywhere in the goal's circle",
     "goal_clearance_m < half of the body's width"},
    {Cause::hover_without_plan, "it stood still for most of the second half, mostly without a plan",
     "hover_share >= 0.5 and late_no_plan_share >= 0.5"},
    {Cause::commanded_hover,
     "it stood still for most of the second half, though the planner gave commands",
     "hover_share >= 0.5 and late_no_plan_share < 0.5"},
    {Cause::trap, "it came no nearer to the goal and returned to where it had been",
     "progress_s < 0.75 end and return_count >= 1"},
    {Cause::slow, "it flew less than the shortest path is long", "flown_m < reference_length_m"},
    {Cause::detour, "it flew more than the shortest path is long", "flown_m >= reference_length_m"},
    {Cause::flew_out, "it was commanded to leave the map",
     "commanded_outside_m > -0.3; else tracking"},
    {Cause::gave_up, "the planner gave up", "outcome planner_gave_up"},
    {Cause::planner_failed, "the planner failed, crashed or hung",
     "outcome planner_error, planner_crashed or planner_hung"},
    {Cause::unexplained, "no rule holds", "none of the above"}};

/// Below this a clearance is none: bodies are boxes of float triangles.
constexpr double kClear_m = 0.02;
/// Below this a commanded path is not called clear: who plans to pass by so little is hit by any
/// error of tracking.
constexpr double kClearPath_m = 0.05;
/// The vehicle is a little before or behind what it follows.
constexpr double kNearBorder_m = 0.3;
constexpr double kNoProgressFrom = 0.75;  ///< of a time-out's flight
constexpr double kMostly = 0.5;

/// What the planner had been shown, knew and did.
Cause cause_of_planner(const Facts& facts) {
  // A planner that says it knew has sensed it. "Never" is late, and so is what was shown from far
  // off only, where the depth of what stands behind is about the same.
  const bool is_sensed = facts.sensed_s <= facts.last_chance_s &&
                         facts.sensed_lately_count >= static_cast<double>(kEnoughImages);
  if (!is_sensed && !(facts.mapped_share >= kEnoughOfPatch)) return Cause::not_sensed;
  if (facts.mapped_share < kEnoughOfPatch) return Cause::sensed_not_mapped;
  if (facts.no_plan_share >= kMostly) return Cause::no_plan_found;
  return std::isnan(facts.mapped_share) ? Cause::sensed_not_avoided : Cause::mapped_not_avoided;
}

struct FactWriter {
  nlohmann::json& json;
  void field(std::string_view name, double value, std::string_view) {
    if (std::isfinite(value)) json[std::string(name)] = value;
  }
};

struct FactReader {
  const nlohmann::json& json;
  void field(std::string_view name, double& value, std::string_view) {
    const auto found = json.find(name);
    if (found != json.end()) value = found->get<double>();
  }
};

}  // namespace

std::span<const CauseDef> cause_table() { return kCauses; }

Cause collision_cause(const Facts& facts, bool is_watched) {
  const auto in_time = [&](double time_s) { return time_s <= facts.last_chance_s; };
  if (facts.obstacle_way_m > 0.0 && facts.still_clearance_m > kClear_m) return Cause::moved_into;
  if (facts.commanded_clearance_m > kClearPath_m &&
      facts.tracking_error_m > facts.commanded_clearance_m) {
    return Cause::tracking;
  }
  if (facts.sight_input_count == 0.0) return Cause::blind;
  if (!in_time(facts.in_cone_s)) return Cause::out_of_view;
  if (!in_time(facts.unoccluded_s)) return Cause::occluded;
  if (!in_time(facts.in_range_s)) return Cause::too_late_for_speed;
  return is_watched ? cause_of_planner(facts) : Cause::unexplained;
}

Cause timeout_cause(const Facts& facts, double end_s, double body_width_m) {
  if (facts.goal_clearance_m < 0.5 * body_width_m) return Cause::blocked_goal;
  if (facts.hover_share >= kMostly) {
    return facts.late_no_plan_share >= kMostly ? Cause::hover_without_plan : Cause::commanded_hover;
  }
  if (facts.progress_s < kNoProgressFrom * end_s && facts.return_count >= 1.0) return Cause::trap;
  if (facts.flown_m < facts.reference_length_m) return Cause::slow;
  return facts.flown_m >= facts.reference_length_m ? Cause::detour : Cause::unexplained;
}

Cause leaving_cause(const Facts& facts) {
  // Rates command no place: there is nobody else who could have meant it.
  const bool was_meant =
      std::isnan(facts.commanded_outside_m) || facts.commanded_outside_m > -kNearBorder_m;
  return was_meant ? Cause::flew_out : Cause::tracking;
}

std::string facts_json(const Facts& facts) {
  nlohmann::json json = nlohmann::json::object();
  FactWriter writer{json};
  visit(writer, facts);
  return json.dump();
}

Facts facts_from_json(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  Facts facts;
  FactReader reader{json};
  visit(reader, facts);
  return facts;
}

}  // namespace avoidbench
