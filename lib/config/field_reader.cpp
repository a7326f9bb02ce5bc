#include "config/field_reader.hpp"

#include <algorithm>
#include <set>

#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A value with a problem leaves the preset.
template <class T>
void keep(const std::optional<T>& read, Json& value) {
  if (read) value = *read;
}

void read_list(const YamlNode& node, const FieldTree& field, const std::string& path, Json& value,
               Reading& reading) {
  if (!check_list(node, path, field.count, reading.problems)) return;
  const FieldTree& element = field.fields.front();
  const Json fresh = element.kind == FieldKind::block ? preset_json(element) : element.preset;
  // A list of fixed length keeps its presets where an element is wrong.
  Json list = field.count ? value : Json(node.items.size(), fresh);
  // Within a list, a list is a value.
  const bool lists_were_axes = std::exchange(reading.lists_are_axes, false);
  for (std::size_t i = 0; i < node.items.size(); ++i) {  // an element has no path of its own
    read_field(node.items[i], element, path + "[" + std::to_string(i) + "]", list[i], reading);
  }
  reading.lists_are_axes = lists_were_axes;
  value = std::move(list);
}

/// Whether several values are given.
/// A list where one value is wanted, or a range; where a list is wanted, a list of lists.
bool is_axis(const YamlNode& node, const FieldTree& field) {
  const bool is_list = node.kind == YamlNode::Kind::list;
  if (field.kind == FieldKind::block) return false;
  if (field.kind != FieldKind::list) return is_list || node.kind == YamlNode::Kind::mapping;
  return is_list && !node.items.empty() && node.items.front().kind == YamlNode::Kind::list;
}

/// Each value is read as if it stood alone, and then kept as a value of an axis.
void read_axis(const YamlNode& node, const FieldTree& field, const std::string& path, Json& value,
               Reading& reading) {
  ReadAxis axis{path, {}};
  const std::vector<YamlNode> nodes = axis_values(node, path, reading.problems);
  reading.lists_are_axes = false;
  for (const YamlNode& one : nodes) {
    // Each value begins from what is there, as blocks and fixed lists keep what is not said.
    axis.values.push_back(value);
    read_field(one, field, path, axis.values.back(), reading);
  }
  reading.lists_are_axes = true;
  if (axis.values.empty()) return;
  // The base flies the first value; one value alone is no axis.
  value = axis.values.front();
  if (nodes.size() > 1) reading.axes.push_back(std::move(axis));
}

/// How many seeds, from 1.
void read_seed_count(const YamlNode& node, const std::string& path, Json& value, Reading& reading) {
  const auto count = read_whole(node, path, Range{1, 10000}, reading.problems);
  if (!count) return;
  ReadAxis axis{path, {}};
  for (std::int64_t seed = 1; seed <= *count; ++seed) axis.values.emplace_back(seed);
  value = axis.values.front();
  if (*count > 1) reading.axes.push_back(std::move(axis));
}

// -------------------------------------------------------------------------------------------------
// names that stand for a block

/// The file that `name` means, or "" for what is built in or unknown.
fs::path file_of(const std::string& name, const std::string& shelf, const fs::path& folder) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (is_path) return fs::path(name).is_absolute() ? fs::path(name) : folder / name;
  std::error_code error;
  // vehicles/ beside the sweep, or beside the folder of sweeps.
  for (const fs::path& place : {folder / shelf, folder / ".." / shelf}) {
    const fs::path file = (place / (name + ".yaml")).lexically_normal();
    if (fs::is_regular_file(file, error)) return file;
  }
  return {};
}

/// Names of the built-in ones and of the files.
std::vector<std::string> known_names(const FieldTree& preset, const std::string& shelf,
                                     const fs::path& folder) {
  std::set<std::string> names(preset.choices.begin(), preset.choices.end());
  std::error_code error;
  for (const fs::path& place : {folder / shelf, folder / ".." / shelf}) {
    for (const auto& entry : fs::directory_iterator(place, error)) {
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

/// The file's problems keep their own places; those without one are told at `name`.
void read_preset_file(const YamlNode& name, const fs::path& file, const FieldTree& block,
                      const std::string& path, Json& value, Reading& reading) {
  constexpr int kMostLevels = 8;
  if (reading.preset_level >= kMostLevels) {
    reading.problems.push_back(problem_at(name, path + ": presets lead in a circle"));
    return;
  }
  // A vehicle's file describes one vehicle.
  const bool lists_were_axes = std::exchange(reading.lists_are_axes, false);
  ++reading.preset_level;
  try {
    read_block(read_document(file).root, block, path, value, reading);
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      const bool has_place = problem.line > 0;
      reading.problems.push_back(has_place ? problem
                                           : problem_at(name, path + ": " + text(problem)));
    }
  }
  --reading.preset_level;
  reading.lists_are_axes = lists_were_axes;
}

/// Reads the block that a name stands for.
void read_name(const YamlNode& node, const FieldTree& block, const std::string& path, Json& value,
               Reading& reading) {
  const FieldTree& preset = *block.find("preset");
  const std::string what = path.substr(0, path.find('.'));  // a camera of a rig is a sensor
  const std::string shelf = what + "s";
  const fs::path folder = folder_of(node, reading.folder);
  const fs::path file = file_of(node.scalar, shelf, folder);
  // A file wins over a built-in name: a user's own firefly is meant.
  if (!file.empty()) return read_preset_file(node, file, block, path, value, reading);
  const auto built_in = std::find(preset.choices.begin(), preset.choices.end(), node.scalar);
  if (built_in != preset.choices.end()) {
    value = preset.named[static_cast<std::size_t>(built_in - preset.choices.begin())];
    return;
  }
  const std::vector<std::string> names = known_names(preset, shelf, folder);
  reading.problems.push_back(problem_at(node, path + ": " + found_text(node) + " is no " + what +
                                                  did_you_mean(node.scalar, names) +
                                                  "; known: " + listed(names)));
}

}  // namespace

void read_field(const YamlNode& node, const FieldTree& field, const std::string& path, Json& value,
                Reading& reading) {
  std::vector<InputProblem>& problems = reading.problems;
  if (reading.lists_are_axes && is_axis(node, field)) {
    return read_axis(node, field, path, value, reading);
  }
  switch (field.kind) {
    case FieldKind::truth:
      return keep(read_truth(node, path, problems), value);
    case FieldKind::whole:
      if (!field.is_signed) return keep(read_unsigned(node, path, field.range, problems), value);
      return keep(read_whole(node, path, field.range, problems), value);
    case FieldKind::number:
      return keep(read_number(node, path, field.range, problems), value);
    case FieldKind::text:
      return keep(read_text(node, path, problems), value);
    case FieldKind::choice:
    case FieldKind::variant:
      return keep(read_choice(node, path, field.choices, problems), value);
    case FieldKind::list:
      return read_list(node, field, path, value, reading);
    case FieldKind::block:
      return read_block(node, field, path, value, reading);
    case FieldKind::other:
      break;  // whoever knows the key reads it
  }
}

std::string read_key(MappingReader& mapping, const FieldTree& field, Json& block,
                     Reading& reading) {
  const YamlNode* node = mapping.take(field.name);
  const std::string path = mapping.path_of(field.name);
  if (field.kind != FieldKind::variant) {
    if (node == nullptr) return "";
    // `seeds: 3` is three seeds, `seeds: [3]` is seed 3.
    const bool is_count = field.name == "seeds" && node->kind == YamlNode::Kind::scalar;
    if (is_count && reading.lists_are_axes) {
      read_seed_count(*node, path, block[field.name], reading);
    } else {
      read_field(*node, field, path, block[field.name], reading);
    }
    return "";
  }
  // Variants: first the word, then the fields that this kind has.
  Json kind = block.at(field.name);
  if (node != nullptr) keep(read_choice(*node, path, field.choices, reading.problems), kind);
  // Another kind than the one before: its fields go, and the new kind's presets come.
  if (kind != block.at(field.name)) {
    for (const FieldTree& old : field.find(block.at(field.name).get<std::string>())->fields) {
      block.erase(old.name);
    }
    block[field.name] = kind;
    block.update(preset_json(*field.find(kind.get<std::string>())));
  }
  for (const FieldTree& of_kind : field.find(kind.get<std::string>())->fields) {
    read_key(mapping, of_kind, block, reading);
  }
  return field.name + " " + kind.get<std::string>();
}

void read_block(const YamlNode& node, const FieldTree& block, const std::string& path, Json& value,
                Reading& reading) {
  const bool has_presets = block.find("preset") != nullptr;
  // A preset's file itself is no name, but an element of a list in it may be one.
  const bool may_be_name = has_presets && (reading.preset_level == 0 || path.ends_with(']'));
  if (may_be_name && node.kind == YamlNode::Kind::scalar) {
    read_name(node, block, path, value, reading);
    // Behind read_name(), whose file remembers places too: the last one counts.
    return reading.remember(path, node);
  }
  MappingReader mapping(node, path, reading);
  // First of all: the other keys are laid over what the preset says.
  if (const YamlNode* preset = has_presets ? mapping.take("preset") : nullptr) {
    if (preset->kind == YamlNode::Kind::scalar) {
      read_name(*preset, block, path, value, reading);
    } else {
      reading.add_problem(path + ".preset", "expected a name, found " + found_text(*preset));
    }
    reading.remember(path, node);
  }
  std::string kind;
  for (const FieldTree& field : block.fields) {
    if (field.kind == FieldKind::other) {  // whoever knows the key reads it
      mapping.take(field.name);
      continue;
    }
    const std::string of_field = read_key(mapping, field, value, reading);
    if (!of_field.empty()) kind = of_field;
  }
  mapping.finish(kind);
}

}  // namespace avoidbench
