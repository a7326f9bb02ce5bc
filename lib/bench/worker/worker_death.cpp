#include "worker/worker_death.hpp"

#include <csignal>

#include "base/option_error.hpp"
#include "process/print_capture.hpp"
#include "worker/crash_report.hpp"
#include "worker/worker.hpp"

namespace avoidbench {

bool is_from_outside(const ProcessEnd& end) {
  if (end.is_of_others) return true;
  // The last four are ignored by a worker, but not in its first moments.
  for (const int number : {SIGKILL, SIGHUP, SIGTERM, SIGINT, SIGUSR1}) {
    if (end.signal == number) return true;
  }
  return false;
}

Death broken_pipes() { return {.reason = "the worker's own pipes were closed or written to"}; }

Death too_much_memory() { return {.reason = "the worker used more memory than its limit allows"}; }

std::string crashed_file(const std::string& notes, const PlannerChoice& planner) {
  const bool is_filter = planner.filter && crash_places(notes, planner.file).empty() &&
                         !crash_places(notes, planner.filter->file).empty();
  return is_filter ? planner.filter->file : planner.file;
}

Death death_of(const ProcessEnd& end, const std::string& notes, const PlannerChoice& planner) {
  switch (end.exit_code) {
    // The worker ends itself with these codes, see worker.hpp; any other end is the planner's
    // doing.
    case kHungExitCode:
      return {Outcome::planner_hung, std::string(kCallTimeout)};
    case kMemoryExitCode:
      return too_much_memory();
    case kPipesExitCode:
      return broken_pipes();
    case kSandboxExitCode:
      throw OptionError(
          "a worker could not enter its sandbox, though the kernel offers it; planners "
          "can be flown without one",
          "", "no-sandbox");
    default:
      break;
  }
  // The place in the planner, if its stack could be written.
  const std::string site = crash_site(notes, crashed_file(notes, planner));
  return {.reason = "the worker ended by " + end.text + (site.empty() ? "" : " in " + site)};
}

void add_flight(Death& death, WorkerProcess& process) {
  process.kill();  // before its flight is looked at: it may still be noting it
  death.flown = process.flown();
  death.last_words = last_words(process);
}

std::string last_words(const WorkerProcess& process) {
  constexpr std::size_t kMost = 300;
  std::string words = last_line_of(process.printed());
  if (words.size() > kMost) words.resize(kMost);
  return words;
}

}  // namespace avoidbench
