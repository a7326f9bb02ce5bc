#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "process/sandbox.hpp"
#include "program_planner/planner_source.hpp"

namespace avoidbench {

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

/// A file that decides what a planner does; see ab_files.
struct PlannerFile {
  std::string
      name;  ///< as the planner gives it: relative to the folder of its own file, or absolute
  std::string digest;  ///< SHA-256
};

/// What a planner's library or program says of itself.
struct PlannerDescription {
  std::string name, version, summary;
  std::uint32_t needs = 0, commands = 0;  ///< AB_INPUT_… and AB_COMMAND_… bits
  std::vector<ParameterDef> parameters;
  std::vector<ProfileDef> profiles;
  double least_fov_x_rad = 0.0, least_fov_y_rad = 0.0;  ///< of each camera; 0: any
  std::vector<std::string> file_names;                  ///< of AB_FILES_EXTENSION
  std::filesystem::path file;
  std::vector<std::string> command;  ///< of a program that is started in a way of its own
  bool is_program = false;
  std::string file_digest;         ///< see planner_digest()
  std::vector<PlannerFile> files;  ///< empty, or its own file and then those that it names
};

/// The planner's own file and those that it names, as they are now. Empty where it names none.
/// Throws InputError where one can't be read.
std::vector<PlannerFile> planner_files(const std::filesystem::path& file,
                                       const std::vector<std::string>& names);

/// By what trials know a planner: the SHA-256 of its library or program; where it names further
/// files, one of the SHA-256 of them all.
std::string planner_digest(const std::filesystem::path& file,
                           const std::vector<PlannerFile>& files);
/// The same of the files of these names as they are now.
std::string digest_now(const std::filesystem::path& file, const std::vector<PlannerFile>& files);

/// What the sandbox grants a planner that declares these needs (AB_USES_… bits).
SandboxRules sandbox_rules(std::uint32_t needs);

/// What a library or program says of itself. To ask it is to run its code, which can do anything:
/// that runs in a process of their own (run_isolated) and in the sandbox, as far as the
/// kernel has one; it is killed with all that it started after `time_limit_s`. Throws InputError
/// that names the file and says what is wrong with it, as PlannerLibrary::load does, or how that
/// process ended.
PlannerDescription describe_planner(const PlannerSource& source, double time_limit_s);

/// The same within the time limit of the environment's AVOIDBENCH_LOAD_LIMIT_S, else 10 s. Asks
/// again only for a file that changed since this process asked for it.
PlannerDescription describe_planner(const PlannerSource& source);

}  // namespace avoidbench
