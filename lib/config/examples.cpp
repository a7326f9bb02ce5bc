#include "config/examples.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "config/cross_checks.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

std::string scalar_yaml(const OrderedJson& json) {
  if (json.is_number_float()) return number_text(json.get<double>());
  if (!json.is_string()) return json.dump();
  const std::string text = json.get<std::string>();
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '/';
  };
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.scalar = text;
  const bool means_itself = !text.empty() && !number_of(node) && text != "true" &&
                            text != "false" && text != "null" && text.front() != '.';
  return means_itself && std::all_of(text.begin(), text.end(), is_plain) ? text : json.dump();
}

/// Other numbers than `value`, from near to far.
std::vector<double> other_numbers(double value, const FieldTree& field) {
  const Range range = field.range;
  std::vector<double> others{value * 2.0, value / 2.0,  value + 1.0,  value - 1.0,
                             value + 2.0, range.lowest, range.highest};
  const bool is_whole = field.kind == FieldKind::whole;
  std::erase_if(others, [&](double other) {
    return !std::isfinite(other) || other == value || other < range.lowest ||
           other > range.highest || (is_whole && std::floor(other) != other);
  });
  return others;
}

Json as_number(double value, const FieldTree& field) {
  if (field.kind == FieldKind::whole) return static_cast<std::int64_t>(value);
  return value;
}

/// Lists of numbers with all their elements changed alike.
std::vector<Json> other_lists(const FieldTree& field) {
  const FieldTree& element = field.fields.front();
  if (field.preset.empty() || !field.preset.front().is_number()) return {};
  std::vector<Json> others;
  const std::vector<std::function<double(double)>> changes{
      [](double x) { return x * 2.0; }, [](double x) { return x / 2.0; },
      [](double x) { return x + 1.0; }, [](double x) { return x - 1.0; }};
  for (const auto& change : changes) {
    Json list = Json::array();
    bool is_good = true;
    for (const Json& value : field.preset) {
      const double other = change(value.get<double>());
      is_good = is_good && other >= element.range.lowest && other <= element.range.highest;
      list.push_back(as_number(other, element));
    }
    if (is_good && list != field.preset) others.push_back(std::move(list));
  }
  return others;
}

std::vector<Json> other_values(const FieldTree& field) {
  std::vector<Json> others;
  switch (field.kind) {
    case FieldKind::truth:
      others.emplace_back(!field.preset.get<bool>());
      break;
    case FieldKind::whole:
    case FieldKind::number:
      for (const double other : other_numbers(field.preset.get<double>(), field)) {
        others.push_back(as_number(other, field));
      }
      break;
    case FieldKind::choice:
      for (const std::string& choice : field.choices) {
        if (field.preset != choice) others.emplace_back(choice);
      }
      break;
    case FieldKind::list:
      return other_lists(field);
    default:
      if (!field.preset.get<std::string>().empty()) {
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

}  // namespace

std::string flow_yaml(const OrderedJson& json) {
  if (!json.is_structured()) return scalar_yaml(json);
  std::string all;
  for (const auto& [key, value] : json.items()) {
    all += all.empty() ? "" : ", ";
    if (json.is_object()) all += key + ": ";
    all += flow_yaml(value);
  }
  return json.is_object() ? "{" + all + "}" : "[" + all + "]";
}

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
  return text.substr(1, text.size() - 2);
}

std::vector<Json> example_values(const FieldTree& sweep, const std::string& path,
                                 const KindField& field) {
  if (field.field->preset.is_null() || field.field->preset == "") return {};
  std::vector<Json> values{field.field->preset};
  const FieldTree trial = field_tree("", TrialSpec{}, "");
  Json base = preset_json(trial);
  const std::size_t dot = path.find('.');
  if (dot != std::string::npos) {  // the block with the kinds that the field needs
    const std::string key = path.substr(0, dot);
    std::vector<SaidKind> kinds;
    for (const SaidKind& said : field.kinds) {
      kinds.push_back({said.path.substr(dot + 1), said.kind});
    }
    base[key == "maps" ? "map" : key].update(preset_json(*sweep.find(key), kinds));
  }
  const std::size_t before = contradictions(spec_from_json<TrialSpec>(base)).size();
  for (const Json& other : other_values(*field.field)) {
    const Json changed = trial_with(base, path, other);
    if (contradictions(spec_from_json<TrialSpec>(changed)).size() > before) continue;
    values.push_back(other);
    break;
  }
  return values;
}

std::vector<Json> example_values(const FieldTree& field) {
  if (field.preset.is_null() || field.preset == "") return {};
  std::vector<Json> values{field.preset};
  const std::vector<Json> others = other_values(field);
  if (!others.empty()) values.push_back(others.front());
  return values;
}

}  // namespace avoidbench
