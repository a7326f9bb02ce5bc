#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "plugin/call_clock.hpp"
#include "plugin/cpu_meter.hpp"
#include "plugin/planner_description.hpp"

namespace avoidbench {

/// A loaded planner library, or a started program behind the same table, checked: symbol, ABI
/// number, sizes, names, ranges, function pointers. It stays loaded until the process ends (never
/// dlclose: a planner may have left threads or thread-local destructors behind).
class PlannerLibrary {
 public:
  /// Loads it into this process, which runs its constructors here; see describe_planner. They count
  /// as a call of `clock`, where given. Throws InputError that says which file and what is wrong
  /// with it.
  static PlannerLibrary load(const PlannerSource& source, CallClock* clock = nullptr);

  /// What load looks at before it runs code of the planner. Throws InputError as it does.
  static void check(const PlannerSource& source);

  /// As load, of a file that was checked, without its digest.
  static PlannerLibrary load_checked(const PlannerSource& source, CallClock* clock = nullptr);

  /// The one whose table this is, which must be sound; threads of `owner` are its own.
  static PlannerLibrary with_table(const PlannerSource& source, const ab_planner& table,
                                   ThreadOwner owner);

  /// Whether the planner is no library but a program, to be started: what a command starts, a .py,
  /// and what may be executed and is no shared library.
  static bool is_program(const PlannerSource& source);

  /// Whether code of any library was run in this process.
  static bool is_any_loaded();

  const PlannerDescription& description() const { return description_; }
  const ab_planner& table() const { return *table_; }
  ThreadOwner thread_owner() const { return thread_owner_; }  ///< of threads that loading started

 private:
  PlannerDescription description_;
  const ab_planner* table_ = nullptr;
  ThreadOwner thread_owner_ = kHostThreads;
};

/// Where bare names are looked up, in order: AVOIDBENCH_PLANNER_PATH (colon-separated), the build
/// tree's planners/ beside the program, the install's plugin folder.
std::vector<std::filesystem::path> planner_search_path();

/// The file of `plugin`: a bare name is looked up as NAME.so along the search path, NAME.py as it
/// is in `base_folder` and then there; anything with a slash is a path, relative ones to
/// `base_folder`. Throws InputError with the places tried and a suggestion.
std::filesystem::path find_planner(const std::string& plugin,
                                   const std::filesystem::path& base_folder);

/// Every planner library and .py on the search path, described and sorted by name; files that don't
/// load are left out and named in `problems`.
std::vector<PlannerDescription> list_planners(std::vector<std::string>& problems);

/// A parameter's value as configured: numbers for AB_NUMBER and AB_INTEGER, text for the rest.
struct ParameterValue {
  double number = 0.0;
  std::string text;
};
using ParameterValues = std::map<std::string, ParameterValue>;

/// What is wrong with `given` (unknown names with a suggestion, out of range, not whole, no such
/// choice), one line each.
std::vector<std::string> check_parameters(const PlannerDescription& planner,
                                          const ParameterValues& given);

/// One value for each declared parameter, in order: `given` where there is one, else that of the
/// profile which the choices choose, else the default.
std::vector<ParameterValue> resolve_parameters(const PlannerDescription& planner,
                                               const ParameterValues& given);

}  // namespace avoidbench
