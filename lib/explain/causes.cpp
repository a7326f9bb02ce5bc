#include "explain/causes.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace avoidbench {
namespace {

constexpr CauseDef kCauses[] = {
    {Cause::moved_into, "what it struck had moved into its way since the planner's last word",
     "obstacle_way_m > 0 and still_clearance_m > 0.02"},
    {Cause::tracking, "the commanded path was clear, the flown one left it",
     "commanded_clearance_m > 0.05 and tracking_error_m > commanded_clearance_m"},
    {Cause::out_of_view, "it came into the field of view too late or never",
     "not in_cone_s <= last_chance_s"},
    {Cause::occluded, "something stood before it until too late",
     "not unoccluded_s <= last_chance_s"},
    {Cause::too_late_for_speed, "it came into range too late for the speed",
     "not in_range_s <= last_chance_s"},
    {Cause::not_sensed, "it was in sight, but what the planner got did not show it in time",
     "not (sensed_s <= last_chance_s and sensed_lately_count >= 3), and not mapped_share >= 0.1"},
    {Cause::sensed_not_mapped, "the images showed it, but the planner's map did not have it",
     "mapped_share < 0.1"},
    {Cause::mapped_not_avoided, "the planner's map had it, and it flew there",
     "mapped_share >= 0.1 and no_plan_share < 0.5"},
    {Cause::sensed_not_avoided,
     "the images showed it, and it flew there; the planner does not say what it knows",
     "no mapped_share and no_plan_share < 0.5"},
    {Cause::no_plan_found, "the planner had seen it and had no plan from then on",
     "no_plan_share >= 0.5"},
    {Cause::blocked_goal, "no place in the goal's circle has room for the body",
     "goal_clearance_m < half of the body's width"},
    {Cause::hover_without_plan, "it stood still for most of the second half", "hover_share >= 0.5"},
    {Cause::trap, "it came no nearer to the goal and returned to where it had been",
     "closest_s < 0.75 end and return_count >= 1"},
    {Cause::slow, "it flew less than the shortest path is long", "flown_m < reference_length_m"},
    {Cause::detour, "it flew more than the shortest path is long", "flown_m >= reference_length_m"},
    {Cause::flew_out, "it was told to leave the map", "commanded_outside_m > -0.3; else tracking"},
    {Cause::gave_up, "the planner gave up", "outcome planner_gave_up"},
    {Cause::planner_failed, "the planner failed, crashed or hung",
     "outcome planner_error, planner_crashed or planner_hung"},
    {Cause::unexplained, "no rule holds", "none of the above"}};

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
