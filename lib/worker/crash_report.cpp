#include "worker/crash_report.hpp"

#include <cxxabi.h>
#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

namespace avoidbench {
namespace {

constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
// Deep recursion is cut off; the places that name the fault are the innermost.
constexpr int kMostFrames = 64;
// Enough to know the call path, short enough for a line in a table.
constexpr std::size_t kMostPlaces = 4;

volatile int report_fd = -1;

/// Runs in a process that is broken: nothing here allocates.
void write_stack(int number) {
  std::array<void*, kMostFrames> frames{};
  ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), kMostFrames), report_fd);
  ::raise(number);  // SA_RESETHAND: as it would have ended
}

std::string demangled(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
  return status == 0 && text != nullptr ? text.get() : symbol;
}

/// Of a line "path/name.so(symbol+0x1b) [0x7f…]": "symbol+0x1b", or "" where it is of another file.
std::string place_in(std::string_view line, std::string_view name) {
  const std::size_t open = line.find('('), close = line.find(')', open);
  if (open == std::string_view::npos || close == std::string_view::npos) return "";
  if (std::filesystem::path(line.substr(0, open)).filename() != name) return "";
  const std::string_view place = line.substr(open + 1, close - open - 1);
  const std::size_t plus = place.rfind('+');
  if (plus == std::string_view::npos) return std::string(place);
  return demangled(std::string(place.substr(0, plus))) + std::string(place.substr(plus));
}

}  // namespace

void report_crashes(int fd) {
  report_fd = fd;
  std::array<void*, 1> first{};
  ::backtrace(first.data(), 1);  // loads what it needs while that can still be loaded
  // A stack of its own: an overflown one is among the crashes to be reported.
  static std::vector<std::byte> stack(std::size_t{1} << 16U);
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = write_stack;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int number : kCrashes) ::sigaction(number, &action, nullptr);
}

std::string crash_places(std::string_view report, std::string_view library_file) {
  const std::string name = std::filesystem::path(library_file).filename().string();
  std::string places, last;
  std::size_t count = 0;
  while (!report.empty() && count < kMostPlaces) {
    const std::size_t end = report.find('\n');
    const std::string place = place_in(report.substr(0, end), name);
    report.remove_prefix(end == std::string_view::npos ? report.size() : end + 1);
    if (place.empty() || place == last) continue;  // recursion: the same place over and over
    places += (places.empty() ? "" : " < ") + place;
    last = place;
    ++count;
  }
  return places;
}

}  // namespace avoidbench
