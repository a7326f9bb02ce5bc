#include "plugin/planner_library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "plugin/elf_symbols.hpp"
#include "plugin/float_guard.hpp"
#include "plugin/planner_table.hpp"
#include "process/locale_guard.hpp"
#include "program_planner/program_planner.hpp"

namespace avoidbench {
namespace {

using TableFunction = const ab_planner* (*)(std::uint32_t);

std::atomic<bool> any_loaded{false};

const std::string kSymbolPrefix = "avoidbench_planner_v";

std::string wanted_symbol() { return kSymbolPrefix + std::to_string(AVOIDBENCH_ABI_VERSION); }

/// The planner symbols of other ABI versions that the library exports.
std::vector<std::string> other_versions(const std::filesystem::path& file) {
  std::vector<std::string> found;
  for (const std::string& symbol : exported_symbols(file)) {
    if (symbol.starts_with(kSymbolPrefix) && symbol != wanted_symbol()) {
      found.push_back(symbol.substr(kSymbolPrefix.size()));
    }
  }
  return found;
}

void check_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse_file(file, "no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse_file(file, "is not a file");
  const std::string problem = shared_library_problem(file);
  if (problem.empty()) return;
  // Not where it is a library that is wrong in another way: nobody meant a program then.
  const bool is_other_kind = problem.starts_with("is not a shared library");
  refuse_file(
      file,
      problem +
          (is_other_kind ? "; nor a program: those end in .py or are executable (chmod +x)" : ""));
}

/// Threads that start for as long as it lives are the library's.
class LoadingThreads {
 public:
  explicit LoadingThreads(ThreadOwner owner) { threads_belong_to(owner); }
  ~LoadingThreads() { threads_belong_to(kHostThreads); }
  LoadingThreads(const LoadingThreads&) = delete;
  LoadingThreads& operator=(const LoadingThreads&) = delete;
};

/// Looked at before loading, since to load a library is to run its constructors.
void check_symbol(const std::filesystem::path& file) {
  const std::vector<std::string> symbols = exported_symbols(file);
  if (std::find(symbols.begin(), symbols.end(), wanted_symbol()) != symbols.end()) return;
  const std::vector<std::string> others = other_versions(file);
  if (others.empty()) {
    refuse_file(file, "is a shared library but not a planner: it does not export " +
                          wanted_symbol() + " (AVOIDBENCH_PLANNER(Class) in planner.hpp does)");
  }
  std::string versions;
  for (const std::string& version : others) versions += (versions.empty() ? "" : ", ") + version;
  refuse_file(file, "is a planner of ABI " + versions + ", this program needs ABI " +
                        std::to_string(AVOIDBENCH_ABI_VERSION) +
                        ": build it against this version's planner.h");
}

const ab_planner* table_from(const std::filesystem::path& file, TableFunction function) {
  const ab_planner* table = nullptr;
  try {
    table = function(AVOIDBENCH_ABI_VERSION);
  } catch (const std::exception& error) {
    refuse_file(file, wanted_symbol() + " threw an exception: " + error.what());
  } catch (...) {
    refuse_file(file, wanted_symbol() + " threw an exception");
  }
  if (table == nullptr) {
    refuse_file(file, "the planner refuses ABI " + std::to_string(AVOIDBENCH_ABI_VERSION) +
                          ": it was built for another version");
  }
  return table;
}

}  // namespace

bool PlannerLibrary::is_program(const PlannerSource& source) {
  // A command is a program by itself.
  if (!source.command.empty()) return true;
  if (!can_be_started(source.file)) return false;
  // What may be executed may still be a library: linkers set the bit for both.
  return is_elf_program(source.file) || !shared_library_problem(source.file).empty();
}

void PlannerLibrary::check(const PlannerSource& source) {
  std::error_code error;
  if (std::filesystem::is_regular_file(source.file, error) && is_program(source)) return;
  check_file(source.file);
  check_symbol(source.file);
}

bool PlannerLibrary::is_any_loaded() { return any_loaded; }

PlannerLibrary PlannerLibrary::load(const PlannerSource& source, CallClock* clock) {
  check(source);
  PlannerLibrary library = load_checked(source, clock);
  PlannerDescription& planner = library.description_;
  planner.files = planner_files(source.file, planner.file_names);
  planner.file_digest = planner_digest(source.file, planner.files);
  return library;
}

PlannerLibrary PlannerLibrary::with_table(const PlannerSource& source, const ab_planner& table,
                                          ThreadOwner owner) {
  PlannerLibrary library;
  library.table_ = &table;
  library.thread_owner_ = owner;
  library.description_ = describe_table(table);
  library.description_.file = source.file;
  library.description_.command = source.command;
  return library;
}

PlannerLibrary PlannerLibrary::load_checked(const PlannerSource& source, CallClock* clock) {
  const std::filesystem::path& file = source.file;
  if (is_program(source)) {
    // A program that hangs before it describes itself is seen by the watchdog like any call.
    const TimedCall timed(clock);
    const ab_planner& table = *program_table(source);
    require_sound_table(file, table);
    PlannerLibrary library = with_table(source, table, new_thread_owner());
    library.description_.is_program = true;
    return library;
  }
  // An absolute path: dlopen would look a bare name up in the system's folders.
  const std::string path = std::filesystem::absolute(file).string();
  // Constructors run in dlopen(), too, and may change rounding and locale.
  const FloatGuard float_guard;
  const LocaleGuard locale_guard;
  const TimedCall timed(clock);
  // Before dlopen(): constructors run in it.
  any_loaded = true;
  const ThreadOwner owner = new_thread_owner();
  const LoadingThreads threads(owner);
  // NOW: a missing symbol shows here, not in the middle of a flight. LOCAL: two planners' symbols
  // never meet. It is never closed: what a library registered would point into nothing.
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* reason = dlerror();
    refuse_file(file,
                "can't be loaded: " + std::string(reason != nullptr ? reason : "unknown reason"));
  }
  const auto function = reinterpret_cast<TableFunction>(dlsym(handle, wanted_symbol().c_str()));
  if (function == nullptr) refuse_file(file, "does not export " + wanted_symbol());

  const ab_planner* table = table_from(file, function);
  require_sound_table(file, *table);
  return with_table(source, *table, owner);
}

}  // namespace avoidbench
