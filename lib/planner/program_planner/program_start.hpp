#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace avoidbench {

/// All that a new process needs. Descriptors are this process's; -1 for a socket or segment that it
/// does not get.
struct ProgramStart {
  std::vector<std::string> words, variables;
  std::string folder;  ///< in which it works
  int prints_fd = -1, socket_fd = -1, segment_fd = -1;
};

/// The numbers that the new process has for them.
inline constexpr int kProgramSocketFd = 3, kProgramSegmentFd = 4;

/// Starts the program in a process group of its own, to be killed when this process ends. What goes
/// wrong in the new process, it prints. Returns its number; throws InputError where there can't be
/// a process.
pid_t start_program(const ProgramStart& start);

}  // namespace avoidbench
