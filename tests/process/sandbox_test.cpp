#include "process/sandbox.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <linux/fs.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

namespace avoidbench {
namespace {

/// Whether `tried` is refused in a child that entered the sandbox: it returns whether it could.
bool is_refused(const SandboxSupport& support, const SandboxRules& rules,
                const std::function<bool()>& tried) {
  constexpr int kCould = 10, kRefused = 11, kNotIn = 12;
  const pid_t child = ::fork();
  if (child == 0) {
    const SandboxSupport entered = enter_sandbox(rules, support);
    if (text(entered) != text(support)) ::_exit(kNotIn);
    ::_exit(tried() ? kCould : kRefused);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_TRUE(WEXITSTATUS(status) == kCould || WEXITSTATUS(status) == kRefused)
      << "it could not enter: " << WEXITSTATUS(status);
  return WEXITSTATUS(status) == kRefused;
}

bool can_open(const std::string& file, int flags) {
  const int fd = ::open(file.c_str(), flags, 0600);
  if (fd >= 0) ::close(fd);
  return fd >= 0;
}

/// A terminal's two ends; closed with it.
struct Terminal {
  Terminal() : control(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    ::grantpt(control);
    ::unlockpt(control);
    name = ::ptsname(control);
    end = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  }
  ~Terminal() {
    ::close(end);
    ::close(control);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int control, end;
  std::string name;
};

/// With all that the kernel has, and with either part alone, as on a kernel that lacks the other.
class SandboxTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    support_ = sandbox_support();
    if (GetParam() == "seccomp") support_.landlock_abi = 0;
    if (GetParam() == "landlock") support_.has_seccomp = false;
    if (text(support_).empty()) GTEST_SKIP() << "this kernel has none";
    folder_ = std::filesystem::temp_directory_path() / ("sandbox_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "file";
    std::ofstream(file_) << "text";
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  bool is_refused(const std::function<bool()>& tried, const SandboxRules& rules = {}) const {
    return avoidbench::is_refused(support_, rules, tried);
  }

  SandboxSupport support_;
  std::filesystem::path folder_;
  std::string file_;
};

INSTANTIATE_TEST_SUITE_P(Kinds, SandboxTest, testing::Values("all", "seccomp", "landlock"),
                         [](const auto& kind) { return kind.param; });

TEST_P(SandboxTest, FilesCanBeReadAndNotChanged) {
  EXPECT_FALSE(is_refused([&] { return can_open(file_, O_RDONLY); }));
  for (const int flags : {O_WRONLY, O_RDWR, O_RDWR | O_CREAT}) {
    EXPECT_TRUE(is_refused([&] { return can_open(file_, flags); })) << flags;
  }
  EXPECT_TRUE(is_refused([&] { return can_open(folder_ / "new", O_WRONLY | O_CREAT); }));
  EXPECT_TRUE(is_refused([&] { return ::unlink(file_.c_str()) == 0; }));
  EXPECT_TRUE(is_refused([&] { return ::rename(file_.c_str(), (folder_ / "b").c_str()) == 0; }));
  EXPECT_TRUE(is_refused([&] { return ::mkdir((folder_ / "c").c_str(), 0700) == 0; }));
  EXPECT_TRUE(is_refused([&] { return ::symlink("/", (folder_ / "d").c_str()) == 0; }));
  if (support_.has_seccomp || support_.landlock_abi >= 3) {
    EXPECT_TRUE(is_refused([&] { return ::truncate(file_.c_str(), 0) == 0; }));
  }
  EXPECT_EQ(std::filesystem::file_size(file_), 4U);
}

TEST_P(SandboxTest, OpenDescriptorsGoOn) {
  const int fd = ::open(file_.c_str(), O_WRONLY);
  EXPECT_FALSE(is_refused([&] { return ::write(fd, "more", 4) == 4; }));
  ::close(fd);
}

TEST_P(SandboxTest, TheParentIsLeftAlone) {
  const pid_t parent = ::getpid();
  if (support_.has_seccomp || support_.landlock_abi >= 6) {
    EXPECT_TRUE(is_refused([&] { return ::kill(parent, SIGURG) == 0; }));
  }
  EXPECT_TRUE(is_refused([&] { return ::ptrace(PTRACE_SEIZE, parent, nullptr, nullptr) == 0; }));
  const std::string memory = "/proc/" + std::to_string(parent) + "/mem";
  EXPECT_TRUE(is_refused([&] { return can_open(memory, O_RDWR); }));
  if (!support_.has_seccomp) return;
  const rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  EXPECT_TRUE(is_refused([&] { return ::prlimit(parent, RLIMIT_CORE, &limit, nullptr) == 0; }));
  EXPECT_TRUE(is_refused([&] { return ::setpriority(PRIO_PROCESS, 0, 1) == 0; }));
}

/// What a program of others sees of the sandboxed process that has started it.
TEST_P(SandboxTest, AProgramCantLookIntoItsParent) {
  const auto looks = [] {
    const std::string memory = "/proc/" + std::to_string(::getpid()) + "/mem";
    const pid_t child = ::fork();
    if (child == 0) ::_exit(!enter_inner_sandbox() || can_open(memory, O_RDONLY) ? 1 : 0);
    int status = 0;
    ::waitpid(child, &status, 0);
    return status != 0;
  };
  const auto looks_as_nobody = [&] {
    if (::getuid() != 0) return true;
    const pid_t child = ::fork();
    if (child == 0) {
      // To become somebody else hides a process by itself; one that an ordinary user starts is
      // open.
      if (::setgid(65534) != 0 || ::setuid(65534) != 0) ::_exit(2);
      if (::prctl(PR_SET_DUMPABLE, 1) != 0) ::_exit(2);
      const SandboxSupport entered = enter_sandbox({.processes = true}, support_);
      ::_exit(text(entered) == text(support_) && looks() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status == 0;
  };
  EXPECT_TRUE(looks_as_nobody());
  // Without Landlock root's processes can look into each other.
  if (support_.landlock_abi > 0) {
    EXPECT_TRUE(is_refused(looks, {.processes = true}));
  }
}

TEST_P(SandboxTest, AProgramCantSignalItsParentButItsOwnChildren) {
  if (support_.landlock_abi < 6) return;
  EXPECT_TRUE(is_refused(
      [] {
        const pid_t parent = ::getpid(), child = ::fork();
        if (child == 0) {
          enter_inner_sandbox();
          const pid_t grandchild = ::fork();
          if (grandchild == 0) ::pause();
          const bool can_end = ::kill(grandchild, SIGKILL) == 0;
          ::_exit(!can_end || ::kill(parent, SIGURG) == 0 ? 1 : 0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return status != 0;
      },
      {.processes = true}));
}

/// Neither one that is still open nor one whose name is known: what is typed, what is shown, how it
/// is set.
TEST_P(SandboxTest, TerminalsAreLeftAlone) {
  const Terminal terminal;
  ASSERT_GE(terminal.end, 0);
  for (const SandboxRules& rules : {SandboxRules{}, SandboxRules{.devices = true}}) {
    const bool can_see_paths = support_.landlock_abi > 0;
    if (can_see_paths) {
      EXPECT_TRUE(is_refused([&] { return can_open(terminal.name, O_RDONLY | O_NOCTTY); }, rules));
    }
    if (can_see_paths || !rules.devices) {
      EXPECT_TRUE(is_refused([&] { return can_open(terminal.name, O_WRONLY | O_NOCTTY); }, rules));
    }
    if (!support_.has_seccomp) continue;
    EXPECT_FALSE(is_refused([&] { return ::isatty(terminal.end) == 1; }, rules));
    EXPECT_TRUE(is_refused(
        [&] {
          termios settings{};
          return ::tcgetattr(terminal.end, &settings) == 0 &&
                 ::tcsetattr(terminal.end, TCSANOW, &settings) == 0;
        },
        rules));
    EXPECT_TRUE(is_refused([&] { return ::tcflow(terminal.end, TCOOFF) == 0; }, rules));
    EXPECT_TRUE(is_refused([&] { return ::ioctl(terminal.end, TIOCSTI, "x") == 0; }, rules));
    constexpr unsigned long kSetTerminal2 = 0x402C542B;  // TCSETS2, which glibc's header lacks
    char other_settings[64] = {};
    EXPECT_TRUE(is_refused(
        [&] { return ::ioctl(terminal.end, kSetTerminal2, other_settings) == 0; }, rules));
  }
}

TEST_P(SandboxTest, DevicesNeedToBeAllowed) {
  if (support_.landlock_abi > 0) {
    EXPECT_FALSE(is_refused([] { return can_open("/dev/null", O_RDWR); }));
  }
  for (const char* file : {"/dev/zero", "/dev/urandom", "/proc/self/status", "/etc/passwd"}) {
    EXPECT_FALSE(is_refused([&] { return can_open(file, O_RDONLY); })) << file;
  }
  EXPECT_TRUE(is_refused([] { return can_open("/dev/zero", O_RDWR); }));
  const SandboxRules devices{.devices = true};
  EXPECT_FALSE(is_refused([] { return can_open("/dev/zero", O_RDWR); }, devices));
  const std::string shared = "/dev/shm/sandbox_test_" + std::to_string(::getpid());
  const auto makes_shared = [&] { return can_open(shared, O_RDWR | O_CREAT | O_EXCL); };
  if (support_.landlock_abi > 0) {
    EXPECT_TRUE(is_refused(makes_shared, {.processes = true}));
    EXPECT_TRUE(is_refused([] { return can_open("/dev/kmsg", O_RDONLY); }, devices));
  }
  EXPECT_TRUE(is_refused(makes_shared));
  EXPECT_FALSE(is_refused(makes_shared, devices));
  ::unlink(shared.c_str());
}

/// What kernels have added since this filter was written may do anything.
TEST_P(SandboxTest, CallsOfNewerKernelsAreNotThere) {
  if (!support_.has_seccomp) return;
  constexpr long kFirstUnknown = 467, kFileSetattr = 469;
  for (const long call : {kFirstUnknown, kFileSetattr, 600L, 0x40000000L}) {
    EXPECT_FALSE(is_refused([&] { return ::syscall(call, -1, 0, 0, 0, 0) < 0 && errno == ENOSYS; }))
        << call;
  }
}

TEST_P(SandboxTest, FilesKeepTheirModesTimesAndLocks) {
  if (!support_.has_seccomp) return;  // Landlock does not cover these
  EXPECT_TRUE(is_refused([&] { return ::chmod(file_.c_str(), 0) == 0; }));
  EXPECT_TRUE(is_refused([&] { return ::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0) == 0; }));
  const int fd = ::open(file_.c_str(), O_RDONLY);
  struct flock lock {};
  lock.l_type = F_RDLCK;
  EXPECT_TRUE(is_refused([&] { return ::fcntl(fd, F_SETLK, &lock) == 0; }));
  ::close(fd);
}

TEST_P(SandboxTest, ProcessesAndSocketsNeedToBeAllowed) {
  if (!support_.has_seccomp) return;  // Landlock does not cover these
  const auto forks = [] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    return child > 0;
  };
  EXPECT_TRUE(is_refused(forks));
  EXPECT_FALSE(is_refused(forks, {.processes = true}));
  EXPECT_TRUE(is_refused([] { return std::system("true") == 0; }));
  EXPECT_FALSE(is_refused([] { return std::system("true") == 0; }, {.processes = true}));
  const auto connects = [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; };
  EXPECT_TRUE(is_refused(connects));
  EXPECT_FALSE(is_refused(connects, {.network = true}));
  const auto makes_pair = [](int kind) {
    int ends[2];
    return ::socketpair(AF_UNIX, kind | SOCK_CLOEXEC, 0, ends) == 0;
  };
  for (const SandboxRules& rules : {SandboxRules{}, SandboxRules{.network = true}}) {
    EXPECT_FALSE(is_refused([&] { return makes_pair(SOCK_STREAM); }, rules));
    EXPECT_FALSE(is_refused([&] { return makes_pair(SOCK_SEQPACKET); }, rules));
    // Its sender may choose any service of this machine as the receiver.
    EXPECT_TRUE(is_refused([&] { return makes_pair(SOCK_DGRAM); }, rules));
    EXPECT_TRUE(is_refused([&] { return makes_pair(SOCK_RAW); }, rules));
  }
}

// Root's sockets could set up interfaces and routes.
TEST_P(SandboxTest, TheNetworkIsUsedAndNotSetUp) {
  const auto makes_packets = [] { return ::socket(AF_INET, SOCK_RAW, IPPROTO_ICMP) >= 0; };
  const auto may_set_up = [] {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3] = {};
    ::syscall(SYS_capget, &header, sets);
    return ((sets[0].effective | sets[0].permitted) & (1U << CAP_NET_ADMIN)) != 0;
  };
  EXPECT_TRUE(is_refused(makes_packets, {.network = true}));
  EXPECT_TRUE(is_refused(may_set_up, {.network = true}));
  EXPECT_TRUE(is_refused(may_set_up, {}));
}

TEST_P(SandboxTest, ChildrenThatAreAllowedCanBeEndedAndTheParentNot) {
  const pid_t parent = ::getpid();
  const auto ends_child = [] {
    const pid_t child = ::fork();
    if (child == 0) ::pause();
    return ::kill(child, SIGKILL) == 0;
  };
  EXPECT_FALSE(is_refused(ends_child, {.processes = true}));
  if (!support_.has_seccomp && support_.landlock_abi < 6) return;
  EXPECT_TRUE(is_refused([&] { return ::kill(parent, SIGURG) == 0; }, {.processes = true}));
}

TEST_P(SandboxTest, ThreadsAndSignalsToItselfGoOn) {
  EXPECT_FALSE(is_refused([] {
    bool has_run = false;
    std::thread([&] { has_run = true; }).join();
    return has_run;
  }));
  EXPECT_FALSE(is_refused([] { return ::raise(SIGURG) == 0; }));
  if (!support_.has_seccomp) return;
  EXPECT_TRUE(is_refused([] { return ::kill(::getpid(), SIGSTOP) == 0; }));
}

/// A planner that could end itself as others end it would take the trials that it fails out of the
/// count.
TEST_P(SandboxTest, NobodyEndsItselfAsOthersWould) {
  if (!support_.has_seccomp) return;
  for (const int number : {SIGKILL, SIGSTOP, SIGTERM, SIGHUP}) {
    ::signal(number, SIG_IGN);  // so that the child lives where it is not refused
    EXPECT_TRUE(is_refused([&] { return ::raise(number) == 0; })) << number;
    EXPECT_TRUE(is_refused([&] { return ::kill(::getpid(), number) == 0; })) << number;
    ::signal(number, SIG_DFL);
  }
  EXPECT_TRUE(is_refused([] {
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGKILL;
    timer_t timer{};
    return ::timer_create(CLOCK_MONOTONIC, &event, &timer) == 0;
  }));
  EXPECT_TRUE(is_refused([] {
    int ends[2];
    return ::pipe(ends) == 0 && ::fcntl(ends[0], F_SETSIG, SIGKILL) == 0;
  }));
  EXPECT_TRUE(is_refused([] {
    const rlimit none{0, 0};
    return ::setrlimit(RLIMIT_CPU, &none) == 0;
  }));
}

/// What opening for reading is enough for, and what outlives a process.
TEST_P(SandboxTest, AttributesAndSharedObjectsAreLeftAlone) {
  if (!support_.has_seccomp) return;
  EXPECT_TRUE(is_refused([&] {
    const int fd = ::open(file_.c_str(), O_RDONLY);
    int flags = 0;
    return ::ioctl(fd, FS_IOC_SETFLAGS, &flags) == 0 || errno != EPERM;
  }));
  const auto makes_memory = [] {
    const int memory = ::shmget(IPC_PRIVATE, 4096, IPC_CREAT | 0600);
    if (memory >= 0) ::shmctl(memory, IPC_RMID, nullptr);
    return memory >= 0;
  };
  EXPECT_TRUE(is_refused(makes_memory));
  EXPECT_FALSE(is_refused(makes_memory, {.processes = true}));
}

TEST(Sandbox, RulesAreReadAsTheyAreWritten) {
  EXPECT_EQ(text(SandboxRules{}), "");
  const SandboxRules both{.processes = true, .network = true};
  EXPECT_EQ(text(both), "processes,network");
  EXPECT_EQ(sandbox_rules_from(text(both)), both);
  EXPECT_EQ(sandbox_rules_from("process"), SandboxRules{});
  EXPECT_EQ(text(SandboxSupport{.landlock_abi = 7, .has_seccomp = true}), "landlock 7, seccomp");
}

}  // namespace
}  // namespace avoidbench
