#include "sweep/limit_rule.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

constexpr std::string_view kOfMap = "map.";

}  // namespace

json to_json(const LimitRule& rule) {
  json stored = {{"field", rule.field},        {"unit", rule.unit},
                 {"values", rule.values},      {"success_rate", rule.success_rate},
                 {"width", rule.width},        {"most_trials", rule.most_trials},
                 {"is_paired", rule.is_paired}};
  // As in keys, a field at its default is not there.
  if (rule.reach_mps > 0.0) stored["reach_mps"] = rule.reach_mps;
  if (rule.direction != LimitDirection::unknown) stored["direction"] = text(rule.direction);
  return stored;
}

std::optional<LimitRule> limit_rule_of(const std::string& spec_json) {
  if (spec_json.empty()) return std::nullopt;
  try {
    const json spec = json::parse(spec_json);
    if (!spec.contains("limit")) return std::nullopt;
    const json& given = spec.at("limit");
    LimitRule rule{.field = given.at("field").get<std::string>(),
                   .unit = given.at("unit").get<std::string>(),
                   .values = given.at("values").get<std::vector<double>>(),
                   .success_rate = given.at("success_rate").get<double>(),
                   .reach_mps = given.value("reach_mps", 0.0),
                   .width = given.at("width").get<double>(),
                   .most_trials = given.at("most_trials").get<std::int64_t>(),
                   .is_paired = given.at("is_paired").get<bool>()};
    const auto direction = enum_from_text<LimitDirection>(
        given.value("direction", std::string(text(LimitDirection::unknown))));
    rule.direction = direction.value_or(LimitDirection::unknown);
    constexpr std::size_t kMostLevels = 1000;  // more than the command gives
    const bool is_sound =
        rule.is_set() && direction && rule.values.size() >= 2 &&
        rule.values.size() <= kMostLevels &&
        std::is_sorted(rule.values.begin(), rule.values.end(), std::less_equal<>()) &&
        rule.values.back() - rule.values.front() < std::numeric_limits<double>::infinity() &&
        rule.success_rate > 0.0 && rule.success_rate < 1.0 && rule.width > 0.0 &&
        rule.reach_mps >= 0.0;
    if (is_sound) return rule;
  } catch (const json::exception&) {
  }
  throw InputError("damaged: table sweeps: spec_json has no sound 'limit'");
}

std::optional<std::size_t> level_of(const LimitRule& rule, double value) {
  // SQLite may read a stored number one bit off.
  const double most = 1e-9 * (rule.values.back() - rule.values.front());
  for (std::size_t level = 0; level < rule.values.size(); ++level) {
    if (std::abs(rule.values[level] - value) <= most) return level;
  }
  return std::nullopt;
}

std::string label_without(const std::string& label, const LimitRule& rule) {
  if (!rule.field.starts_with(kOfPlanner)) return label;
  const std::string said = rule.field.substr(kOfPlanner.size()) + "=";
  std::size_t begin = label.rfind('[' + said);
  if (begin == std::string::npos) begin = label.rfind(',' + said);
  if (begin == std::string::npos) return label;
  const std::size_t end = label.find_first_of(",]", begin + 1);
  if (end == std::string::npos) return label;
  // "[a=1]", "[a=1,b=2]" and "[b=2,a=1]": the bracket stays where something else stands in it.
  if (label[begin] == ',') return label.substr(0, begin) + label.substr(end);
  if (label[end] == ']') return label.substr(0, begin) + label.substr(end + 1);
  return label.substr(0, begin + 1) + label.substr(end + 1);
}

std::string map_place(json map_spec, std::uint64_t map_seed, const LimitRule& rule) {
  if (rule.field.starts_with(kOfMap)) map_spec.erase(rule.field.substr(kOfMap.size()));
  return map_spec.dump() + std::to_string(map_seed);
}

}  // namespace avoidbench
