#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "process/sandbox.hpp"

namespace avoidbench {

/// What a planner's library says of itself.
struct ParameterDef {
  std::string name, unit, doc;
  std::int32_t kind = AB_NUMBER;  ///< AB_NUMBER …
  double lowest = 0.0, highest = 0.0, preset = 0.0;
  std::vector<std::string> choices;
  std::string preset_text;
};

/// Defaults of other parameters while `choice` has the word `word`; see ab_profile.
struct ProfileDef {
  struct Number {
    std::string name;
    double number = 0.0;
  };
  std::string choice, word;
  std::vector<Number> numbers;
};

struct PlannerDescription {
  std::string name, version, summary;
  std::uint32_t needs = 0, commands = 0;  ///< AB_SEES_… and AB_COMMAND_… bits
  std::vector<ParameterDef> parameters;
  std::vector<ProfileDef> profiles;
  std::filesystem::path file;
  std::string file_digest;  ///< SHA-256 of the library
};

/// What the sandbox grants a planner that declares these needs (AB_USES_… bits).
SandboxRules sandbox_rules(std::uint32_t needs);

/// What the library in `file` says of itself. To ask it is to run its constructors, which can do
/// anything: they run in a process of their own (run_isolated) and in the sandbox, as far as the
/// kernel has one; it is killed with all that it started after `time_limit_s`. Throws InputError
/// that names the file and says what is wrong with it, as PlannerLibrary::load does, or how that
/// process ended.
PlannerDescription describe_planner(const std::filesystem::path& file, double time_limit_s);

/// The same within the time limit of the environment's AVOIDBENCH_LOAD_LIMIT_S, else 10 s. Asks
/// again only for a file that changed since this process asked for it.
PlannerDescription describe_planner(const std::filesystem::path& file);

}  // namespace avoidbench
