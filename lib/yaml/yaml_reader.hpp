#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "base/spec_json.hpp"
#include "yaml/yaml_tree.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {

/// What a reading collects: every problem rather than the first, and the axes where a list stands
/// for one value.
struct Reading {
  std::vector<InputProblem> problems;
  std::vector<ReadAxis> axes;
  bool lists_are_axes = false;
};

/// Reads a mapping into any spec with a visit(): the visitor of base/fields.hpp. Keys that are not
/// given leave their fields as they are. A problem leaves the field as it was.
class SpecReader {
 public:
  /// `path` is the dotted name of the spec in messages, "" for the outermost.
  SpecReader(const YamlNode& node, std::string path, Reading& reading);

  template <class T>
  void field(std::string_view name, T& value, Range range, std::string_view) {
    if (const YamlNode* node = take(name)) read_field(*node, path_of(name), value, range);
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, Variant& value, std::string_view) {
    if (const YamlNode* node = take(name)) {
      std::vector<std::string> kinds;
      add_kinds<Variant, 0>(kinds);
      const auto wanted = read_choice(*node, path_of(name), kinds, reading_.problems);
      if (wanted && *wanted != kind(value)) make_kind<Variant, 0>(*wanted, value);
    }
    kind_ = std::string(name) + " " + std::string(kind(value));
    std::visit([this](auto& held) { visit(*this, held); }, value);
  }

  /// Lets `name` stand in the mapping beside the spec's own keys; its value, or null.
  const YamlNode* take(std::string_view name);

  /// Adds a problem for each key that no field has asked for. To be called last.
  void finish();

 private:
  template <class T>
  void read_field(const YamlNode& node, const std::string& path, T& value, Range range);
  template <class T>
  bool is_axis(const YamlNode& node) const;
  template <class T>
  void read_axis(const YamlNode& node, const std::string& path, T& value, Range range);
  template <class Variant, std::size_t index>
  static void add_kinds(std::vector<std::string>& kinds);
  template <class Variant, std::size_t index>
  static void make_kind(const std::string& wanted, Variant& value);
  std::string path_of(std::string_view name) const;

  const YamlNode& node_;
  std::string path_;
  Reading& reading_;
  std::vector<std::string> names_;
  std::string kind_;  ///< "generator forest", for messages
};

/// Reads `node` into `spec`. What is wrong is added to reading.problems.
template <class Spec>
void read_spec(const YamlNode& node, const std::string& path, Spec& spec, Reading& reading) {
  SpecReader reader(node, path, reading);
  visit(reader, spec);
  reader.finish();
}

/// Reads one value of any type a field may have.
template <class T>
void read_value(const YamlNode& node, const std::string& path, T& value, Range range,
                Reading& reading) {
  std::vector<InputProblem>& problems = reading.problems;
  if constexpr (TextEnum<T>) {
    if (const auto name = read_choice(node, path, enum_texts<T>(), problems)) {
      value = *enum_from_text<T>(*name);
    }
  } else if constexpr (detail::IsSequence<T>::value) {
    constexpr bool is_fixed = !requires { value.resize(node.items.size()); };
    T read = value;
    if constexpr (is_fixed) {
      if (!check_list(node, path, value.size(), problems)) return;
    } else {
      if (!check_list(node, path, std::nullopt, problems)) return;
      read.assign(node.items.size(), {});
    }
    const bool lists_were_axes = reading.lists_are_axes;
    reading.lists_are_axes = false;  // an element has no path of its own
    for (std::size_t i = 0; i < read.size(); ++i) {
      read_value(node.items[i], path + "[" + std::to_string(i) + "]", read[i], range, reading);
    }
    reading.lists_are_axes = lists_were_axes;
    value = read;
  } else if constexpr (Visitable<T, SpecReader>) {
    read_spec(node, path, value, reading);
  } else {
    read_scalar(node, path, value, range, problems);
  }
}

template <class T>
void SpecReader::read_field(const YamlNode& node, const std::string& path, T& value, Range range) {
  if (is_axis<T>(node)) {
    read_axis(node, path, value, range);
  } else {
    read_value(node, path, value, range, reading_);
  }
}

template <class T>
bool SpecReader::is_axis(const YamlNode& node) const {
  if (!reading_.lists_are_axes) return false;
  if constexpr (detail::IsSequence<T>::value) {
    return !node.items.empty() && node.kind == YamlNode::Kind::list &&
           node.items.front().kind == YamlNode::Kind::list;
  } else if constexpr (Visitable<T, SpecReader>) {
    return false;
  } else {
    return node.kind == YamlNode::Kind::list || node.kind == YamlNode::Kind::mapping;
  }
}

template <class T>
void SpecReader::read_axis(const YamlNode& node, const std::string& path, T& value, Range range) {
  const std::vector<YamlNode> nodes = axis_values(node, path, reading_.problems);
  ReadAxis axis{path, {}, node};
  for (std::size_t i = nodes.size(); i-- > 0;) {  // the first value is left in the spec
    read_value(nodes[i], path, value, range, reading_);
    axis.values.push_back(detail::value_to_json(value));
  }
  std::reverse(axis.values.begin(), axis.values.end());
  if (nodes.size() > 1) reading_.axes.push_back(std::move(axis));
}

template <class Variant, std::size_t index>
void SpecReader::add_kinds(std::vector<std::string>& kinds) {
  if constexpr (index < std::variant_size_v<Variant>) {
    kinds.emplace_back(std::variant_alternative_t<index, Variant>::kind);
    add_kinds<Variant, index + 1>(kinds);
  }
}

template <class Variant, std::size_t index>
void SpecReader::make_kind(const std::string& wanted, Variant& value) {
  if constexpr (index < std::variant_size_v<Variant>) {
    if (std::variant_alternative_t<index, Variant>::kind == wanted) {
      value = std::variant_alternative_t<index, Variant>{};
    } else {
      make_kind<Variant, index + 1>(wanted, value);
    }
  }
}

}  // namespace avoidbench
