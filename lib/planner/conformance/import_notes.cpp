#include <algorithm>
#include <string_view>

#include "conformance/conformance.hpp"
#include "plugin/elf_symbols.hpp"

namespace avoidbench {
namespace {

struct Import {
  std::string_view symbol;  ///< the whole name, or where it is one of C++ its beginning
  std::string_view name;    ///< for people
};

constexpr Import kClocks[] = {{"clock_gettime", "clock_gettime"},
                              {"gettimeofday", "gettimeofday"},
                              {"time", "time"},
                              {"clock", "clock"},
                              {"timespec_get", "timespec_get"},
                              {"_ZNSt6chrono3_V212steady_clock3nowEv", "steady_clock::now"},
                              {"_ZNSt6chrono3_V212system_clock3nowEv", "system_clock::now"}};
constexpr Import kChance[] = {{"_ZNSt13random_device9_M_getval", "std::random_device"},
                              {"getrandom", "getrandom"},
                              {"getentropy", "getentropy"},
                              {"arc4random", "arc4random"},
                              {"rand", "rand"},
                              {"srand", "srand"},
                              {"random", "random"},
                              {"srandom", "srandom"},
                              {"drand48", "drand48"},
                              {"lrand48", "lrand48"}};
constexpr Import kThreads[] = {{"pthread_create", "pthread_create"},
                               {"_ZNSt6thread15_M_start_thread", "std::thread"},
                               {"GOMP_parallel", "GOMP_parallel (OpenMP)"},
                               {"__kmpc_fork_call", "__kmpc_fork_call (OpenMP)"},
                               {"_ZN3tbb", "oneTBB"}};

bool is_of(std::string_view symbol, const Import& import) {
  return import.symbol.starts_with("_Z") ? symbol.starts_with(import.symbol)
                                         : symbol == import.symbol;
}

/// Which of these there are, each once: "clock_gettime, time".
template <std::size_t count>
std::string found_of(const std::vector<std::string>& symbols, const Import (&imports)[count]) {
  std::string found;
  for (const Import& import : imports) {
    const bool is_there = std::any_of(symbols.begin(), symbols.end(),
                                      [&](const auto& symbol) { return is_of(symbol, import); });
    if (is_there) found += (found.empty() ? "" : ", ") + std::string(import.name);
  }
  return found;
}

void note(const std::filesystem::path& file, std::vector<std::string>& notes) {
  const std::vector<std::string> symbols = imported_symbols(file);
  const auto add = [&](const std::string& found, const char* why) {
    if (!found.empty()) notes.push_back(file.filename().string() + " imports " + found + why);
  };
  add(found_of(symbols, kClocks), ": what depends on time differs from run to run");
  add(found_of(symbols, kChance), ": chance that the mission's seed does not decide");
  add(found_of(symbols, kThreads), ": which thread is faster must not decide an answer");
}

}  // namespace

std::vector<std::string> import_notes(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files{file};
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < files.size(); ++i) {
    note(files[i], notes);
    for (const std::string& name : needed_libraries(files[i])) {
      const std::filesystem::path beside = file.parent_path() / name;
      std::error_code error;
      const bool is_new = std::find(files.begin(), files.end(), beside) == files.end();
      if (is_new && std::filesystem::is_regular_file(beside, error)) files.push_back(beside);
    }
  }
  return notes;
}

}  // namespace avoidbench
