#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/yaml_tree.hpp"

namespace avoidbench {

/// A field that was given several values.
struct ReadAxis {
  std::string path;
  std::vector<nlohmann::json> values;
};

struct GivenValue;

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
  /// The value of `path`, of which only the place is known: its own, or that of the nearest block
  /// above it that was given.
  GivenValue at(const std::string& path);

 private:
  std::map<std::string, YamlNode> places_;  ///< nodes without what they hold
};

/// A value to read, and the reading that gets its problems.
struct GivenValue {
  const YamlNode& node;
  std::string path;  ///< its dotted name in messages; "" for the outermost mapping
  Reading& reading;

  /// Adds "path: message" at the value's place. Returns nothing, as readers do after a problem.
  std::nullopt_t add_problem(const std::string& message) const;
  /// Adds "path: expected `what`, found …".
  std::nullopt_t add_expected(const std::string& what) const;
  /// Adds all that is wrong in a file or program that the value names.
  std::nullopt_t add_problems(const InputError& error) const;

  /// The elements of a list, "path[0]" and so on.
  std::vector<GivenValue> elements() const;
  /// `below` as the value of a key, "path.name".
  GivenValue at(const YamlNode& below, std::string_view name) const;
};

/// Takes the keys of a mapping one by one; what is left is unknown.
class MappingReader {
 public:
  explicit MappingReader(GivenValue mapping);

  /// The value of the key `name`, if it is there.
  std::optional<GivenValue> take(std::string_view name);

  /// Adds a problem for each key that was not asked for, unknown "for generator forest" where
  /// `kind` says so. `others` tells whose key it is instead ("generator hall"), "" if nobody's.
  void finish(const std::string& kind = "",
              const std::function<std::string(std::string_view)>& others = {});

 private:
  GivenValue mapping_;
  std::vector<std::string> names_;
};

}  // namespace avoidbench
