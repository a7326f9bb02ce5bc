#include "process/process_tree.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <thread>

namespace avoidbench {
namespace {

constexpr double kMib = 1024.0 * 1024.0;

/// What /proc/PID/stat says: "PID (NAME) STATE PARENT GROUP …". Nothing here allocates, for signal
/// handlers.
struct ProcessState {
  char state = 0;  ///< R, S, T, Z, …; 0: no such process
  pid_t parent = 0, group = 0;
  bool is_ending = false;  ///< it ends already, or SIGKILL is on its way
};

/// The number in field `index` of the text, which begins with field `first`; 0 where there is none.
std::uint64_t field_of(std::string_view text, int first, int index) {
  for (; first < index; ++first) {
    const std::size_t space = text.find(' ');
    if (space == std::string_view::npos) return 0;
    text.remove_prefix(space + 1);
  }
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

ProcessState state_of(pid_t pid) {
  std::array<char, 32> path{"/proc/"};
  const auto written = std::to_chars(path.data() + 6, path.data() + 20, pid);
  std::memcpy(written.ptr, "/stat", 6);
  const int file = ::open(path.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  std::array<char, 512> text{};
  const ssize_t length = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  if (length <= 0) return {};
  // A name may hold spaces and parentheses.
  const char* name_end = std::strrchr(text.data(), ')');
  if (name_end == nullptr || name_end + 4 >= text.data() + length) return {};
  // As proc(5) counts the fields, and as the kernel has its flag of a process that ends.
  constexpr int kParent = 4, kGroup = 5, kFlags = 9, kPendingSignals = 31;
  constexpr std::uint64_t kExiting = 0x4, kKill = std::uint64_t{1} << (SIGKILL - 1);
  const char* begin = name_end + 4;
  const std::string_view rest(begin, static_cast<std::size_t>(text.data() + length - begin));
  const auto field = [rest](int index) { return field_of(rest, kParent, index); };
  return {.state = name_end[2],
          .parent = static_cast<pid_t>(field(kParent)),
          .group = static_cast<pid_t>(field(kGroup)),
          .is_ending = name_end[2] == 'Z' || (field(kFlags) & kExiting) != 0 ||
                       (field(kPendingSignals) & kKill) != 0};
}

/// The entries of a folder of /proc that are numbers: processes, or a process's threads.
std::set<pid_t> numbers_in(const std::string& path) {
  std::set<pid_t> numbers;
  DIR* folder = ::opendir(path.c_str());
  if (folder == nullptr) return numbers;
  while (const dirent* entry = ::readdir(folder)) {
    pid_t number = 0;
    const char* name = entry->d_name;
    const char* end = name + std::strlen(name);
    if (std::from_chars(name, end, number).ptr == end && number > 0) numbers.insert(number);
  }
  ::closedir(folder);
  return numbers;
}

/// Every process that there is, by number.
std::map<pid_t, ProcessState> all_processes() {
  std::map<pid_t, ProcessState> processes;
  for (const pid_t pid : numbers_in("/proc")) processes[pid] = state_of(pid);
  return processes;
}

/// Whether a process of the list is `ancestor` or descends from it, but not from `spared` nor is
/// one of these.
bool is_below(const std::map<pid_t, ProcessState>& all, pid_t pid, pid_t ancestor,
              const std::set<pid_t>& spared) {
  // At most as many steps as processes: the list was not taken at one moment, and may hold a
  // circle.
  for (std::size_t i = 0; pid != ancestor && i < all.size() && !spared.contains(pid); ++i) {
    const auto found = all.find(pid);
    pid = found == all.end() ? 0 : found->second.parent;
  }
  return pid == ancestor;
}

/// Those that descend from this process, but not from `spared` nor one of these.
std::map<pid_t, ProcessState> descendants(const std::set<pid_t>& spared) {
  const std::map<pid_t, ProcessState> all = all_processes();
  const pid_t self = ::getpid();
  std::map<pid_t, ProcessState> ours;
  for (const auto& [pid, process] : all) {
    if (pid != self && is_below(all, pid, self, spared)) ours[pid] = process;
  }
  return ours;
}

/// The process, its descendants, and its group's.
std::map<pid_t, ProcessState> family_of(pid_t root) {
  const std::map<pid_t, ProcessState> all = all_processes();
  std::map<pid_t, ProcessState> family;
  for (const auto& [pid, process] : all) {
    if (process.group == root || is_below(all, pid, root, {})) family[pid] = process;
  }
  return family;
}

/// Stops these processes, or kills them where all stand still or `is_time`: what starts processes
/// without end would else go on between looks. Whether any was running.
bool stop_or_kill(const std::map<pid_t, ProcessState>& processes, bool is_time) {
  bool are_still = true, is_any = false;
  for (const auto& [pid, process] : processes) {
    // Dead already; somebody has yet to wait for it.
    if (process.state == 'Z') continue;
    is_any = true;
    if (process.state == 'T') continue;
    are_still = false;
    ::kill(pid, SIGSTOP);
  }
  if (!are_still && !is_time) return is_any;
  for (const auto& [pid, process] : processes) ::kill(pid, SIGKILL);
  return is_any;
}

/// Resident memory in which each page counts by the share of one of those that have it.
double proportional_mib(const std::string& process) {
  std::ifstream file("/proc/" + process + "/smaps_rollup");
  for (std::string word; file >> word;) {
    double kib = 0.0;
    if (word == "Pss:" && file >> kib) return kib / 1024.0;
  }
  return 0.0;
}

/// Adds how long each thread of the process has waited for a processor.
void add_waits_ns(pid_t process, std::map<pid_t, std::uint64_t>& waits_ns) {
  const std::string threads = "/proc/" + std::to_string(process) + "/task";
  for (const pid_t thread : numbers_in(threads)) {
    // "NANOSECONDS_RUN NANOSECONDS_WAITED TIMES_RUN"
    std::ifstream file(threads + "/" + std::to_string(thread) + "/schedstat");
    std::uint64_t run_ns = 0, waited_ns = 0;
    if (file >> run_ns >> waited_ns) waits_ns[thread] = waited_ns;
  }
}

double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMib;
}

}  // namespace

void adopt_orphans() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

bool descends_from(pid_t pid, pid_t ancestor) {
  // A parent's number may be used again while it is followed.
  constexpr int kMostGenerations = 10000;
  for (int i = 0; pid > 1 && i < kMostGenerations; ++i) {
    pid = state_of(pid).parent;
    if (pid == ancestor) return true;
  }
  return false;
}

bool has_children() {
  siginfo_t info{};
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

std::set<pid_t> own_children() {
  std::set<pid_t> children;
  if (!has_children()) return children;
  const pid_t self = ::getpid();
  for (const auto& [pid, process] : all_processes()) {
    if (process.parent == self) children.insert(pid);
  }
  return children;
}

int end_orphans(const std::set<pid_t>& spared, double time_limit_s) {
  const std::chrono::duration<double> time_limit(time_limit_s);
  // Of looks: after so many all are killed, although some have not stopped, as in a call that can't
  // be interrupted; and after so many empty ones nobody is left.
  constexpr int kMostLooks = 8, kEmptyLooks = 3;
  const auto began = std::chrono::steady_clock::now();
  std::set<pid_t> ended;
  int empty_looks = 0;
  for (int look = 1; std::chrono::steady_clock::now() - began < time_limit; ++look) {
    if (!has_children()) break;  // then there are no descendants: orphans come to this process
    const std::map<pid_t, ProcessState> orphans = descendants(spared);
    // What goes on in ever new processes may be missed by one look.
    empty_looks = orphans.empty() ? empty_looks + 1 : 0;
    if (empty_looks == kEmptyLooks) break;
    for (const auto& [pid, process] : orphans) {
      if (!process.is_ending) ended.insert(pid);
      ::waitpid(pid, nullptr, WNOHANG);  // of its own children only
    }
    stop_or_kill(orphans, look % kMostLooks == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return static_cast<int>(ended.size());
}

int end_family(pid_t child, double time_limit_s) {
  const std::chrono::duration<double> time_limit(time_limit_s);
  constexpr int kMostLooks = 8;
  const auto began = std::chrono::steady_clock::now();
  for (int look = 1; std::chrono::steady_clock::now() - began < time_limit; ++look) {
    const std::map<pid_t, ProcessState> family = family_of(child);
    for (const auto& [pid, process] : family) {
      // Of those that lost their parent and came to this process.
      if (pid != child && process.state == 'Z') ::waitpid(pid, nullptr, WNOHANG);
    }
    if (!stop_or_kill(family, look % kMostLooks == 0)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // Last: its number must not be another's while it is looked for.
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 0;
  }
  return status;
}

bool is_stopped_process(pid_t pid) { return state_of(pid).state == 'T'; }

double resident_mib_of_family(double enough_mib) {
  const bool is_alone = !has_children();
  if (is_alone) {
    const double own_mib = resident_mib();
    if (own_mib <= enough_mib) return own_mib;  // the exact answer takes a hundred times as long
  }
  // Pages that several share count once in all: each process has its part.
  double sum_mib = proportional_mib("self");
  if (is_alone) return sum_mib;
  for (const auto& [pid, process] : descendants({}))
    sum_mib += proportional_mib(std::to_string(pid));
  return sum_mib;
}

std::map<pid_t, std::uint64_t> processor_waits_ns() {
  std::map<pid_t, std::uint64_t> waits_ns;
  add_waits_ns(::getpid(), waits_ns);
  if (!has_children()) return waits_ns;
  for (const auto& [pid, process] : descendants({})) add_waits_ns(pid, waits_ns);
  return waits_ns;
}

}  // namespace avoidbench
