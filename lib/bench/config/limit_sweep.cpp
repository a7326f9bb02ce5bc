#include <algorithm>
#include <cmath>
#include <functional>

#include "base/json_path.hpp"
#include "base/number_text.hpp"
#include "config/field_tree.hpp"
#include "config/sweep_file.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/overrides.hpp"

namespace avoidbench {
namespace {

/// Levels of the search; more make no interval narrower, fewer would be seen in it.
constexpr int kLevels = 41;

constexpr const char* kSpeedField = "max_speed_mps";

struct Over {
  std::string path;                    ///< as the sweep file has it
  std::optional<std::size_t> element;  ///< of a list: "wind.mean_world_mps[0]"
  double low = 0.0, high = 0.0;
};

[[noreturn]] void refuse(const std::string& over, const std::string& why) {
  throw InputError(over + ": " + why);
}

Over parse_over(const std::string& text) {
  constexpr const char* kExample = "expected FIELD=LOW..HIGH, such as max_speed_mps=1..10";
  const std::size_t equal = text.find('='), dots = text.find("..", equal);
  if (equal == std::string::npos || equal == 0 || dots == std::string::npos) refuse(text, kExample);
  Over over;
  over.path = text.substr(0, equal);
  const auto low = number_from<double>(text.substr(equal + 1, dots - equal - 1));
  const auto high = number_from<double>(text.substr(dots + 2));
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high)) refuse(text, kExample);
  if (!(*low < *high)) refuse(text, "the range ends before it begins: write the lower value first");
  over.low = *low;
  over.high = *high;
  if (!over.path.ends_with(']')) return over;
  const std::size_t bracket = over.path.rfind('[');
  over.element = number_from<std::size_t>(
      std::string_view(over.path).substr(bracket + 1, over.path.size() - bracket - 2));
  if (!over.element) refuse(text, kExample);
  over.path.resize(bracket);
  return over;
}

std::vector<double> levels_of(const Over& over, bool is_whole) {
  std::vector<double> values;
  const double low = is_whole ? std::ceil(over.low) : over.low;
  const double high = is_whole ? std::floor(over.high) : over.high;
  const int count =
      is_whole ? static_cast<int>(std::min(high - low + 1.0, 1.0 * kLevels)) : kLevels;
  for (int i = 0; i < count; ++i) {
    const double value = low + (high - low) * i / (count - 1);
    values.push_back(is_whole ? std::round(value) : value);
  }
  return values;
}

/// The list of values as YAML; of a list's element the whole lists, else as `base` has them.
std::string yaml_list(const std::vector<double>& values, const Over& over,
                      const nlohmann::json& base) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) {
    nlohmann::json one = value;
    if (over.element) {
      one = base;
      one.at(*over.element) = value;
    }
    list.push_back(std::move(one));
  }
  return list.dump();
}

/// The field as it is before it is varied, and whether it takes whole numbers only. Throws where it
/// is no number.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct Field {
  nlohmann::json base;
  bool is_whole = false;
};
Field field_of(const SweepSpec& sweep, const Over& over, const std::string& text) {
  static const FieldTree tree = field_tree("", TrialSpec{}, "");
  const std::string path = trial_path(over.path);
  const std::vector<KindField> found = fields_at(tree, path);
  const nlohmann::json base = spec_to_json(sweep.base);
  if (found.empty() || !base.contains(json_place(path))) {
    std::vector<std::string> known{kSpeedField};
    for (const KindField& field : all_fields(tree)) {
      if (is_number(*field.field)) known.push_back(sweep_path(field.path));
    }
    refuse(text, "the sweep has no such field" + did_you_mean(over.path, known));
  }
  const FieldTree* field = found.front().field;
  const nlohmann::json& value = base.at(json_place(path));
  if (over.element) {
    const bool is_there = value.is_array() && *over.element < value.size();
    if (!is_there || !is_number(field->fields.front()))
      refuse(text, "it is not a list of that many numbers");
    return {.base = value, .is_whole = false};
  }
  if (!is_number(*field) || path.ends_with("seed")) {
    refuse(text, value.is_array()
                     ? "it is a list: name one of its numbers, as in " + over.path + "[0]"
                     : "it is not a number whose growth makes flights harder or easier");
  }
  return {.base = value, .is_whole = field->kind == FieldKind::whole};
}

/// The axis' values as the file's reader took them.
std::vector<double> read_values(const SweepSpec& sweep, const Over& over, const std::string& path) {
  std::vector<double> values;
  for (const Axis& axis : sweep.axes) {
    if (axis.path != path) continue;
    for (const nlohmann::json& value : axis.values) {
      values.push_back((over.element ? value.at(*over.element) : value).get<double>());
    }
  }
  return values;
}

/// Every planner takes each value of its parameter.
void require_all_levels(const SweepSpec& sweep, const std::string& text) {
  for (const PlannerChoice& planner : sweep.planners) {
    if (label_without(planner.label, sweep.limit) != planner.label) continue;
    refuse(text, "planner " + planner.label + " has its own " + kSpeedField +
                     ": remove it from its entry");
  }
}

/// Throws InputError where the sweep can't have this value, as a fault of the range `text`.
void require_value(const Document& document, const Over& over, const Field& field, double value,
                   const std::string& text) {
  Document one = document;
  const std::string list = yaml_list({value}, over, field.base);
  const std::string override_text = over.path + "=" + list.substr(1, list.size() - 2);
  apply_overrides(one.root, {override_text});
  try {
    sweep_of_document(one);
  } catch (const InputError& error) {
    std::vector<InputProblem> problems = error.problems();
    for (InputProblem& problem : problems) {
      // The user has written a range, not the value that stands for it.
      if (problem.file.ends_with(override_text)) problem.file = text;
    }
    throw InputError(std::move(problems));
  }
}

/// The sweep with all values. What is wrong with the range is told once, of its ends, not of each
/// value.
SweepSpec sweep_of_values(const Document& document, const Over& over, const Field& field,
                          const std::vector<double>& values, const std::string& text) {
  Document varied = document;
  apply_overrides(varied.root, {over.path + "=" + yaml_list(values, over, field.base)});
  try {
    return sweep_of_document(varied);
  } catch (const InputError&) {
    for (const double end : {values.front(), values.back()}) {
      require_value(document, over, field, end, text);
    }
    throw;
  }
}

}  // namespace

SweepSpec read_limit_sweep(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides, const LimitRequest& request) {
  const Over over = parse_over(request.over);
  const Document document = read_sweep_document(file, overrides);
  const bool is_speed = over.path == kSpeedField;
  Field field;
  if (!is_speed) field = field_of(sweep_of_document(document), over, request.over);
  const std::vector<double> values = levels_of(over, field.is_whole);
  if (values.size() < 2) refuse(request.over, "there are not two whole numbers in this range");
  SweepSpec sweep = sweep_of_values(document, over, field, values, request.over);
  if (sweep.until.is_set()) throw InputError("until: a limit has its own stopping rule: remove it");

  const std::string path = is_speed ? std::string("planner.") + kSpeedField : trial_path(over.path);
  LimitRule& rule = sweep.limit;
  rule.field = path + (over.element ? "." + std::to_string(*over.element) : "");
  rule.values = is_speed ? values : read_values(sweep, over, path);
  // Rates are rounded to whole ticks.
  if (std::adjacent_find(rule.values.begin(), rule.values.end(), std::greater_equal<>()) !=
      rule.values.end()) {
    refuse(request.over, "its values can't be told apart: they are rounded to whole ticks");
  }
  rule.unit = unit_of(last_part(over.path));
  rule.success_rate = request.success_rate;
  rule.reach_mps = request.reach_mps;
  rule.width = request.width.value_or((values.back() - values.front()) / 10.0);
  rule.most_trials = request.most_trials;
  rule.is_paired = request.is_paired;
  rule.direction = request.direction;
  if (is_speed) require_all_levels(sweep, request.over);
  std::string name = last_part(over.path);
  if (over.element) name += std::to_string(*over.element);
  sweep.name += "_limit_" + name;
  // Another question: its trials are others.
  if (rule.reach_mps > 0.0) sweep.name += "_reach_" + shortest(rule.reach_mps);
  return sweep;
}

}  // namespace avoidbench
