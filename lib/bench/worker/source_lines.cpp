#include "worker/source_lines.hpp"

#include <cstdio>
#include <sstream>

#include "process/fed_program.hpp"
#include "process/isolated_run.hpp"
#include "process/program.hpp"
#include "process/sandbox.hpp"

namespace avoidbench {
namespace {

// Of a library with the debug information of many others a second; one made to take long ends here.
constexpr double kTimeLimit_s = 10.0;

std::string hexadecimal(std::uint64_t address) {
  char text[32];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(address));
  return text;
}

/// "/home/me/planner.cpp:42 (discriminator 3)": "planner.cpp:42"; "" for "??:?" and "…:?".
std::string short_line(const std::string& line) {
  const std::string place = line.substr(0, line.find(' '));
  const std::size_t colon = place.rfind(':');
  const bool is_known = colon != std::string::npos && colon + 1 < place.size() &&
                        place.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  return is_known ? std::filesystem::path(place).filename().string() : "";
}

bool is_of_others(const std::string& line) {
  return line.starts_with("/usr/") || line.find("/avoidbench/planner.hpp:") != std::string::npos;
}

}  // namespace

std::vector<std::string> source_lines_command(const std::filesystem::path& library,
                                              const std::vector<std::uint64_t>& addresses) {
  std::vector<std::string> command{"addr2line", "-aie", library.string()};
  for (const std::uint64_t address : addresses) command.push_back(hexadecimal(address));
  return command;
}

std::vector<std::string> source_lines(const std::filesystem::path& library,
                                      const std::vector<std::uint64_t>& addresses) {
  if (addresses.empty() || found_program("addr2line").empty()) return {};
  const std::vector<std::string> command =
      source_lines_command(std::filesystem::absolute(library), addresses);
  const IsolatedEnd run = run_isolated(
      [&](IsolatedOutput& output) {
        enter_sandbox({.processes = true}, sandbox_support());
        output.write(run_program(command, Standard::kept).output);
      },
      kTimeLimit_s);
  // For each address a line that repeats it, then one of each function that it is inlined into.
  std::vector<std::string> lines;
  bool is_chosen = false;
  std::istringstream printed(run.output);
  for (std::string line; std::getline(printed, line);) {
    if (line.starts_with("0x")) {
      lines.emplace_back();
      is_chosen = false;
    } else if (!lines.empty() && !is_chosen) {
      is_chosen = !is_of_others(line);
      if (is_chosen || lines.back().empty()) lines.back() = short_line(line);
    }
  }
  lines.resize(addresses.size());
  return lines;
}

}  // namespace avoidbench
