#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What a dying worker still says: where it was when a signal ended it.
namespace avoidbench {

/// From now on, signals that would end this process (segmentation fault, abort, …) write the stack
/// to `fd` before they do, or a mark where something else than this process and what it has started
/// sent them, or it is the signal of a CPU time limit. The calling thread may have overflowed its
/// stack; other threads may not.
void report_crashes(int fd);

/// Whether this process ends once it has used so much CPU time (`ulimit -t`).
bool has_cpu_limit();

/// Ends this process as by a signal that somebody else sent. Call it after report_crashes().
[[noreturn]] void end_from_outside(int number);

/// Whether such a mark of this signal is in what report_crashes() wrote.
bool is_marked_from_outside(std::string_view report, int number);

/// Ends this process with `exit_code`, where the main thread hangs, after that thread's stack was
/// written as for a crash. Call it in another thread, after report_crashes(). Returns never.
[[noreturn]] void end_hanging(int exit_code);

/// One place of a stack.
struct StackPlace {
  std::string text;           ///< "mine.so  plan(void*)+0x1b"
  std::uint64_t address = 0;  ///< in the planner's library, of the instruction; 0: elsewhere
};

/// Where a crash was, innermost first.
struct CrashStack {
  std::string library_file;  ///< the planner's
  std::vector<StackPlace> places;
};

/// The stack that a report has, without the frames of the handler and of this program. At most so
/// many.
CrashStack crash_stack(std::string_view report, const std::string& library_file, std::size_t most);

/// Where a crash was, for its reason: the library's name and the places in it, as crash_places(),
/// or, if none is in it, the innermost other library that is not the system's, with the function's
/// name: "mine.so: plan(void*)+0x1b", "libgrid.so.2: Grid::at(int)".
std::string crash_site(std::string_view report, std::string_view library_file);

/// The places in `libraries_of`'s file, innermost first, of a stack that report_crashes() wrote:
/// "plan(void*)+0x1b < run+0x20"; "" where there is none. Paths and addresses are left out, so that
/// the text is the same on every run.
std::string crash_places(std::string_view report, std::string_view library_file);

}  // namespace avoidbench
