#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "avoidbench/planner.h"

namespace avoidbench {

/// What a planner's library says of itself.
struct ParameterDef {
  std::string name, unit, doc;
  std::int32_t kind = AB_NUMBER;  ///< AB_NUMBER …
  double lowest = 0.0, highest = 0.0, preset = 0.0;
  std::vector<std::string> choices;
  std::string preset_text;
};

struct PlannerDescription {
  std::string name, version, summary;
  std::uint32_t needs = 0, commands = 0;  ///< AB_SEES_… and AB_COMMAND_… bits
  std::vector<ParameterDef> parameters;
  std::filesystem::path file;
  std::string file_digest;  ///< SHA-256 of the library
};

/// A loaded planner library, checked: symbol, ABI number, sizes, names, ranges, function pointers.
/// It stays loaded until the process ends (never dlclose: a planner may have left threads or
/// thread-local destructors behind).
class PlannerLibrary {
 public:
  /// Throws InputError that says which file and what is wrong with it.
  static PlannerLibrary load(const std::filesystem::path& file);

  const PlannerDescription& description() const { return description_; }
  const ab_planner& table() const { return *table_; }

 private:
  PlannerDescription description_;
  const ab_planner* table_ = nullptr;
};

/// Where bare names are looked up, in order: AVOIDBENCH_PLANNER_PATH (colon-separated), the build
/// tree's planners/ beside the program, the install's plugin folder.
std::vector<std::filesystem::path> planner_search_path();

/// The library file of `plugin`: a bare name is looked up as NAME.so along the search path;
/// anything with a slash is a path, relative ones to `base_folder`. Throws InputError with the
/// places tried and a suggestion.
std::filesystem::path find_planner(const std::string& plugin,
                                   const std::filesystem::path& base_folder);

/// Every planner library on the search path, sorted by name; files that don't load are left out and
/// named in `problems`.
std::vector<PlannerDescription> list_planners(std::vector<std::string>& problems);

/// A parameter's value as configured: numbers for AB_NUMBER and AB_INTEGER, text for the rest.
struct ParameterValue {
  double number = 0.0;
  std::string text;
};
using ParameterValues = std::map<std::string, ParameterValue>;

/// One value for each declared parameter, in order: `given` where there is one, else the preset.
/// Returns what is wrong with `given` (unknown names with a suggestion, out of range, not whole, no
/// such choice), one line each.
std::vector<std::string> check_parameters(const PlannerDescription& planner,
                                          const ParameterValues& given);
std::vector<ParameterValue> resolve_parameters(const PlannerDescription& planner,
                                               const ParameterValues& given);

}  // namespace avoidbench
