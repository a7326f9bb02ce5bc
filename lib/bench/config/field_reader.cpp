#include "config/field_reader.hpp"

#include <algorithm>
#include <set>

#include "base/words.hpp"
#include "yaml/includes.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A value with a problem leaves the preset.
template <class T>
void keep(const std::optional<T>& read, Json& value) {
  if (read) value = *read;
}

void read_list(const GivenValue& given, const FieldTree& field, Json& value) {
  if (!check_list(given, field.count)) return;
  const std::vector<GivenValue> elements = given.elements();
  const FieldTree& element = field.fields.front();
  const Json fresh = element.kind == FieldKind::block ? preset_json(element) : element.preset;
  // A list of fixed length keeps its presets where an element is wrong.
  Json list = field.count ? value : Json(elements.size(), fresh);
  // Within a list, a list is a value.
  const bool lists_were_axes = std::exchange(given.reading.lists_are_axes, false);
  for (std::size_t i = 0; i < elements.size(); ++i) read_field(elements[i], element, list[i]);
  given.reading.lists_are_axes = lists_were_axes;
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

/// The base flies the first value; one value alone is no axis.
void keep_axis(const GivenValue& given, std::vector<Json> values, Json& value) {
  if (values.empty()) return;
  value = values.front();
  if (values.size() > 1) given.reading.axes.push_back({given.path, std::move(values)});
}

/// Each value is read as if it stood alone, and then kept as a value of an axis.
void read_axis(const GivenValue& given, const FieldTree& field, Json& value) {
  std::vector<Json> values;
  const std::vector<YamlNode> nodes = axis_values(given);
  given.reading.lists_are_axes = false;
  for (const YamlNode& node : nodes) {
    // Each value begins from what is there, as blocks and fixed lists keep what is not said.
    values.push_back(value);
    read_field({node, given.path, given.reading}, field, values.back());
  }
  given.reading.lists_are_axes = true;
  keep_axis(given, std::move(values), value);
}

/// How many seeds, from 1.
void read_seed_count(const GivenValue& given, Json& value) {
  const auto count = read_whole<std::int64_t>(given, Range{1, 10000});
  std::vector<Json> seeds;
  for (std::int64_t seed = 1; seed <= count.value_or(0); ++seed) seeds.emplace_back(seed);
  keep_axis(given, std::move(seeds), value);
}

// -------------------------------------------------------------------------------------------------
// names that stand for a block

/// The file that `name` means, or "" for what is built in or unknown.
fs::path file_of(const std::string& name, const std::string& shelf, const fs::path& folder) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (is_path) return folder / name;
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

/// The file's problems keep their own places; those without one are told at the name.
void read_preset_file(const GivenValue& name, const fs::path& file, const FieldTree& block,
                      Json& value) {
  constexpr int kMostLevels = 8;
  Reading& reading = name.reading;
  if (reading.preset_level >= kMostLevels) {
    name.add_problem("presets refer to each other in a circle");
    return;
  }
  // A vehicle's file describes one vehicle.
  const bool lists_were_axes = std::exchange(reading.lists_are_axes, false);
  ++reading.preset_level;
  try {
    const Document document = read_document(file);
    check_is_part(document.root);
    read_block({document.root, name.path, reading}, block, value);
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      if (problem.line > 0) reading.problems.push_back(problem);
      if (problem.line == 0) name.add_problem(text(problem));
    }
  }
  --reading.preset_level;
  reading.lists_are_axes = lists_were_axes;
}

/// Reads the block that a name stands for; the path is the block's.
void read_name(const GivenValue& given, const FieldTree& block, Json& value) {
  const std::string& name = given.node.scalar;
  const FieldTree& preset = *block.find("preset");
  // A camera of a rig is a sensor.
  const std::string what = given.path.substr(0, given.path.find('.'));
  const std::string shelf = what + "s";
  const fs::path folder = folder_of(given.node, given.reading.folder);
  const fs::path file = file_of(name, shelf, folder);
  // A file wins over a built-in name: a user's own firefly is meant.
  if (!file.empty()) return read_preset_file(given, file, block, value);
  const auto built_in = std::find(preset.choices.begin(), preset.choices.end(), name);
  if (built_in != preset.choices.end()) {
    value = preset.named[static_cast<std::size_t>(built_in - preset.choices.begin())];
    return;
  }
  const std::vector<std::string> names = known_names(preset, shelf, folder);
  given.add_problem(found_text(given.node) + " is not a " + what + did_you_mean(name, names) +
                    "; known: " + joined(names));
}

/// Fields given beside one from which they follow.
void check_settled(const GivenValue& given, const FieldTree& block, const Json& value) {
  for (const FieldTree& field : block.fields) {
    if (field.settles.empty() || value.at(field.name) == 0.0) continue;
    for (const std::string& name : field.settles) {
      const YamlNode* other = given.node.find(name);
      if (other == nullptr) continue;
      given.at(*other, name).add_problem(follows_text(field, value));
    }
  }
}

}  // namespace

std::string follows_text(const FieldTree& field, const Json& block) {
  return "follows from " + field.name + ", which is " +
         number_text(block.at(field.name).get<double>()) + "; leave one of the two out";
}

void read_field(const GivenValue& given, const FieldTree& field, Json& value) {
  if (given.reading.lists_are_axes && is_axis(given.node, field)) {
    return read_axis(given, field, value);
  }
  switch (field.kind) {
    case FieldKind::truth:
      return keep(read_truth(given), value);
    case FieldKind::whole:
      if (field.is_signed) return keep(read_whole<std::int64_t>(given, field.range), value);
      return keep(read_whole<std::uint64_t>(given, field.range), value);
    case FieldKind::number:
      return keep(read_number(given, field.range), value);
    case FieldKind::text:
      return keep(read_text(given), value);
    case FieldKind::choice:
    case FieldKind::variant:
      return keep(read_choice(given, field.choices), value);
    case FieldKind::list:
      return read_list(given, field, value);
    case FieldKind::block:
      return read_block(given, field, value);
    case FieldKind::other:
      break;  // whoever knows the key reads it
  }
}

namespace {

/// Of a block's variants those that have this key: "generator forest, hall".
std::string kinds_with(const FieldTree& block, std::string_view key) {
  std::string found;
  for (const FieldTree& field : block.fields) {
    if (field.kind != FieldKind::variant) continue;
    for (const FieldTree& kind : field.fields) {
      if (kind.find(key) == nullptr) continue;
      found += (found.empty() ? field.name + " " : ", ") + kind.name;
    }
  }
  return found;
}

/// Whether the block names a kind under a key that there is not, as `kind: hall` for `generator:
/// hall`; adds the problem. What else it holds is of that kind.
bool has_misnamed_kind(const GivenValue& given, const FieldTree& block) {
  for (const FieldTree& field : block.fields) {
    if (field.kind != FieldKind::variant || given.node.find(field.name) != nullptr) continue;
    for (std::size_t i = 0; i < given.node.keys.size(); ++i) {
      const YamlNode& key = given.node.keys[i];
      const bool is_key =
          block.find(key.scalar) != nullptr || !kinds_with(block, key.scalar).empty();
      if (is_key || !contains(field.choices, given.node.items[i].scalar)) continue;
      given.at(key, key.scalar).add_problem("unknown key (did you mean " + field.name + "?)");
      return true;
    }
  }
  return false;
}

/// Passes over the keys of all kinds of a variant.
void take_all(MappingReader& mapping, const FieldTree& variant) {
  for (const FieldTree& kind : variant.fields) {
    for (const FieldTree& field : kind.fields) {
      mapping.take(field.name);
      if (field.kind == FieldKind::variant) take_all(mapping, field);
    }
  }
}

}  // namespace

std::string read_key(MappingReader& mapping, const FieldTree& field, Json& block) {
  const std::optional<GivenValue> given = mapping.take(field.name);
  if (field.kind != FieldKind::variant) {
    if (!given) return "";
    // `seeds: 3` is three seeds, `seeds: [3]` is seed 3.
    const bool is_count = field.name == "seeds" && given->node.kind == YamlNode::Kind::scalar;
    if (is_count && given->reading.lists_are_axes) {
      read_seed_count(*given, block[field.name]);
    } else {
      read_field(*given, field, block[field.name]);
    }
    return "";
  }
  // Variants: first the word, then the fields that this kind has.
  const std::string before = block.at(field.name);
  const std::optional<std::string> chosen =
      given ? read_choice(*given, field.choices) : std::optional(before);
  if (!chosen) {
    // The other keys are those of the kind that was meant, whichever that is.
    take_all(mapping, field);
    return "";
  }
  const std::string& kind = *chosen;
  // Another kind than the one before: its fields go, and the new kind's presets come.
  if (kind != before) {
    for (const FieldTree& old : field.find(before)->fields) block.erase(old.name);
    block[field.name] = kind;
    block.update(preset_json(*field.find(kind)));
  }
  for (const FieldTree& of_kind : field.find(kind)->fields) read_key(mapping, of_kind, block);
  return field.name + " " + kind;
}

void read_block(const GivenValue& given, const FieldTree& block, Json& value) {
  Reading& reading = given.reading;
  const bool has_presets = block.find("preset") != nullptr;
  // A preset's file itself is no name, but an element of a list in it may be one.
  const bool may_be_name = has_presets && (reading.preset_level == 0 || given.path.ends_with(']'));
  if (may_be_name && given.node.kind == YamlNode::Kind::scalar) {
    read_name(given, block, value);
    // Behind read_name(), whose file remembers places too: the last one counts.
    return reading.remember(given.path, given.node);
  }
  MappingReader mapping(given);
  if (has_misnamed_kind(given, block)) return;
  // First of all: the other keys are laid over what the preset says.
  if (const auto preset = has_presets ? mapping.take("preset") : std::nullopt) {
    if (preset->node.kind == YamlNode::Kind::scalar) {
      read_name({preset->node, given.path, reading}, block, value);
    } else {
      preset->add_expected("a name");
    }
    reading.remember(given.path, given.node);
  }
  std::string kind;
  for (const FieldTree& field : block.fields) {
    if (field.kind == FieldKind::other) {  // whoever knows the key reads it
      mapping.take(field.name);
      continue;
    }
    const std::string of_field = read_key(mapping, field, value);
    if (!of_field.empty()) kind = of_field;
  }
  check_settled(given, block, value);
  mapping.finish(kind, [&](std::string_view key) { return kinds_with(block, key); });
}

}  // namespace avoidbench
