#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace avoidbench {

/// The line of source of each address in a library, "planner.cpp:42"; "" where its debug
/// information says nothing. Of functions inlined into each other it is the innermost that is
/// neither the system's nor the SDK's. By the program addr2line, in a sandbox, since the library
/// may be a stranger's; empty where this machine has none.
std::vector<std::string> source_lines(const std::filesystem::path& library,
                                      const std::vector<std::uint64_t>& addresses);

/// The command that prints them.
std::vector<std::string> source_lines_command(const std::filesystem::path& library,
                                              const std::vector<std::uint64_t>& addresses);

}  // namespace avoidbench
