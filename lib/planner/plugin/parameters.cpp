#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {
namespace {

std::string number_text(double value) { return significant_digits(value, 12); }

std::string value_problem(const ParameterDef& def, const ParameterValue& value) {
  if (def.kind == AB_CHOICE) {
    if (std::find(def.choices.begin(), def.choices.end(), value.text) != def.choices.end())
      return "";
    std::string words;
    for (const std::string& word : def.choices) words += (words.empty() ? "" : ", ") + word;
    return "'" + value.text + "' is not one of " + words + did_you_mean(value.text, def.choices);
  }
  if (def.kind == AB_TEXT) return "";
  // Negated, so that NaN is outside.
  if (!(value.number >= def.lowest && value.number <= def.highest)) {
    const std::string unit = def.unit.empty() ? "" : " " + def.unit;
    return number_text(value.number) + " is outside [" + number_text(def.lowest) + ", " +
           number_text(def.highest) + "]" + unit;
  }
  if (def.kind == AB_INTEGER && std::floor(value.number) != value.number) {
    return number_text(value.number) + " is not a whole number";
  }
  return "";
}

}  // namespace

std::vector<std::string> check_parameters(const PlannerDescription& planner,
                                          const ParameterValues& given) {
  std::vector<std::string> names, problems;
  for (const ParameterDef& def : planner.parameters) names.push_back(def.name);
  for (const auto& [name, value] : given) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      problems.push_back(name + ": planner " + planner.name + " has no such parameter" +
                         did_you_mean(name, names));
      continue;
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    const std::string problem = value_problem(planner.parameters[index], value);
    if (!problem.empty()) problems.push_back(name + ": " + problem);
  }
  return problems;
}

std::vector<ParameterValue> resolve_parameters(const PlannerDescription& planner,
                                               const ParameterValues& given) {
  const std::vector<std::string> problems = check_parameters(planner, given);
  // Whoever reads a user's values has checked them: here it would be a fault of ours.
  AB_CHECK(problems.empty(), problems.front());
  ParameterValues all = given;
  // Texts first, since profiles are chosen by them.
  for (const ParameterDef& def : planner.parameters) {
    if (!def.preset_text.empty()) all.try_emplace(def.name, ParameterValue{0.0, def.preset_text});
  }
  for (const ProfileDef& profile : planner.profiles) {  // before the numbers' own defaults
    const auto choice = all.find(profile.choice);
    if (choice == all.end() || choice->second.text != profile.word) continue;
    for (const auto& [name, number] : profile.numbers) {
      all.try_emplace(name, ParameterValue{number, ""});
    }
  }
  std::vector<ParameterValue> values;
  for (const ParameterDef& def : planner.parameters) {
    values.push_back(all.try_emplace(def.name, ParameterValue{def.preset, ""}).first->second);
  }
  return values;
}

}  // namespace avoidbench
