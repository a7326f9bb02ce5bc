#pragma once

#include <filesystem>
#include <string>

namespace avoidbench {

/// From now on the library at `file`, which this process has loaded, and what it depends on except
/// the runtimes of C and C++ find one second gone by at each look at a clock: their entries for
/// clock_gettime, std::chrono::steady_clock::now and so on lead to functions of ours. For a process
/// that ends after the flight: nothing is put back. False where no such library is loaded.
bool shift_clocks(const std::filesystem::path& file);

/// Which clocks were looked at since and by which files: "steady_clock::now (my_planner.so)"; ""
/// where none was.
std::string clocks_looked_at();

}  // namespace avoidbench
