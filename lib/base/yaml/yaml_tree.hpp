#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.hpp"

namespace avoidbench {

/// A YAML document as a plain tree that knows where each value stands. Aliases are expanded. The
/// one file that knows the YAML library is yaml_tree.cpp.
struct YamlNode {
  enum class Kind { null, scalar, list, mapping };

  Kind kind = Kind::null;
  std::shared_ptr<const std::string>
      source;                   ///< file name, or the command-line option that gave it
  int line = 0, column = 0;     ///< from 1; 0 where it does not come from a file
  std::string scalar;           ///< the text of a scalar
  bool is_quoted = false;       ///< a scalar in quotes is text, never a number
  std::vector<YamlNode> keys;   ///< of a mapping: scalars, one for each item, all different
  std::vector<YamlNode> items;  ///< of a list or a mapping

  /// The value of `key` in a mapping, or null.
  const YamlNode* find(std::string_view key) const;
  /// The position of `key` in a mapping, keys.size() where it is not there.
  std::size_t index_of(std::string_view key) const;
  /// Takes a key out of a mapping, with its value.
  void erase(std::size_t index);
};

/// What holds `scalar` or nothing, at the place of another node, and in quotes where that is.
YamlNode node_at(const YamlNode& place, YamlNode::Kind kind, std::string scalar = "");

/// `{key: value}` at the place of another node.
YamlNode mapping_at(const YamlNode& place, std::string key, YamlNode value);

/// Whether a key is made of letters, digits, _, - and . as those of our files are.
bool is_name(std::string_view key);

/// A problem at the node's place.
InputProblem problem_at(const YamlNode& node, std::string message);

/// What a node is, for messages: `"wide"`, `nothing`, `a list`, `a mapping`.
std::string found_text(const YamlNode& node);

/// The document in `text`, aliases and merge keys (`<<`) expanded. Throws InputError with the place
/// for bytes that are not UTF-8, a syntax error, a key given twice,
/// a key that is no scalar, a second document, an empty document, or one that is too large or too
/// deep (aliases expanded).
YamlNode parse_yaml(const std::string& text, const std::string& source);

/// As parse_yaml, for a file, or standard input for "-". Throws InputError where it can't be read.
YamlNode read_yaml(const std::filesystem::path& file);

}  // namespace avoidbench
