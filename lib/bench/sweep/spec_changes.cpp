#include "sweep/spec_changes.hpp"

#include <map>
#include <nlohmann/json.hpp>

namespace avoidbench {
namespace {

using nlohmann::json;
using Values = std::map<std::string, std::string>;  ///< path, value as JSON

/// Lists are values as a whole: their elements have no names to compare by.
void add_leaves(const json& value, const std::string& path, Values& values) {
  if (!value.is_object()) {
    values[path] = value.dump();
    return;
  }
  for (const auto& [key, part] : value.items()) {
    add_leaves(part, path.empty() ? key : path + "." + key, values);
  }
}

/// All that the sweep says except its planners. An axis stands in the place of its base value.
Values values_of(const json& sweep) {
  Values values;
  add_leaves(sweep.value("base", json::object()), "", values);
  for (const json& axis : sweep.value("axes", json::array())) {
    values[axis.value("path", "")] = axis.value("values", json::array()).dump();
  }
  add_leaves(sweep.value("limit", json::object()), "limit", values);
  values.erase("limit.values");  // those of its axis
  for (const auto& [key, value] : sweep.items()) {
    // Counts and seeds of the sweep itself. Objects and lists among them are base, axes, limit
    // and planners, which are compared by themselves.
    if (value.is_primitive() && key != "name") values[key] = value.dump();
  }
  return values;
}

/// A planner's plugin, file, camera and parameters.
Values planner_values(const json& planner) {
  Values values{{"plugin", planner.value("plugin", json()).dump()},
                {"file", planner.value("file_digest", json()).dump()}};
  if (planner.contains("camera")) values["camera"] = planner.at("camera").dump();
  if (planner.contains("filter")) {
    for (const auto& [name, value] : planner_values(planner.at("filter"))) {
      values["filter." + name] = value;
    }
  }
  for (const json& parameter : planner.value("parameters", json::array())) {
    const bool is_text = parameter.value("is_text", false);
    values[parameter.value("name", "")] =
        parameter.value(is_text ? "text" : "number", json()).dump();
  }
  return values;
}

/// By label, which is unique in a sweep: order does not matter.
std::map<std::string, Values> planners_of(const json& sweep) {
  std::map<std::string, Values> planners;
  for (const json& planner : sweep.value("planners", json::array())) {
    planners[planner.value("label", "")] = planner_values(planner);
  }
  return planners;
}

/// What differs, as "name 1 → 2".
std::vector<std::string> differing(const Values& former, const Values& now) {
  // The paths of both sides.
  Values all = former;
  all.insert(now.begin(), now.end());
  std::vector<std::string> changes;
  for (const auto& [path, value] : all) {
    const auto was = former.find(path), is = now.find(path);
    const std::string before = was == former.end() ? "none" : was->second;
    const std::string after = is == now.end() ? "none" : is->second;
    if (before != after) changes.push_back(path + " " + before + " → " + after);
  }
  return changes;
}

json parsed(std::string_view text) {
  json value = json::parse(text, nullptr, false);
  return value.is_object() ? value : json::object();
}

}  // namespace

std::vector<std::string> spec_changes(std::string_view former_json, std::string_view json_text) {
  const json former = parsed(former_json), now = parsed(json_text);
  std::vector<std::string> changes = differing(values_of(former), values_of(now));
  const auto planners_before = planners_of(former), planners = planners_of(now);
  for (const auto& [label, values] : planners) {
    const auto before = planners_before.find(label);
    if (before == planners_before.end()) {
      changes.push_back("planner " + label + " is new");
      continue;
    }
    Values was = before->second, is = values;
    // Digests mean nothing to people: that it is another file is enough.
    if (was["file"] != is["file"]) changes.push_back("planner " + label + ": another file");
    was.erase("file");
    is.erase("file");
    for (const std::string& change : differing(was, is)) {
      changes.push_back("planner " + label + ": " + change);
    }
  }
  for (const auto& [label, values] : planners_before) {
    if (!planners.contains(label)) changes.push_back("planner " + label + " is gone");
  }
  return changes;
}

}  // namespace avoidbench
