#include "config/explain.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/input_error.hpp"
#include "config/examples.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;

std::string listed(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

std::string range_text(Range range, const std::string& to) {
  const bool below = std::isfinite(range.lowest), above = std::isfinite(range.highest);
  if (below && above) return number_text(range.lowest) + to + number_text(range.highest);
  if (below) return "at least " + number_text(range.lowest);
  return above ? "at most " + number_text(range.highest) : "";
}

const FieldTree& element_of(const FieldTree& field) {
  return field.kind == FieldKind::list ? field.fields.front() : field;
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
  std::string values = range_text(element.range, " to ");
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

/// Lines about the keys that are the sweep's own.
std::vector<std::pair<std::string, std::string>> own_facts(const std::string& key) {
  using Facts = std::vector<std::pair<std::string, std::string>>;
  if (key == "sweep") return Facts{{"type", "text"}, {"example", "sweep: dense_forest"}};
  if (key == "trials") {
    return Facts{{"type", "whole number"},
                 {"range", "1 to 1000000"},
                 {"default", "10"},
                 {"axis", "no: all missions are flown for each setting"},
                 {"example", "trials: 30"}};
  }
  if (key == "until") {
    return Facts{{"type", "a rule"},
                 {"default", "none: all trials are flown"},
                 {"axis", "no: it is the sweep's"},
                 {"example", "until: success_rate ci<0.05"}};
  }
  if (key == "include") {
    return Facts{{"type", "a file, or a list of them"},
                 {"example", "include: base.yaml"},
                 {"or", "include: [forest.yaml, windy.yaml]"},
                 {"merging",
                  "mappings merge key by key, other values are replaced; later files win "
                  "over earlier ones, this file over all"},
                 {"to take out", "write the key with ~ for its value"}};
  }
  if (key == "planners") {
    return Facts{
        {"type", "a name or mapping, or a list of them"},
        {"example", "planners: [straight_line, reactive]"},
        {"or", "planners: [{plugin: ./my_planner.so, label: mine}]"},
        {"axis", "planners: [{plugin: reactive, parameters: {margin_m: [0.3, 0.6]}}]"},
        {"see", "avoidbench planners list, planners describe NAME, config explain NAME.PARAMETER"}};
  }
  if (key == "max_speed_mps") {
    return Facts{{"type", "number in m/s"},
                 {"default", "each planner's own"},
                 {"example", "max_speed_mps: 3"},
                 {"axis", "max_speed_mps: [2, 4]"}};
  }
  if (key == "axes") {
    return Facts{{"type", "a mapping of paths to values"},
                 {"example", "axes: {wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]]}"},
                 {"or", "axes: {vehicle.mass_kg: {from: 0.7, to: 0.9, count: 3}}"},
                 {"not", "maps.generator, sensor.kind, trials, planners"}};
  }
  return {};
}

/// A choice that is not the first.
const std::string& other_choice(const FieldTree& field) {
  return field.choices.at(field.choices.size() > 1 ? 1 : 0);
}

/// How a field is written, alone and as an axis.
void add_examples(const std::string& path, const KindField& entry, const std::vector<Json>& values,
                  Explanation& about) {
  const FieldTree& field = *entry.field;
  const auto line = [&](const Json& value) {
    return example_line(path, entry.kinds, nlohmann::ordered_json(value));
  };
  if (field.kind == FieldKind::variant || field.kind == FieldKind::other) {
    about.facts.emplace_back("example", line(other_choice(field)));
    about.facts.emplace_back("axis", "no: write one sweep for each");
    return;
  }
  if (values.empty()) {
    if (field.kind == FieldKind::text) about.facts.emplace_back("example", line("TEXT"));
    about.facts.emplace_back("axis", "a list of such values");
    return;
  }
  about.facts.emplace_back("example", line(values.back()));
  if (values.size() < 2) {
    about.facts.emplace_back("axis", "a list of such values");
    return;
  }
  const Json several(values);
  about.facts.emplace_back("axis", line(several));
  if (field.kind == FieldKind::number || field.kind == FieldKind::whole) {
    const bool rises = values[0] < values[1];
    const Json low = values[rises ? 0 : 1], high = values[rises ? 1 : 0];
    nlohmann::ordered_json range{{"from", low}, {"to", high}};
    if (field.kind == FieldKind::number) {
      range["count"] = 3;
    } else {
      range["step"] = high.get<std::int64_t>() - low.get<std::int64_t>();
    }
    about.facts.emplace_back("or", example_line(path, entry.kinds, range));
  }
  about.facts.emplace_back("or", "axes: {" + path + ": " + flow_yaml(several) + "}");
}

std::string kinds_text(const std::vector<SaidKind>& kinds) {
  std::string all;
  for (const SaidKind& said : kinds)
    all += (all.empty() ? "" : ", ") + said.path + ": " + said.kind;
  return all;
}

Explanation about_field(const FieldTree& sweep, const std::string& path, const KindField& entry) {
  const FieldTree& field = *entry.field;
  const FieldTree& element = element_of(field);
  Explanation about;
  about.title = path + ": " + field.doc;
  if (!entry.kinds.empty()) about.facts.emplace_back("with", kinds_text(entry.kinds));
  const std::string unit = unit_of(field.name), range = range_text(element.range, " to ");
  about.facts.emplace_back("type", type_text(field) + (unit.empty() ? "" : ", " + unit));
  if (!range.empty()) about.facts.emplace_back("range", range);
  if (field.kind == FieldKind::other) about.facts.emplace_back("built in", listed(field.choices));
  about.facts.emplace_back("default", preset_text(field));
  if (field.name == "seeds") {
    about.facts = {{"type", "how many, or a list or range of them"},
                   {"default", preset_text(field)}};
    about.facts.insert(about.facts.end(), {{"example", "maps: {seeds: 3}"},
                                           {"axis", "maps: {seeds: [1, 5, 9]}"},
                                           {"or", "axes: {maps.seeds: [1, 5, 9]}"}});
    return about;
  }
  const bool has_values = field.kind != FieldKind::variant && field.kind != FieldKind::other;
  const std::vector<Json> values =
      has_values ? example_values(sweep, path, entry) : std::vector<Json>{};
  add_examples(path, entry, values, about);
  if (element.kind == FieldKind::block) {
    about.columns = kColumns;
    for (const FieldTree& inner : element.fields) about.keys.push_back(row(inner));
  }
  return about;
}

/// A block: its keys; of a variant those that every kind has, and the kinds.
std::vector<Explanation> about_block(const std::string& path, const FieldTree& block) {
  Explanation about;
  about.title = path + ": " + block.doc;
  const FieldTree* preset = block.find("preset");
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
std::vector<Explanation> about_kind(const FieldTree& sweep, const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return {};
  for (const KindField& outer : fields_at(sweep, path.substr(0, dot))) {
    if (outer.field->kind != FieldKind::block) continue;
    for (const FieldTree& field : outer.field->fields) {
      if (field.kind != FieldKind::variant) continue;
      const std::string name = path.substr(dot + 1);
      for (const FieldTree& kind : field.fields) {
        if (kind.name != name) continue;
        std::vector<Explanation> all = about_block(path, kind);
        all[0].title = path.substr(0, dot) + " with " + field.name + ": " + name;
        if (!kind.doc.empty()) all[0].title += ". " + kind.doc;
        return all;
      }
    }
  }
  return {};
}

std::vector<Explanation> about_top(const FieldTree& sweep) {
  Explanation about;
  about.title = "The keys of a sweep file; avoidbench config explain KEY says more about one.";
  about.columns = {"key", "doc"};
  for (const FieldTree& key : sweep.fields) about.keys.push_back({key.name, key.doc});
  return {std::move(about)};
}

/// A planner, or one of its parameters. Nothing where `key` is neither.
std::vector<Explanation> about_planner(const std::string& key,
                                       const std::vector<PlannerDescription>& planners) {
  const std::size_t dot = key.find('.');
  for (const PlannerDescription& planner : planners) {
    const std::string name = planner.file.stem().string();
    if (name != key.substr(0, dot)) continue;
    Explanation about;
    if (dot == std::string::npos) {
      about.title = name + ": " + planner.summary;
      about.facts.emplace_back("example", "planners: [" + name + "]");
      about.columns = kColumns;
      for (const ParameterDef& parameter : planner.parameters) {
        about.keys.push_back(row(parameter_tree(parameter)));
        about.keys.back()[1] = parameter.unit;
      }
      return {std::move(about)};
    }
    for (const ParameterDef& parameter : planner.parameters) {
      if (parameter.name != key.substr(dot + 1)) continue;
      const FieldTree field = parameter_tree(parameter);
      about.title = key + ": " + field.doc;
      about.facts = {
          {"type", type_text(field) + (parameter.unit.empty() ? "" : ", " + parameter.unit)}};
      const std::string range = range_text(field.range, " to ");
      if (!range.empty()) about.facts.emplace_back("range", range);
      about.facts.emplace_back("default", preset_text(field));
      const std::vector<Json> values = example_values(field);
      const auto line = [&](const Json& value) {
        return "planners: [{plugin: " + name + ", parameters: {" + field.name + ": " +
               flow_yaml(value) + "}}]";
      };
      about.facts.emplace_back("example", line(values.empty() ? Json("TEXT") : values.back()));
      if (values.size() > 1) about.facts.emplace_back("axis", line(Json(values)));
      return {std::move(about)};
    }
  }
  return {};
}

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
std::vector<std::string> all_keys(const FieldTree& sweep,
                                  const std::vector<PlannerDescription>& planners) {
  std::set<std::string> paths;
  add_paths(sweep, "", paths);
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
  const std::string whole(nearest_word(key, keys));
  if (!whole.empty()) found.insert(found.begin(), whole);
  if (found.empty() && !last.empty()) {
    std::vector<std::string> lasts;
    for (const std::string& other : keys) lasts.push_back(last_part(other));
    const std::string_view nearest = nearest_word(last, lasts);
    if (!nearest.empty()) found = keys_ending(keys, nearest);
  }
  constexpr std::size_t kLeastPart = 3;
  if (found.empty() && last.size() >= kLeastPart) {
    for (const std::string& other : keys) {
      if (last_part(other).find(last) != std::string::npos) found.push_back(other);
    }
  }
  std::set<std::string> seen;
  std::erase_if(found, [&](const std::string& other) { return !seen.insert(other).second; });
  constexpr std::size_t kMostShown = 5;
  if (found.size() > kMostShown) found.resize(kMostShown);
  return found;
}

/// The path as sweep files have it: map.x is maps.x, planners.ego is ego.
std::string sweep_path(const std::string& key) {
  if (key == "map" || key.starts_with("map.")) return "maps" + key.substr(3);
  if (key == "map_seed" || key == "maps.seed") return "maps.seeds";
  if (key.starts_with("planners.")) return key.substr(std::string("planners.").size());
  return key;
}

bool is_alike(const KindField& a, const KindField& b) {
  return a.field->doc == b.field->doc && a.field->preset == b.field->preset &&
         a.field->range.lowest == b.field->range.lowest &&
         a.field->range.highest == b.field->range.highest && a.field->choices == b.field->choices;
}

/// The explanations of a field that one or several kinds have; those that are alike together.
std::vector<Explanation> about_fields(const FieldTree& sweep, const std::string& path,
                                      std::vector<KindField> found) {
  std::vector<Explanation> all;
  while (!found.empty()) {
    const KindField first = found.front();
    Explanation about = about_field(sweep, path, first);
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
  const FieldTree sweep = sweep_tree();
  if (key.empty()) return about_top(sweep);
  const std::string path = sweep_path(key);
  const std::vector<KindField> found = fields_at(sweep, path);
  if (found.empty()) {
    if (auto kind = about_kind(sweep, path); !kind.empty()) return kind;
    if (auto planner = about_planner(path, planners); !planner.empty()) return planner;
    const std::vector<std::string> keys = all_keys(sweep, planners);
    const bool is_last = path.find('.') == std::string::npos;
    const std::vector<std::string> ending = keys_ending(keys, path);
    if (is_last && ending.size() == 1) return explain(ending.front(), planners);
    const std::vector<std::string> meant = suggestions(path, keys);
    throw InputError("no key '" + key + "'" +
                     (meant.empty() ? "" : " (did you mean " + listed(meant) + "?)") +
                     "; avoidbench config explain lists the keys of a sweep file");
  }
  if (auto facts = own_facts(path); !facts.empty()) {
    return {Explanation{path + ": " + found[0].field->doc, std::move(facts), {}, {}}};
  }
  if (found.front().field->kind == FieldKind::block) return about_block(path, *found[0].field);
  return about_fields(sweep, path, found);
}

}  // namespace avoidbench
