#include "worker/crash_report.hpp"

#include <cxxabi.h>
#include <execinfo.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "plugin/elf_symbols.hpp"
#include "process/process_tree.hpp"

namespace avoidbench {
namespace {

/// What a process does to itself by a fault, and all else that ends one which does not catch it.
/// Left out is what a worker ignores, and what no planner can send to it (is_from_outside()).
constexpr std::array kEnding{SIGSEGV, SIGBUS,  SIGFPE,  SIGILL,    SIGABRT,  SIGTRAP,
                             SIGSYS,  SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF,  SIGUSR2,
                             SIGXCPU, SIGXFSZ, SIGIO,   SIGPWR,    SIGSTKFLT};
constexpr std::string_view kOutsideMark = "from outside: signal ";
// Deep recursion is cut off; the places that name the fault are the innermost.
constexpr int kMostFrames = 64;
// Enough to know the call path, short enough for a line in a table.
constexpr std::size_t kMostPlaces = 4;

/// Globals, since a signal handler takes no argument.
volatile int report_fd = -1;
volatile int hung_exit_code = 0;  ///< not 0: the signal asks a thread that hangs where it is

/// Whether neither this process nor what it has started is why the signal came.
bool is_of_others(int number, const siginfo_t& info) {
  switch (info.si_code) {
    case SI_USER:
    case SI_QUEUE:
    case SI_TKILL:
      // The sender is 0 where it is outside of the container.
      return info.si_pid != ::getpid() && !descends_from(info.si_pid, ::getpid());
    case SI_KERNEL:
      // A key of the terminal, or the limit of CPU time, which a planner can't set. The other
      // signals of the kernel's are those of the process's own timers.
      return number == SIGQUIT || number == SIGXCPU;
    default:  // a fault, or a timer of the process's own
      return false;
  }
}

void write_mark(int number) {
  std::array<char, 64> line{};
  char* end = std::copy(kOutsideMark.begin(), kOutsideMark.end(), line.data());
  end = std::to_chars(end, line.data() + line.size() - 1, number).ptr;
  *end++ = '\n';
  (void)!::write(report_fd, line.data(), static_cast<std::size_t>(end - line.data()));
}

/// Runs in a process that is broken: nothing here allocates.
void report_end(int number, siginfo_t* info, void*) {
  if (is_of_others(number, *info)) {
    write_mark(number);
  } else {
    std::array<void*, kMostFrames> frames{};
    ::backtrace_symbols_fd(frames.data(), ::backtrace(frames.data(), kMostFrames), report_fd);
    if (hung_exit_code != 0) ::_exit(hung_exit_code);
  }
  ::raise(number);  // SA_RESETHAND: as it would have ended
}

void take_signals() {
  struct sigaction action {};
  action.sa_sigaction = report_end;
  // SA_RESETHAND: a fault within the handler ends the process. SA_NODEFER: raise() works at once.
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int number : kEnding) ::sigaction(number, &action, nullptr);
  for (int number = SIGRTMIN; number <= SIGRTMAX; ++number) ::sigaction(number, &action, nullptr);
}

/// One line of backtrace_symbols_fd: "path/name.so(symbol+0x1b) [0x7f…]".
struct Frame {
  std::string library, symbol, offset;  ///< name.so, demangled or "", "+0x1b"
  std::string mangled;                  ///< symbol
  /// Where a signal came, which is the instruction itself; else a place to return to.
  bool is_interrupted = false;
};

/// The SDK's frames between host and planner by the planner's own function, which is inlined into
/// them: "mine::Planner::plan" for avoidbench::detail::plan<mine::Planner>(…)::{lambda()#1}.
std::string without_sdk(const std::string& symbol) {
  for (const std::string_view name : {"plan", "reset", "create", "destroy"}) {
    const std::string begin = "avoidbench::detail::" + std::string(name) + "<";
    const std::size_t at = symbol.find(begin);
    if (at == std::string::npos) continue;
    // The type is what stands between the brackets, which may be nested.
    std::size_t end = at + begin.size();
    for (int depth = 1; end < symbol.size(); ++end) {
      depth += symbol[end] == '<' ? 1 : symbol[end] == '>' ? -1 : 0;
      if (depth == 0) break;
    }
    const std::size_t type = at + begin.size();
    return symbol.substr(type, end - type) + "::" + std::string(name);
  }
  return symbol;
}

std::string demangled(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
  return without_sdk(status == 0 && text != nullptr ? text.get() : symbol);
}

/// Lines without a place in brackets are passed over.
std::vector<Frame> frames_of(std::string_view report) {
  std::vector<Frame> frames;
  while (!report.empty()) {
    const std::size_t end = report.find('\n');
    const std::string_view line = report.substr(0, end);
    report.remove_prefix(end == std::string_view::npos ? report.size() : end + 1);
    const std::size_t open = line.find('('), close = line.find(')', open);
    if (open == std::string_view::npos || close == std::string_view::npos) continue;
    const std::string_view place = line.substr(open + 1, close - open - 1);
    const std::size_t plus = std::min(place.rfind('+'), place.size());
    const std::string mangled(place.substr(0, plus));
    frames.push_back({.library = std::filesystem::path(line.substr(0, open)).filename().string(),
                      .symbol = demangled(mangled),
                      .offset = std::string(place.substr(plus)),
                      .mangled = mangled,
                      // Behind the handler and what the kernel put between them.
                      .is_interrupted = frames.size() == 2});
  }
  return frames;
}

/// Without those of this program: the handler's, which is the first, and the planner's caller's.
std::vector<Frame> planner_frames(std::string_view report) {
  std::vector<Frame> frames = frames_of(report);
  if (frames.empty()) return frames;
  // The innermost frame is the handler's own: it names the program, whatever it is called.
  const std::string program = frames.front().library;
  std::erase_if(frames, [&](const Frame& frame) { return frame.library == program; });
  return frames;
}

/// Of the frame's instruction in the library; 0 where the frame says nothing of it.
std::uint64_t instruction_of(const Frame& frame, const std::string& library_file) {
  if (!frame.offset.starts_with("+0x")) return 0;
  const std::uint64_t begin = frame.mangled.empty() ? 0 : address_of(library_file, frame.mangled);
  if (begin == 0 && !frame.mangled.empty()) return 0;
  const std::uint64_t at = begin + std::strtoull(frame.offset.c_str() + 1, nullptr, 16);
  // One back from where the call returns to, which may be another line.
  return frame.is_interrupted || at == 0 ? at : at - 1;
}

/// "plan(double)+0x1b": what the program's own linker did not know, such as functions that a
/// library does not export, is looked up in the library's file.
std::string place_of(const Frame& frame, std::string_view library_file) {
  if (!frame.symbol.empty() || !frame.offset.starts_with("+0x")) return frame.symbol + frame.offset;
  const std::uint64_t address = std::strtoull(frame.offset.c_str() + 1, nullptr, 16);
  if (address == 0) return frame.offset;
  // Most are places to return to, which may be one past the end of what called.
  const std::string found = function_at(std::filesystem::path(library_file), address - 1);
  const std::size_t plus = found.rfind('+');
  if (plus == std::string::npos) return frame.offset;
  char offset[32];
  std::snprintf(offset, sizeof offset, "+0x%llx",
                1 + std::strtoull(found.c_str() + plus + 1, nullptr, 16));
  return demangled(found.substr(0, plus)) + offset;
}

/// The system's libraries, in which a planner's fault may show.
bool is_of_system(const Frame& frame) {
  for (const std::string_view name : {"libc.so", "libc-", "libstdc++", "libpthread", "libm.so",
                                      "libgcc_s", "ld-linux", "linux-vdso"}) {
    if (frame.library.starts_with(name)) return true;
  }
  return false;
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
  take_signals();
}

bool has_cpu_limit() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_CPU, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

void end_from_outside(int number) {
  write_mark(number);
  ::signal(number, SIG_DFL);
  ::raise(number);
  ::_exit(1);
}

bool is_marked_from_outside(std::string_view report, int number) {
  return report.find(std::string(kOutsideMark) + std::to_string(number) + "\n") !=
         std::string_view::npos;
}

void end_hanging(int exit_code) {
  hung_exit_code = exit_code;
  take_signals();  // the planner may have taken them itself
  // To the first thread, in which planners are called: its number is the process's.
  ::syscall(SYS_tgkill, ::getpid(), ::getpid(), SIGABRT);
  // Enough for a stack. A thread that blocks signals, or is deep in the kernel, writes none.
  ::usleep(500'000);
  ::_exit(exit_code);
}

CrashStack crash_stack(std::string_view report, const std::string& library_file, std::size_t most) {
  const std::string name = std::filesystem::path(library_file).filename().string();
  CrashStack stack{.library_file = library_file, .places = {}};
  std::string last;
  for (const Frame& frame : planner_frames(report)) {
    if (stack.places.size() == most) break;
    // Of the signal's arrival and of the program's start.
    if (is_of_system(frame) && (frame.symbol.empty() || frame.symbol == "__libc_start_main")) {
      continue;
    }
    const bool is_planner = frame.library == name;
    const std::string place =
        is_planner ? place_of(frame, library_file) : frame.symbol + frame.offset;
    const std::string function = place.substr(0, place.rfind('+'));
    if (!function.empty() && function == last) continue;
    last = function;
    stack.places.push_back({.text = frame.library + "  " + place,
                            .address = is_planner ? instruction_of(frame, library_file) : 0});
  }
  return stack;
}

std::string crash_site(std::string_view report, std::string_view library_file) {
  const std::string places = crash_places(report, library_file);
  if (!places.empty()) {
    return std::filesystem::path(library_file).filename().string() + ": " + places;
  }
  // None of the planner's own: the innermost function of another library.
  for (const Frame& frame : planner_frames(report)) {
    // Offsets in libraries of others change with their versions.
    if (!is_of_system(frame) && !frame.symbol.empty()) return frame.library + ": " + frame.symbol;
  }
  return "";
}

std::string crash_places(std::string_view report, std::string_view library_file) {
  const std::string name = std::filesystem::path(library_file).filename().string();
  std::string places, last;
  std::size_t count = 0;
  for (const Frame& frame : frames_of(report)) {
    if (frame.library != name || count == kMostPlaces) continue;
    const std::string place = place_of(frame, library_file);
    // Recursion: the same function over and over; and frames of the SDK that stand for one
    // function.
    const std::string function = place.substr(0, place.rfind('+'));
    if (place.empty() || (!function.empty() && function == last)) continue;
    places += (places.empty() ? "" : " < ") + place;
    last = function;
    ++count;
  }
  return places;
}

}  // namespace avoidbench
