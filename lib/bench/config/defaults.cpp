#include "config/defaults.hpp"

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;

std::string range_comment(Range range) {
  const bool below = std::isfinite(range.lowest), above = std::isfinite(range.highest);
  if (below && above) {
    return " [" + number_text(range.lowest) + ", " + number_text(range.highest) + "]";
  }
  if (below) return " At least " + number_text(range.lowest) + ".";
  return above ? " At most " + number_text(range.highest) + "." : "";
}

/// What the file says of a key: doc, range, words. "doc [0, 1] (a | b)".
std::string comment_of(const FieldTree& field) {
  const bool has_words = !field.choices.empty();
  return field.doc + range_comment(field.range) +
         (has_words ? " (" + joined(field.choices, " | ") + ")" : "");
}

/// Comments begin in one column, or two blanks behind a longer line.
void add_line(const std::string& content, const std::string& comment, std::string& text) {
  constexpr std::size_t kCommentColumn = 36;
  std::string padded = content;
  padded.resize(std::max(padded.size() + 2, kCommentColumn), ' ');
  text += padded + "# " + comment + "\n";
}

/// The fields in the order of the tree, those of a variant's kind beside it, then what else there
/// is. JSON objects are in order of names; people expect that of the documentation.
nlohmann::ordered_json in_order(const FieldTree& block, const Json& values) {
  nlohmann::ordered_json ordered = nlohmann::ordered_json::object();
  const auto add = [&](const FieldTree& of, const auto& add_inner) -> void {
    for (const FieldTree& field : of.fields) {
      const auto found = values.find(field.name);
      if (found == values.end()) continue;  // a preset
      const bool is_block = field.kind == FieldKind::block && found->is_object();
      ordered[field.name] = is_block ? in_order(field, *found) : nlohmann::ordered_json(*found);
      if (field.kind == FieldKind::variant)
        add_inner(*field.find(found->get<std::string>()), add_inner);
    }
  };
  add(block, add);
  for (const auto& [key, value] : values.items()) {
    if (!ordered.contains(key)) ordered[key] = value;
  }
  return ordered;
}

/// One commented line for each field. `with_others`: the fields of variants' other kinds too,
/// commented out.
void add_block(const FieldTree& block, const Json& values, const std::string& indent,
               bool with_others, std::string& text) {
  for (const FieldTree& field : block.fields) {
    // A key that is no field, such as mission.list: named, commented out.
    if (field.kind == FieldKind::other && !field.facts.empty()) {
      add_line(indent + "# " + field.name + ":", field.doc, text);
    }
    if (field.kind == FieldKind::other) continue;  // a preset is told above
    const std::string key = indent + field.name + ":";
    const Json& value = values.at(field.name);
    // A list of mappings, such as cameras: one line each.
    const bool has_blocks =
        field.kind == FieldKind::list && field.fields.front().kind == FieldKind::block;
    if (field.kind == FieldKind::block) {
      add_line(key, comment_of(field), text);
      add_block(field, value, indent + "  ", with_others, text);
    } else if (has_blocks && !value.empty()) {
      add_line(key, comment_of(field), text);
      for (const Json& element : value) {
        text += indent + "  - " + flow_yaml(in_order(field.fields.front(), element)) + "\n";
      }
    } else {
      // The tree has one seed; the key takes a list of them.
      const bool is_list = field.name == "seeds";
      add_line(key + " " + flow_yaml(is_list ? Json::array({value}) : value), comment_of(field),
               text);
    }
    if (field.kind != FieldKind::variant) continue;
    // The fields of the kind that the value names stand beside the variant.
    add_block(*field.find(value.get<std::string>()), values, indent, with_others, text);
    for (const FieldTree& kind : field.fields) {
      if (!with_others || value == kind.name) continue;
      text += indent + "# " + field.name + ": " + kind.name + "\n";
      add_block(kind, preset_json(kind), indent + "# ", with_others, text);
    }
  }
}

/// A top key of a sweep; those that need not be given and have no default are commented out.
void add_key(const FieldTree& key, const Json& defaults, std::string& text) {
  const FieldTree* preset = key.find("preset");
  if (key.name == "planners") {
    text += "\n# " + key.doc + "\nplanners:\n  - straight_line\n  - reactive\n";
  } else if (key.kind == FieldKind::block) {
    text += "\n# " + key.doc + "\n";
    if (preset != nullptr) {
      text += "# A name (" + joined(preset->choices) + ", or that of " + key.name +
              "s/NAME.yaml next to the sweep's folder),\n"
              "# or fields that differ from those of `preset: NAME`, which is " +
              preset->choices.front() + " where not given.\n";
    }
    text += key.name + ":\n";
    add_block(key, defaults.at(key.name), "  ", true, text);
  } else if (!key.preset.is_null()) {
    add_line(key.name + ": " + flow_yaml(key.preset), comment_of(key), text);
  } else {
    const auto example = std::find_if(key.facts.begin(), key.facts.end(),
                                      [](const auto& fact) { return fact.first == "example"; });
    if (key.name == "axes") text += "\n";
    // Of keys without a default only the name has to be there; `planners` is above.
    add_line((key.name == "sweep" ? "" : "# ") + example->second, comment_of(key), text);
  }
}

std::string scalar_yaml(const nlohmann::ordered_json& json) {
  if (json.is_number_float()) return number_text(json.get<double>());
  if (!json.is_string()) return json.dump();
  const std::string text = json.get<std::string>();
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '/';
  };
  // What would be read as a number, a truth or nothing has to stand in quotes.
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.scalar = text;
  const bool means_itself = !text.empty() && !number_of(node) && text != "true" &&
                            text != "false" && text != "null" && text.front() != '.';
  // JSON's quotes and escapes are YAML's too.
  return means_itself && std::all_of(text.begin(), text.end(), is_plain) ? text : json.dump();
}

/// Lines of a mapping or list, each below `indent`.
void add_lines(const nlohmann::ordered_json& json, const std::string& indent, std::string& text) {
  constexpr std::size_t kWidth = 100;
  for (const auto& [key, value] : json.items()) {
    const std::string begin = indent + (json.is_object() ? scalar_yaml(key) + ":" : "-");
    const std::string flow = flow_yaml(value);
    const bool has_blocks =
        value.is_object() || (value.is_array() && !value.empty() && value.front().is_object());
    const bool fits = begin.size() + flow.size() < kWidth;
    // A list's mapping has one line where it fits, a mapping's block never.
    if (!value.is_structured() || value.empty() || (fits && (!has_blocks || json.is_array()))) {
      text += begin + " " + flow + "\n";
      continue;
    }
    if (json.is_object()) text += begin + "\n";
    const std::size_t first = text.size() + indent.size();
    add_lines(value, indent + "  ", text);
    if (json.is_array()) text[first] = '-';  // before the element's first key
  }
}

std::string sweep_yaml() {
  std::string text =
      "# A sweep with every key at its default; only 'sweep' and 'planners' must be given.\n"
      "# One value may be a list, or a range {from: 2.3, to: 5.8, count: 10} or {from, to, step}:\n"
      "# each combination of such values is flown. config explain KEY describes a key.\n";
  const Json defaults = preset_json(sweep_tree());
  for (const FieldTree& key : sweep_tree().fields) add_key(key, defaults, text);
  return text;
}

}  // namespace

std::vector<std::string> default_names() {
  std::vector<std::string> names{"sweep"};
  for (const FieldTree* tree : {&vehicle_tree(), &sensor_tree()}) {
    const std::vector<std::string>& built_in = tree->find("preset")->choices;
    names.insert(names.end(), built_in.begin(), built_in.end());
  }
  return names;
}

std::string defaults_yaml(const std::string& name) {
  if (name == "sweep") return sweep_yaml();
  for (const FieldTree* tree : {&vehicle_tree(), &sensor_tree()}) {
    const FieldTree& preset = *tree->find("preset");
    const auto found = std::find(preset.choices.begin(), preset.choices.end(), name);
    if (found == preset.choices.end()) continue;
    std::string text = "# A " + tree->name + "; see `avoidbench config defaults`.\n";
    const auto index = static_cast<std::size_t>(found - preset.choices.begin());
    add_block(*tree, preset.named[index], "", false, text);
    return text;
  }
  const std::vector<std::string> names = default_names();
  throw InputError("nothing built in is named '" + name + "'" + did_you_mean(name, names) +
                   "; it is one of " + joined(names));
}

std::string sweep_file_yaml(const Json& keys) {
  std::string text;
  add_lines(in_order(sweep_tree(), keys), "", text);
  return text;
}

std::string flow_yaml(const nlohmann::ordered_json& json) {
  if (!json.is_structured()) return scalar_yaml(json);
  std::string all;
  for (const auto& [key, value] : json.items()) {
    all += all.empty() ? "" : ", ";
    if (json.is_object()) all += key + ": ";
    all += flow_yaml(value);
  }
  return json.is_object() ? "{" + all + "}" : "[" + all + "]";
}

}  // namespace avoidbench
