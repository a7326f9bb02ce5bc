#include "replay/provenance.hpp"

#include <sys/utsname.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <string>

#include "render/ray_tracing_isa.hpp"

namespace avoidbench {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    // ARM's /proc/cpuinfo has no such line.
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// The words this process was started with.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline");
  std::string line;
  for (std::string word; std::getline(file, word, '\0');) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

RunRow run_on_this_host() {
  utsname system{};
  ::uname(&system);
  // UTC, in ISO 8601.
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char time_text[32];
  std::strftime(time_text, sizeof time_text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  RunRow run;
  run.started_at = time_text;
  run.host = system.nodename;
  run.cpu = cpu_model();
  run.isa = ray_tracing_isa();
  run.command_line = command_line();
  return run;
}

}  // namespace avoidbench
