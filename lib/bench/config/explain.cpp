#include "config/explain.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "base/input_error.hpp"
#include "base/json_path.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "config/defaults.hpp"
#include "config/given_values.hpp"
#include "config/sweep_keys.hpp"
#include "control/reference_governor.hpp"
#include "plugin/planner_table.hpp"
#include "trial/contradictions.hpp"
#include "vehicle/capability.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

// -------------------------------------------------------------------------------------------------
// examples

const FieldTree& element_of(const FieldTree& field) {
  return field.kind == FieldKind::list ? field.fields.front() : field;
}

/// Other numbers than the preset, from near to far, or lists with all their numbers changed alike.
/// A user learns more from an example that changes something; so changes are tried until one is
/// within the range and, for whole numbers, whole.
std::vector<Json> other_numbers(const FieldTree& field) {
  const FieldTree& element = element_of(field);
  const Range range = element.range;
  const bool is_whole = element.kind == FieldKind::whole;
  const std::function<double(double)> changes[] = {
      [](double x) { return x * 2.0; },     [](double x) { return x / 2.0; },
      [](double x) { return x + 1.0; },     [](double x) { return x - 1.0; },
      [](double x) { return x + 2.0; },     [&](double) { return range.lowest; },
      [&](double) { return range.highest; }};
  std::vector<Json> others;
  for (const auto& change : changes) {
    const auto apply = [&](Json& value) {
      const double other = change(value.get<double>());
      const bool fits = std::isfinite(other) && other >= range.lowest && other <= range.highest &&
                        (!is_whole || std::floor(other) == other);
      if (fits) value = is_whole ? Json(static_cast<std::int64_t>(other)) : Json(other);
      return fits;
    };
    Json other = field.preset;
    // A number that stands alone is its only element.
    const bool is_good = std::all_of(other.begin(), other.end(), apply);
    if (is_good && other != field.preset) others.push_back(std::move(other));
  }
  return others;
}

/// Values that an example may change the field to; none where nothing else is known to be good.
std::vector<Json> other_values(const FieldTree& field) {
  if (is_number(element_of(field))) return other_numbers(field);
  std::vector<Json> others;
  if (field.preset.is_boolean()) others.emplace_back(!field.preset.get<bool>());
  for (const std::string& choice : field.choices) {
    if (field.preset != choice) others.emplace_back(choice);
  }
  if (field.kind == FieldKind::text && field.preset != "") {
    others.emplace_back(field.preset.get<std::string>() + "_2");
  }
  return others;
}

/// `maps: {generator: hall, height_m: 5}` for maps.height_m, the kinds said first.
std::string example_line(const KindField& entry, const OrderedJson& value) {
  OrderedJson document;
  for (const SaidKind& said : entry.kinds) document[json_place(said.path)] = said.kind;
  document[json_place(entry.path)] = value;
  const std::string text = flow_yaml(document);
  // Without the outer braces: the document is a mapping.
  return text.substr(1, text.size() - 2);
}

/// One or two values for a field of the sweep: its preset, and another that contradicts nothing
/// else's preset; none where there is no example.
std::vector<Json> example_values(const KindField& entry) {
  const FieldTree& field = *entry.field;
  if (field.preset.is_null() || field.preset == "") return {};
  std::vector<Json> values{field.preset};
  // A sweep with all at its preset, except for the kinds that the field needs.
  Json keys = preset_json(sweep_tree(), entry.kinds);
  // The presets of an unusual kind may contradict others already: only more of it counts.
  const std::size_t before = contradictions(sweep_from(keys).base).size();
  for (const Json& other : other_values(field)) {
    keys[json_place(entry.path)] = other;
    const TrialSpec changed = sweep_from(keys).base;
    if (contradictions(changed).size() > before || !fits_free_space(changed)) continue;
    values.push_back(other);
    break;
  }
  return values;
}

// -------------------------------------------------------------------------------------------------
// texts

std::string range_text(Range range) {
  const bool below = std::isfinite(range.lowest), above = std::isfinite(range.highest);
  if (below && above) return number_text(range.lowest) + " to " + number_text(range.highest);
  if (below) return "at least " + number_text(range.lowest);
  return above ? "at most " + number_text(range.highest) : "";
}

std::string type_text(const FieldTree& field) {
  switch (field.kind) {
    case FieldKind::truth:
      return "true or false";
    case FieldKind::whole:
      return "whole number";
    case FieldKind::number:
      return "number";
    case FieldKind::text:
      return "text";
    case FieldKind::choice:
    case FieldKind::variant:
      return "one of " + joined(field.choices);
    case FieldKind::block:
      return "mapping";
    case FieldKind::other:
      return field.choices.empty() ? "" : "name";
    case FieldKind::list:
      break;
  }
  const std::string of = type_text(field.fields.front()) + "s";
  return "list of " + (field.count ? std::to_string(*field.count) + " " : "") + of;
}

std::string preset_text(const FieldTree& field) {
  if (field.name == "seeds") return "[" + flow_yaml(field.preset) + "]";
  if (field.preset.is_null()) return "";
  return field.preset == "" ? "\"\"" : flow_yaml(field.preset);
}

/// A row of a block's table.
std::vector<std::string> row(const FieldTree& field, const std::string& unit) {
  const FieldTree& element = element_of(field);
  std::string values = range_text(element.range);
  constexpr std::size_t kLongest = 22;
  const std::string choices = joined(field.choices);
  if (field.kind == FieldKind::truth) values = "true, false";
  if (!choices.empty()) {
    values = choices.size() <= kLongest ? choices : counted(field.choices.size(), "word");
  }
  if (field.kind == FieldKind::block) values = "mapping";
  std::string preset = preset_text(field);
  if (preset.size() > kLongest && field.preset.is_array())
    preset = counted(field.preset.size(), "value");
  return {field.name, unit, values, preset, field.doc};
}

const std::vector<std::string> kColumns{"key", "unit", "values", "default", "doc"};

/// A choice that is not the first.
const std::string& other_choice(const FieldTree& field) {
  return field.choices.at(field.choices.size() > 1 ? 1 : 0);
}

// -------------------------------------------------------------------------------------------------
// one key

std::string kinds_text(const std::vector<SaidKind>& kinds) {
  std::vector<std::string> words;
  for (const SaidKind& said : kinds) words.push_back(said.path + ": " + said.kind);
  return joined(words);
}

/// A field with its type, range and default; `unit` of its numbers.
Explanation about_values(const std::string& path, const FieldTree& field, const std::string& unit) {
  Explanation about;
  about.title = path + ": " + field.doc;
  about.facts.emplace_back("type", type_text(field) + (unit.empty() ? "" : ", " + unit));
  const std::string range = range_text(element_of(field).range);
  if (!range.empty()) about.facts.emplace_back("range", range);
  if (field.kind == FieldKind::other) about.facts.emplace_back("built in", joined(field.choices));
  about.facts.emplace_back("default", preset_text(field));
  return about;
}

/// How a field of a sweep is written, alone and as an axis.
void add_examples(const KindField& entry, Explanation& about) {
  const FieldTree& field = *entry.field;
  const auto line = [&](const OrderedJson& value) { return example_line(entry, value); };
  if (field.kind == FieldKind::variant || field.kind == FieldKind::other) {
    about.facts.emplace_back("example", line(other_choice(field)));
    about.facts.emplace_back("axis", "no: write one sweep for each");
    return;
  }
  // First the preset, then another value: the example is one that changes something.
  const std::vector<Json> values = example_values(entry);
  const bool is_text = values.empty() && field.kind == FieldKind::text;
  if (!values.empty()) about.facts.emplace_back("example", line(values.back()));
  if (is_text) about.facts.emplace_back("example", line("TEXT"));
  if (values.size() < 2) {
    about.facts.emplace_back("axis", "a list of such values");
    return;
  }
  const Json several(values);
  about.facts.emplace_back("axis", line(several));
  if (is_number(field)) {
    const auto [low, high] = std::minmax(values[0], values[1]);
    OrderedJson range{{"from", low}, {"to", high}};
    if (field.kind == FieldKind::number) {
      range["count"] = 3;
    } else {
      // A count of whole numbers might fall between them.
      range["step"] = high.get<std::int64_t>() - low.get<std::int64_t>();
    }
    about.facts.emplace_back("or", line(range));
  }
  about.facts.emplace_back("or", "axes: {" + entry.path + ": " + flow_yaml(several) + "}");
}

Explanation about_field(const KindField& entry) {
  const FieldTree& field = *entry.field;
  if (!field.facts.empty()) return {entry.path + ": " + field.doc, field.facts, {}, {}};
  Explanation about = about_values(entry.path, field, unit_of(field.name));
  if (!entry.kinds.empty()) {
    about.facts.insert(about.facts.begin(), {"with", kinds_text(entry.kinds)});
  }
  add_examples(entry, about);
  if (element_of(field).kind == FieldKind::block) {
    about.columns = kColumns;
    for (const FieldTree& inner : element_of(field).fields) {
      about.keys.push_back(row(inner, unit_of(inner.name)));
    }
  }
  return about;
}

/// A block: its keys; of a variant those that every kind has, and the kinds.
std::vector<Explanation> about_block(const std::string& path, const FieldTree& block) {
  Explanation about{.title = path + ": " + block.doc, .facts = {}, .columns = kColumns, .keys = {}};
  const FieldTree* preset = block.find("preset");
  // A name may stand for the block.
  if (preset != nullptr) {
    const std::string& last = preset->choices.back();
    about.facts = {
        {"type", "a name, or a mapping"},
        {"names", "built in, or of a file " + path + "s/NAME.yaml next to the sweep or its folder"},
        {"built in", joined(preset->choices)},
        {"example", path + ": " + last},
        {"or", path + ": {preset: " + last + ", name: mine}"}};
  }
  // The block first, then a table of kinds for each variant in it.
  std::vector<Explanation> all;
  for (const FieldTree& field : block.fields) {
    about.keys.push_back(row(field, unit_of(field.name)));
    if (field.kind != FieldKind::variant) continue;
    Explanation kinds;
    kinds.title =
        path + "." + field.name + " adds keys: avoidbench config explain " + path + ".NAME";
    kinds.columns = {"name", "doc"};
    for (const FieldTree& kind : field.fields) {
      std::vector<std::string> keys;
      for (const FieldTree& inner : kind.fields) keys.push_back(inner.name);
      if (keys.empty()) keys.emplace_back("-");
      kinds.keys.push_back({kind.name, kind.doc.empty() ? joined(keys) : kind.doc});
    }
    about.facts.emplace_back("example",
                             path + ": {" + field.name + ": " + other_choice(field) + "}");
    all.push_back(std::move(kinds));
  }
  all.insert(all.begin(), std::move(about));
  return all;
}

/// maps.hall: the keys of one kind. Nothing where `path` names none.
std::vector<Explanation> about_kind(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return {};
  const std::string name = path.substr(dot + 1);
  for (const KindField& outer : fields_at(sweep_tree(), path.substr(0, dot))) {
    for (const FieldTree& field : outer.field->fields) {
      const FieldTree* kind = field.kind == FieldKind::variant ? field.find(name) : nullptr;
      if (kind == nullptr) continue;
      std::vector<Explanation> all = about_block(path, *kind);
      all[0].title = path.substr(0, dot) + " with " + field.name + ": " + name;
      if (!kind->doc.empty()) all[0].title += ". " + kind->doc;
      return all;
    }
  }
  return {};
}

/// "295/292/49": roll, pitch, yaw.
std::string per_axis(const std::array<double, 3>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : "/") + fixed_digits(value, value < 10.0 ? 1 : 0);
  }
  return text;
}

/// What the vehicles that are built in can do, in closed form: a row for each.
Explanation built_in_vehicles() {
  Explanation about;
  about.title =
      "Vehicles that are built in: thrust/weight; roll, pitch and yaw acceleration from hover, "
      "rad/s²; rotor speed in hover, rad/s; speed that drag allows, m/s; limits of the reference: "
      "speed, m/s, acceleration, m/s², and the way from that speed to rest, m";
  about.columns = {"name",    "thrust/weight", "turning",      "hover",
                   "by_drag", "max_speed",     "acceleration", "stops_in"};
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    const VehicleModel model = make_model(vehicle);
    about.keys.push_back({vehicle.name, fixed_digits(thrust_to_weight(vehicle), 2),
                          per_axis(hover_angular_acceleration_radps2(vehicle)),
                          fixed_digits(hover_rotor_speed_radps(vehicle), 0),
                          fixed_digits(top_speed_mps(vehicle), 0),
                          significant_digits(vehicle.max_speed_mps, 3),
                          significant_digits(vehicle.max_acceleration_mps2, 3),
                          fixed_digits(stopping_distance_m(model, vehicle.max_speed_mps), 1)});
  }
  return about;
}

std::vector<Explanation> about_top() {
  Explanation about;
  about.title = "The keys of a sweep file; avoidbench config explain KEY describes one.";
  about.columns = {"key", "doc"};
  for (const FieldTree& key : sweep_tree().fields) about.keys.push_back({key.name, key.doc});
  return {std::move(about)};
}

std::string of_filter(const std::string& entry) {
  return "{plugin: straight_line, filter: " + entry + "}";
}

/// How it is written in a sweep's file, for one value and as an axis.
Explanation about_parameter(const std::string& planner, const ParameterDef& parameter,
                            bool stands_above) {
  const FieldTree field = parameter_tree(parameter);
  Explanation about = about_values(planner + "." + field.name, field, parameter.unit);
  const auto line = [&](const Json& value) {
    const std::string entry =
        "{plugin: " + planner + ", parameters: {" + field.name + ": " + flow_yaml(value) + "}}";
    return "planners: [" + (stands_above ? of_filter(entry) : entry) + "]";
  };
  if (field.preset == "") {
    about.facts.emplace_back("example", line("TEXT"));
    return about;
  }
  const std::vector<Json> others = other_values(field);
  about.facts.emplace_back("example", line(others.empty() ? field.preset : others.front()));
  if (!others.empty())
    about.facts.emplace_back("axis", line(Json::array({field.preset, others.front()})));
  return about;
}

/// A planner, or one of its parameters. Nothing where `key` is neither.
std::vector<Explanation> about_planner(const std::string& key,
                                       const std::vector<PlannerDescription>& planners) {
  const std::size_t dot = key.find('.');
  for (const PlannerDescription& planner : planners) {
    const std::string name = planner.file.stem().string();
    if (name != key.substr(0, dot)) continue;
    const bool stands_above = is_filter(planner);
    const std::string example = stands_above ? of_filter(name) : name;
    Explanation about{
        name + ": " + planner.summary, {{"example", "planners: [" + example + "]"}}, kColumns, {}};
    for (const ParameterDef& parameter : planner.parameters) {
      if (key == name + "." + parameter.name)
        return {about_parameter(name, parameter, stands_above)};
      about.keys.push_back(row(parameter_tree(parameter), parameter.unit));
    }
    if (dot == std::string::npos) return {std::move(about)};
  }
  return {};
}

/// All that can be explained. A field that several kinds have is one key.
std::vector<std::string> all_keys(const std::vector<PlannerDescription>& planners) {
  std::set<std::string> paths;
  for (const KindField& entry : all_fields(sweep_tree())) paths.insert(entry.path);
  for (const PlannerDescription& planner : planners) {
    const std::string name = planner.file.stem().string();
    paths.insert(name);
    for (const ParameterDef& parameter : planner.parameters) {
      paths.insert(name + "." + parameter.name);
    }
  }
  return {paths.begin(), paths.end()};
}

/// The keys of this last part.
std::vector<std::string> keys_ending(const std::vector<std::string>& keys, std::string_view last) {
  std::vector<std::string> found;
  for (const std::string& key : keys) {
    if (last_part(key) == last) found.push_back(key);
  }
  return found;
}

/// What may have been meant: by the last part, else by a misspelling of it, else by a part of it.
std::vector<std::string> suggestions(const std::string& key, const std::vector<std::string>& keys) {
  const std::string last = last_part(key);
  std::vector<std::string> found = keys_ending(keys, last);
  // A misspelling of the whole path is the likeliest.
  const std::string whole(nearest_word(key, keys));
  std::erase(found, whole);
  if (!whole.empty()) found.insert(found.begin(), whole);
  if (found.empty() && !last.empty()) {
    std::vector<std::string> lasts;
    for (const std::string& other : keys) lasts.push_back(last_part(other));
    const std::string_view nearest = nearest_word(last, lasts);
    if (!nearest.empty()) found = keys_ending(keys, nearest);
  }
  // Two letters are a part of almost every key.
  constexpr std::size_t kLeastPart = 3;
  if (found.empty() && last.size() >= kLeastPart) {
    for (const std::string& other : keys) {
      if (last_part(other).find(last) != std::string::npos) found.push_back(other);
    }
  }
  constexpr std::size_t kMostShown = 5;
  if (found.size() > kMostShown) found.resize(kMostShown);
  return found;
}

/// Several kinds may have a field of one name: where they say the same of it, it is told once.
bool is_alike(const KindField& a, const KindField& b) {
  return a.field->doc == b.field->doc && a.field->preset == b.field->preset &&
         a.field->range.lowest == b.field->range.lowest &&
         a.field->range.highest == b.field->range.highest && a.field->choices == b.field->choices;
}

/// The explanations of a field that one or several kinds have; those that are alike together.
std::vector<Explanation> about_fields(const std::vector<KindField>& found) {
  std::vector<Explanation> all;
  std::vector<KindField> told;  // the first ones of those that are alike
  for (const KindField& entry : found) {
    const auto first = std::find_if(told.begin(), told.end(),
                                    [&](const KindField& other) { return is_alike(other, entry); });
    if (first == told.end()) {
      all.push_back(about_field(entry));
      told.push_back(entry);
      continue;
    }
    std::string& with = all[static_cast<std::size_t>(first - told.begin())].facts.front().second;
    const bool is_same_word =
        entry.kinds.size() == 1 && entry.kinds[0].path == first->kinds.at(0).path;
    with += is_same_word ? ", " + entry.kinds[0].kind : "; " + kinds_text(entry.kinds);
  }
  return all;
}

}  // namespace

std::vector<Explanation> explain(const std::string& key,
                                 const std::vector<PlannerDescription>& planners) {
  if (key.empty()) return about_top();
  const bool is_planners = key.starts_with("planners.");
  // planners.NAME is NAME: planners' names are in no block of the sweep.
  const std::string path = is_planners ? key.substr(key.find('.') + 1) : sweep_path(key);
  const std::vector<KindField> found = fields_at(sweep_tree(), path);
  if (found.empty()) {
    if (auto kind = about_kind(path); !kind.empty()) return kind;
    if (auto planner = about_planner(path, planners); !planner.empty()) return planner;
    const std::vector<std::string> keys = all_keys(planners);
    const bool is_last = path.find('.') == std::string::npos;
    const std::vector<std::string> ending = keys_ending(keys, path);
    // poisson_radius_m alone is enough where only one path ends so.
    if (is_last && ending.size() == 1) return explain(ending.front(), planners);
    const std::vector<std::string> meant = suggestions(path, keys);
    throw InputError("no key '" + key + "'" +
                     (meant.empty() ? "" : " (did you mean " + joined(meant) + "?)") +
                     "; avoidbench config explain lists the keys of a sweep file");
  }
  if (found.front().field->kind != FieldKind::block) return about_fields(found);
  std::vector<Explanation> all = about_block(path, *found[0].field);
  if (path == "vehicle") all.push_back(built_in_vehicles());
  return all;
}

}  // namespace avoidbench
