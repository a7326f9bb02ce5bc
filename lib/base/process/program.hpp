#pragma once

#include <string>
#include <vector>

/// Programs of others that this one starts for its user, and waits for.
namespace avoidbench {

/// What becomes of what a program prints on standard output.
enum class Standard { shown, kept, dropped };

struct ProgramEnd {
  int code = -1;       ///< its exit code; -1 where it can't be started or was killed
  std::string output;  ///< what it printed, with Standard::kept
};

/// Runs the program (looked for on the PATH) to its end. What it says on standard error is shown,
/// except with Standard::dropped.
ProgramEnd run_program(const std::vector<std::string>& command, Standard output);

/// A Python that has these modules: AVOIDBENCH_PYTHON, else python3. Throws InputError, which says
/// what to install for `purpose`, if none has.
std::string python_with(const std::vector<std::string>& modules, const std::string& purpose);

}  // namespace avoidbench
