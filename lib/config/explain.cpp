#include "config/explain.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "base/input_error.hpp"
#include "config/defaults.hpp"
#include "config/given_values.hpp"
#include "config/sweep_keys.hpp"
#include "trial/contradictions.hpp"
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
    bool is_good = true;
    const auto changed = [&](const Json& value) -> Json {
      const double other = change(value.get<double>());
      const bool fits = std::isfinite(other) && other >= range.lowest && other <= range.highest &&
                        (!is_whole || std::floor(other) == other);
      is_good = is_good && fits;
      return fits && is_whole ? Json(static_cast<std::int64_t>(other)) : Json(other);
    };
    Json other = Json::array();
    if (field.kind != FieldKind::list) other = changed(field.preset);
    if (field.kind == FieldKind::list) {
      for (const Json& value : field.preset) other.push_back(changed(value));
    }
    if (is_good && other != field.preset) others.push_back(std::move(other));
  }
  return others;
}

/// Values that an example may change the field to; none where nothing else is known to be good.
std::vector<Json> other_values(const FieldTree& field) {
  std::vector<Json> others;
  switch (element_of(field).kind) {
    case FieldKind::whole:
    case FieldKind::number:
      return other_numbers(field);
    case FieldKind::truth:
      if (field.preset.is_boolean()) others.emplace_back(!field.preset.get<bool>());
      break;
    case FieldKind::choice:
      for (const std::string& choice : field.choices) {
        if (field.preset != choice) others.emplace_back(choice);
      }
      break;
    default:
      if (field.preset.is_string() && field.preset != "") {
        others.emplace_back(field.preset.get<std::string>() + "_2");
      }
  }
  return others;
}

/// The sweep's TrialSpec with a value at a path, as JSON.
Json trial_with(const Json& base, const std::string& path, const Json& value) {
  Json trial = base;
  std::string pointer = "/" + trial_path(path);
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  trial[Json::json_pointer(pointer)] = value;
  return trial;
}

/// `maps: {generator: hall, height_m: 5}` for maps.height_m, the kinds said first.
std::string example_line(const std::string& path, const std::vector<SaidKind>& kinds,
                         const OrderedJson& value) {
  OrderedJson document;
  const auto set = [&](const std::string& at, const OrderedJson& what) {
    std::string pointer = "/" + at;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    document[OrderedJson::json_pointer(pointer)] = what;
  };
  for (const SaidKind& said : kinds) set(said.path, said.kind);
  set(path, value);
  const std::string text = flow_yaml(document);
  // Without the outer braces: the document is a mapping.
  return text.substr(1, text.size() - 2);
}

/// One or two values for a field of the sweep: its preset, and another that contradicts nothing
/// else's preset; none where there is no example.
std::vector<Json> example_values(const std::string& path, const KindField& field) {
  if (field.field->preset.is_null() || field.field->preset == "") return {};
  std::vector<Json> values{field.field->preset};
  // A trial with all at its preset, except for the kinds that the field needs.
  Json base = spec_to_json(TrialSpec{});
  const std::size_t dot = path.find('.');
  if (dot != std::string::npos) {  // the block with the kinds that the field needs
    const std::string key = path.substr(0, dot);
    std::vector<SaidKind> kinds;
    for (const SaidKind& said : field.kinds) {
      kinds.push_back({said.path.substr(dot + 1), said.kind});
    }
    base[key == "maps" ? "map" : key].update(preset_json(*sweep_tree().find(key), kinds));
  }
  // The presets of an unusual kind may contradict others already: only more of it counts.
  const std::size_t before = contradictions(spec_from_json<TrialSpec>(base)).size();
  for (const Json& other : other_values(*field.field)) {
    const auto changed = spec_from_json<TrialSpec>(trial_with(base, path, other));
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
      return "one of " + listed(field.choices);
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
std::vector<std::string> row(const FieldTree& field) {
  const FieldTree& element = element_of(field);
  std::string values = range_text(element.range);
  constexpr std::size_t kLongest = 22;
  const std::string choices = listed(field.choices);
  if (field.kind == FieldKind::truth) values = "true, false";
  if (!choices.empty()) {
    values = choices.size() <= kLongest ? choices : std::to_string(field.choices.size()) + " words";
  }
  if (field.kind == FieldKind::block) values = "mapping";
  std::string preset = preset_text(field);
  if (preset.size() > kLongest && field.preset.is_array())
    preset = std::to_string(field.preset.size()) + " values";
  return {field.name, unit_of(field.name), values, preset, field.doc};
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
  return listed(words);
}

/// A field with its type, range and default; `unit` of its numbers.
Explanation about_values(const std::string& path, const FieldTree& field, const std::string& unit) {
  Explanation about;
  about.title = path + ": " + field.doc;
  about.facts.emplace_back("type", type_text(field) + (unit.empty() ? "" : ", " + unit));
  const std::string range = range_text(element_of(field).range);
  if (!range.empty()) about.facts.emplace_back("range", range);
  if (field.kind == FieldKind::other) about.facts.emplace_back("built in", listed(field.choices));
  about.facts.emplace_back("default", preset_text(field));
  return about;
}

/// How a field of a sweep is written, alone and as an axis.
void add_examples(const std::string& path, const KindField& entry, Explanation& about) {
  const FieldTree& field = *entry.field;
  const auto line = [&](const OrderedJson& value) {
    return example_line(path, entry.kinds, value);
  };
  if (field.kind == FieldKind::variant || field.kind == FieldKind::other) {
    about.facts.emplace_back("example", line(other_choice(field)));
    about.facts.emplace_back("axis", "no: write one sweep for each");
    return;
  }
  // First the preset, then another value: the example is one that changes something.
  const std::vector<Json> values = example_values(path, entry);
  const bool is_text = values.empty() && field.kind == FieldKind::text;
  if (!values.empty()) about.facts.emplace_back("example", line(values.back()));
  if (is_text) about.facts.emplace_back("example", line("TEXT"));
  if (values.size() < 2) {
    about.facts.emplace_back("axis", "a list of such values");
    return;
  }
  const Json several(values);
  about.facts.emplace_back("axis", line(several));
  if (field.kind == FieldKind::number || field.kind == FieldKind::whole) {
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
  about.facts.emplace_back("or", "axes: {" + path + ": " + flow_yaml(several) + "}");
}

Explanation about_field(const std::string& path, const KindField& entry) {
  const FieldTree& field = *entry.field;
  if (!field.facts.empty()) return {path + ": " + field.doc, field.facts, {}, {}};
  Explanation about = about_values(path, field, unit_of(field.name));
  if (field.name == "seeds") {
    about.facts = {{"type", "how many, or a list or range of them"},
                   {"default", preset_text(field)},
                   {"example", "maps: {seeds: 3}"},
                   {"axis", "maps: {seeds: [1, 5, 9]}"},
                   {"or", "axes: {maps.seeds: [1, 5, 9]}"}};
    return about;
  }
  if (!entry.kinds.empty()) {
    about.facts.insert(about.facts.begin(), {"with", kinds_text(entry.kinds)});
  }
  add_examples(path, entry, about);
  if (element_of(field).kind == FieldKind::block) {
    about.columns = kColumns;
    for (const FieldTree& inner : element_of(field).fields) about.keys.push_back(row(inner));
  }
  return about;
}

/// A block: its keys; of a variant those that every kind has, and the kinds.
std::vector<Explanation> about_block(const std::string& path, const FieldTree& block) {
  Explanation about;
  about.title = path + ": " + block.doc;
  const FieldTree* preset = block.find("preset");
  // A name may stand for the block.
  if (preset != nullptr) {
    const std::string& last = preset->choices.back();
    about.facts = {{"type", "a name, or a mapping"},
                   {"names", "built in, or of a file " + path +
                                 "s/NAME.yaml beside the sweep or its "
                                 "folder"},
                   {"built in", listed(preset->choices)},
                   {"example", path + ": " + last},
                   {"or", path + ": {preset: " + last + ", name: mine}"}};
  }
  about.columns = kColumns;
  // The block first, then a table of kinds for each variant in it.
  std::vector<Explanation> all;
  for (const FieldTree& field : block.fields) {
    about.keys.push_back(row(field));
    if (field.kind != FieldKind::variant) continue;
    Explanation kinds;
    kinds.title =
        path + "." + field.name + " adds keys: avoidbench config explain " + path + ".NAME";
    kinds.columns = {"name", "doc"};
    for (const FieldTree& kind : field.fields) {
      std::string keys;
      for (const FieldTree& inner : kind.fields) keys += (keys.empty() ? "" : ", ") + inner.name;
      kinds.keys.push_back({kind.name, !kind.doc.empty() ? kind.doc : keys.empty() ? "-" : keys});
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

std::vector<Explanation> about_top() {
  Explanation about;
  about.title = "The keys of a sweep file; avoidbench config explain KEY says more about one.";
  about.columns = {"key", "doc"};
  for (const FieldTree& key : sweep_tree().fields) about.keys.push_back({key.name, key.doc});
  return {std::move(about)};
}

/// How it is written in a sweep's file, for one value and as an axis.
Explanation about_parameter(const std::string& planner, const ParameterDef& parameter) {
  const FieldTree field = parameter_tree(parameter);
  Explanation about = about_values(planner + "." + field.name, field, parameter.unit);
  const auto line = [&](const Json& value) {
    return "planners: [{plugin: " + planner + ", parameters: {" + field.name + ": " +
           flow_yaml(value) + "}}]";
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
    Explanation about{
        name + ": " + planner.summary, {{"example", "planners: [" + name + "]"}}, kColumns, {}};
    for (const ParameterDef& parameter : planner.parameters) {
      if (key == name + "." + parameter.name) return {about_parameter(name, parameter)};
      about.keys.push_back(row(parameter_tree(parameter)));
      about.keys.back()[1] = parameter.unit;
    }
    if (dot == std::string::npos) return {std::move(about)};
  }
  return {};
}

/// Of all kinds: a name that several have is one path.
void add_paths(const FieldTree& block, const std::string& prefix, std::set<std::string>& paths) {
  for (const KindField& entry : all_fields(block)) {
    paths.insert(prefix + entry.field->name);
    if (entry.field->kind == FieldKind::block) {
      add_paths(*entry.field, prefix + entry.field->name + ".", paths);
    }
  }
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// All that can be explained.
std::vector<std::string> all_keys(const std::vector<PlannerDescription>& planners) {
  std::set<std::string> paths;
  add_paths(sweep_tree(), "", paths);
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
  // Each once, in the order of likelihood.
  std::set<std::string> seen;
  std::erase_if(found, [&](const std::string& other) { return !seen.insert(other).second; });
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
std::vector<Explanation> about_fields(const std::string& path, std::vector<KindField> found) {
  std::vector<Explanation> all;
  while (!found.empty()) {
    const KindField first = found.front();
    Explanation about = about_field(path, first);
    found.erase(found.begin());
    for (std::size_t i = 0; i < found.size();) {
      if (!is_alike(first, found[i])) {
        ++i;
        continue;
      }
      const std::vector<SaidKind>& kinds = found[i].kinds;
      const bool is_same_word = kinds.size() == 1 && kinds[0].path == first.kinds.at(0).path;
      about.facts.front().second += is_same_word ? ", " + kinds[0].kind : "; " + kinds_text(kinds);
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(i));
    }
    all.push_back(std::move(about));
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
                     (meant.empty() ? "" : " (did you mean " + listed(meant) + "?)") +
                     "; avoidbench config explain lists the keys of a sweep file");
  }
  if (found.front().field->kind == FieldKind::block) return about_block(path, *found[0].field);
  return about_fields(path, found);
}

}  // namespace avoidbench
