#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/yaml_tree.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {

/// A field that was given several values.
struct ReadAxis {
  std::string path;
  std::vector<nlohmann::json> values;
};

/// What a reading collects: every problem rather than the first, the axes where a list stands for
/// one value, and where each value stands.
struct Reading {
  std::vector<InputProblem> problems;
  std::vector<ReadAxis> axes;
  bool lists_are_axes = false;
  std::filesystem::path folder = ".";  ///< of names that the command line gives
  int preset_level = 0;                ///< how many presets are being read, one within the other

  /// Remembers where the value of `path` stands; the last place counts.
  void remember(const std::string& path, const YamlNode& node);
  /// Where the value of `path` stands, or the nearest block above it that was given.
  const YamlNode& place(std::string path) const;
  /// Adds "path: message" at the place of `path`.
  void add_problem(const std::string& path, const std::string& message);

 private:
  std::map<std::string, YamlNode> places_;  ///< nodes without what they hold
};

/// Takes the keys of a mapping one by one; what is left is unknown.
class MappingReader {
 public:
  /// `path` is the dotted name of the mapping in messages, "" for the outermost.
  MappingReader(const YamlNode& node, std::string path, Reading& reading);

  /// The value of the key `name`, or null.
  const YamlNode* take(std::string_view name);

  /// Adds a problem for each key that was not asked for, unknown "for generator forest" where
  /// `kind` says so.
  void finish(const std::string& kind = "");

  std::string path_of(std::string_view name) const;

 private:
  const YamlNode& node_;
  std::string path_;
  Reading& reading_;
  std::vector<std::string> names_;
};

}  // namespace avoidbench
