#pragma once

#include <string>
#include <string_view>

/// What a dying worker still says: where it was when a signal ended it.
namespace avoidbench {

/// From now on, signals that mean a crash (segmentation fault, abort, …) write the stack to `fd`
/// before they end this process as they would have. The calling thread may have overflowed its
/// stack; other threads may not.
void report_crashes(int fd);

/// The places in `libraries_of`'s file, innermost first, of a stack that report_crashes() wrote:
/// "plan(void*)+0x1b < run+0x20"; "" where there is none. Paths and addresses are left out, so that
/// the text is the same on every run.
std::string crash_places(std::string_view report, std::string_view library_file);

}  // namespace avoidbench
