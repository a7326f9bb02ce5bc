#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/enum_text.hpp"
#include "page/page.hpp"
#include "process/fed_program.hpp"
#include "sweep/run_sweep.hpp"

namespace avoidbench {

enum class RunState { running, complete, interrupted };
template <>
struct EnumText<RunState> {
  static constexpr std::pair<RunState, std::string_view> entries[] = {
      {RunState::running, "running"},
      {RunState::complete, "complete"},
      {RunState::interrupted, "interrupted"}};
};

/// Throws InputError where no page can be written there again and again: a file is needed, not
/// standard output or a device.
void check_run_page(const std::string& file);

/// The page of a sweep while it is flown. Another process of a lower priority writes it, every five
/// seconds, or so that it takes at most a twentieth of one CPU. The wall clock decides only when.
class RunPage {
 public:
  /// Writes the page without a trial and starts that process. Before the fleet flies, which would
  /// take a new process for a planner's. Throws InputError where the page can't be written.
  RunPage(const std::string& file, const std::filesystem::path& database, std::string sweep);

  /// Of the sweep, where it has several.
  void set_revision(std::int64_t revision);
  /// Waits for nothing.
  void show(const Progress& progress);
  /// The last page. One that can't be written is a warning, and only if there was none before.
  void finish(RunState state);

 private:
  nlohmann::ordered_json run(RunState state) const;

  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  std::string database_, sweep_;
  std::int64_t revision_ = 0;  ///< 0: the only one
  Progress progress_;
  std::optional<FedProgram> writer_;
  Clock::time_point began_ = Clock::now(), offered_{};
};

/// Writes the page of what the database has of the sweep and returns its data; revision 0: its
/// only one. `run` is its progress and "state"; while nothing is "done" the page has only that.
/// Throws InputError.
nlohmann::ordered_json write_run_page(const std::filesystem::path& file,
                                      const std::string& database, const std::string& sweep,
                                      std::int64_t revision, const PageOrigin& origin,
                                      nlohmann::ordered_json run);

}  // namespace avoidbench
