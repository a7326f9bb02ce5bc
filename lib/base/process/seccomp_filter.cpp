#include "process/seccomp_filter.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace avoidbench {
namespace {

// Numbers that the headers of older systems lack; the same on every machine.
constexpr std::uint32_t kPidfdSendSignal = 424, kIoUringSetup = 425, kClone3 = 435, kOpenat2 = 437;
constexpr std::uint32_t kPidfdGetfd = 438, kQuotactlFd = 443, kFchmodat2 = 452, kSetxattrat = 463,
                        kRemovexattrat = 466;
constexpr std::uint32_t kLastKnownCall = kRemovexattrat;         // of Linux 6.13
constexpr std::uint32_t kSetOwner = 0x8901, kSetGroup = 0x8902;  // FIOSETOWN, SIOCSPGRP
constexpr std::uint32_t kSetOwnEx = 15;                          // F_SETOWN_EX
constexpr std::uint32_t kSetFlags = 0x40086602, kSetAttributes = 0x401C5820;  // FS_IOC_SETFLAGS, …
constexpr std::uint32_t kFreeze = 0xC0045877;                                 // FIFREEZE
constexpr std::uint32_t kGetTerminal2 = 0x802C542A;                           // TCGETS2

/// A filter as it grows: each rule refuses one call and lets all others pass on to the next rule.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    // 32-bit calls have other numbers: refused as a whole, else each rule could be passed by.
    add(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 1, 0);
    refuse(EPERM);
    load(offsetof(seccomp_data, nr));
    // What newer kernels have added, nobody here has looked at: file_setattr (469) would do what
    // ioctl is refused. Above them are the same calls as here by the numbers of the x32 interface.
    add(BPF_JMP | BPF_JGT | BPF_K, kLastKnownCall, 0, 1);
    refuse(ENOSYS);
  }

  void never(std::initializer_list<std::uint32_t> calls, std::uint32_t error = EPERM) {
    for (const std::uint32_t call : calls) {
      add(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1);
      refuse(error);
    }
  }
  /// Not with one of these values of an argument (its lower 32 bits).
  void not_where(std::uint32_t call, int argument, std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values) {
      of_argument(call, argument, {{BPF_JMP | BPF_JEQ | BPF_K, 0, 1, value}});
    }
  }
  /// Only with one of these values of an argument.
  void only_where(std::uint32_t call, int argument, const std::vector<std::uint32_t>& values) {
    of_argument(call, argument, passing(values, 0));
  }
  /// Not where these bits of an argument are `kind`, unless it is one of these values.
  void not_of_kind(std::uint32_t call, int argument, std::uint32_t bits, std::uint32_t kind,
                   const std::vector<std::uint32_t>& values) {
    std::vector<sock_filter> tests = passing(values, 2);
    tests.push_back({BPF_ALU | BPF_AND | BPF_K, 0, 0, bits});
    tests.push_back({BPF_JMP | BPF_JEQ | BPF_K, 0, 1, kind});
    of_argument(call, argument, tests);
  }
  /// Not with any of these bits set in an argument; `error` as what it is refused.
  void not_with(std::uint32_t call, int argument, std::uint32_t bits, std::uint32_t error = EPERM) {
    of_argument(call, argument, {{BPF_JMP | BPF_JSET | BPF_K, 0, 1, bits}}, error);
  }
  /// Not these signals to this process.
  void not_to(std::uint32_t call, std::uint32_t pid, int signal_argument,
              std::initializer_list<std::uint32_t> signals) {
    constexpr int kPidArgument = 0;
    for (const std::uint32_t signal : signals) {
      const auto offset = offsetof(seccomp_data, args) +
                          sizeof(std::uint64_t) * static_cast<std::size_t>(signal_argument);
      of_argument(call, kPidArgument,
                  // Another process: over the three that are left. This one: load the signal and
                  // compare it.
                  {{BPF_JMP | BPF_JEQ | BPF_K, 0, 3, pid},
                   {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)},
                   {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, signal}});
    }
  }
  /// Only with these bits set.
  void only_with(std::uint32_t call, int argument, std::uint32_t bits) {
    of_argument(call, argument, {{BPF_JMP | BPF_JSET | BPF_K, 1, 0, bits}});
  }
  /// Not where an argument is negative as an int.
  void not_negative(std::uint32_t call, int argument) {
    constexpr std::uint32_t kSign = 0x80000000;
    not_with(call, argument, kSign);
  }

  bool install() {
    // What no rule has refused.
    add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW, 0, 0);
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  void add(int what, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    code_.push_back({static_cast<std::uint16_t>(what), if_true, if_false, value});
  }
  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset), 0, 0);
  }
  void refuse(std::uint32_t error) { add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error, 0, 0); }

  /// Tests by which these values jump over the tests that are left, `more` that follow and the
  /// refusal.
  static std::vector<sock_filter> passing(const std::vector<std::uint32_t>& values,
                                          std::uint8_t more) {
    std::vector<sock_filter> tests;
    auto left = static_cast<std::uint8_t>(values.size() + more);
    for (const std::uint32_t value : values) {
      tests.push_back({BPF_JMP | BPF_JEQ | BPF_K, left--, 0, value});
    }
    return tests;
  }

  /// The call, its argument, the tests, the refusal, and the number of the call again: where a test
  /// jumps over the refusal, the next rule finds what it expects.
  void of_argument(std::uint32_t call, int argument, const std::vector<sock_filter>& tests,
                   std::uint32_t error = EPERM) {
    const auto length = static_cast<std::uint8_t>(tests.size() + 3);
    add(BPF_JMP | BPF_JEQ | BPF_K, call, 0, length);
    load(offsetof(seccomp_data, args) + sizeof(std::uint64_t) * static_cast<std::size_t>(argument));
    code_.insert(code_.end(), tests.begin(), tests.end());
    refuse(error);
    load(offsetof(seccomp_data, nr));
  }

  std::vector<sock_filter> code_;
};

/// Other processes: no debugging, no limits, no priorities, no signals.
void leave_others_alone(Filter& filter, const SandboxRules& rules, int landlock_abi) {
  const auto self = static_cast<std::uint32_t>(::getpid());
  const auto parent = static_cast<std::uint32_t>(::getppid());
  filter.never({SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_kcmp, kPidfdGetfd});
  filter.only_where(SYS_prlimit64, 0, {0, self});
  filter.never({SYS_setpriority, SYS_ioprio_set, SYS_sched_setscheduler, SYS_sched_setattr,
                SYS_sched_setparam});
  filter.not_where(SYS_sched_setaffinity, 0, {parent});
  // Signals by way of a pipe or socket.
  filter.not_where(SYS_fcntl, 1, {F_SETOWN, kSetOwnEx, F_SETSIG});
  // Whoever ends itself by these looks like one that somebody else ended, whose trial is nobody's.
  filter.not_to(SYS_kill, self, 1, {SIGKILL, SIGSTOP, SIGTERM, SIGHUP});
  filter.not_to(SYS_tgkill, self, 2, {SIGKILL, SIGSTOP, SIGTERM, SIGHUP});
  if (!rules.processes) {
    filter.only_where(SYS_kill, 0, {self});
    filter.only_where(SYS_tgkill, 0, {self});
    filter.never({SYS_timer_create});  // whose signal is named in memory
    filter.not_where(SYS_setrlimit, 0, {RLIMIT_CPU});
    filter.not_where(SYS_prlimit64, 1, {RLIMIT_CPU});
    filter.never({SYS_shmget, SYS_semget, SYS_msgget, SYS_mq_open});  // they outlive the process
    filter.never({SYS_tkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, kPidfdSendSignal});
    filter.only_with(SYS_clone, 0, CLONE_THREAD);
    filter.never({kClone3},
                 ENOSYS);  // flags in memory can't be seen; the C library takes clone then
    filter.never({SYS_fork, SYS_vfork, SYS_execve, SYS_execveat});
  } else if (landlock_abi < 6) {  // from 6 on Landlock knows the process's own children
    filter.not_where(SYS_kill, 0, {0, parent});
    filter.not_negative(SYS_kill, 0);
    filter.not_where(SYS_tgkill, 0, {parent});
    filter.not_where(SYS_tkill, 0, {parent});
    filter.not_where(SYS_rt_sigqueueinfo, 0, {parent});
    filter.not_where(SYS_rt_tgsigqueueinfo, 0, {parent});
    filter.never({kPidfdSendSignal});
  }
}

/// Files: what Landlock does not cover, and all that writes where there is no Landlock.
void leave_files_alone(Filter& filter, const SandboxRules& rules, int landlock_abi) {
  filter.never({SYS_chmod,        SYS_fchmod,       SYS_fchmodat,  kFchmodat2,
                SYS_chown,        SYS_fchown,       SYS_lchown,    SYS_fchownat,
                SYS_utime,        SYS_utimes,       SYS_utimensat, SYS_futimesat,
                SYS_setxattr,     SYS_lsetxattr,    SYS_fsetxattr, SYS_removexattr,
                SYS_lremovexattr, SYS_fremovexattr, kSetxattrat,   kRemovexattrat});
  // A lock on the database would hold the run up. Libraries that lock what they read (HDF5) go on
  // where there are no such locks.
  filter.never({SYS_flock}, ENOSYS);
  filter.not_where(SYS_fcntl, 1, {F_SETLK, F_SETLKW, F_OFD_SETLK, F_OFD_SETLKW, F_SETLEASE});
  filter.never({SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_unshare, SYS_setns, 428,
                429, 430, 431, 432, 433, 442});  // the calls of the newer mount interface
  filter.never({SYS_open_by_handle_at});
  if (landlock_abi < 3) {  // which does not know of files that are cut off
    filter.never({SYS_truncate});
    filter.not_with(SYS_open, 1, O_TRUNC, EACCES);
    filter.not_with(SYS_openat, 2, O_TRUNC, EACCES);
    filter.never({kOpenat2}, ENOSYS);
  }
  // Paths can't be seen here: what needs devices, or programs that write to /dev/null, may write.
  if (landlock_abi > 0 || rules.devices || rules.processes) return;
  constexpr auto kWrites = static_cast<std::uint32_t>(O_WRONLY | O_RDWR | O_CREAT | O_TRUNC);
  filter.not_with(SYS_open, 1, kWrites, EACCES);
  filter.not_with(SYS_openat, 2, kWrites, EACCES);
  filter.never({SYS_creat, SYS_unlink, SYS_unlinkat, SYS_rename, SYS_renameat, SYS_renameat2,
                SYS_mkdir, SYS_mkdirat, SYS_rmdir, SYS_mknod, SYS_mknodat, SYS_link, SYS_linkat,
                SYS_symlink, SYS_symlinkat},
               EACCES);
}

/// Calls to what a descriptor leads to, of which there are thousands: those that libraries make to
/// find out what they have, how much there is to read and how large the window is. A planner that
/// declares devices may make all but those to terminals (their settings, who reads from them,
/// keystrokes put into them, to stop them), to files' attributes, and those that make signals.
void control_only(Filter& filter, const SandboxRules& rules) {
  std::vector<std::uint32_t> harmless{TCGETS,   kGetTerminal2, TIOCGWINSZ, FIONREAD,
                                      TIOCOUTQ, FIOCLEX,       FIONCLEX,   FIONBIO};
  if (rules.devices) {
    constexpr std::uint32_t kKindBits = 0xFF00, kOfTerminals = 0x5400;
    filter.not_of_kind(SYS_ioctl, 1, kKindBits, kOfTerminals, harmless);
    filter.not_where(SYS_ioctl, 1, {kSetOwner, kSetGroup, kSetFlags, kSetAttributes, kFreeze});
    return;
  }
  if (rules.network) {  // which addresses this machine has
    harmless.insert(harmless.end(),
                    {SIOCGIFNAME, SIOCGIFCONF, SIOCGIFFLAGS, SIOCGIFADDR, SIOCGIFBRDADDR,
                     SIOCGIFNETMASK, SIOCGIFMTU, SIOCGIFHWADDR, SIOCGIFINDEX});
  }
  filter.only_where(SYS_ioctl, 1, harmless);
}

/// Sockets: of the internet where they are declared, else none. Never AF_UNIX: services of the user
/// would start anything for it. Pairs are streams: a datagram's sender chooses its receiver.
void talk_only(Filter& filter, const SandboxRules& rules) {
  filter.not_with(SYS_socketpair, 1, SOCK_DGRAM, EACCES);
  if (rules.network) {
    filter.only_where(SYS_socket, 0, {AF_INET, AF_INET6, AF_NETLINK});
  } else {
    filter.never({SYS_socket, SYS_connect, SYS_bind}, EACCES);
  }
}

/// The machine: its clock and its kernel.
void leave_machine_alone(Filter& filter) {
  filter.never(
      {SYS_settimeofday,  SYS_clock_settime, SYS_adjtimex,     SYS_clock_adjtime,   SYS_sethostname,
       SYS_setdomainname, SYS_reboot,        SYS_swapon,       SYS_swapoff,         SYS_init_module,
       SYS_finit_module,  SYS_delete_module, SYS_kexec_load,   SYS_kexec_file_load, SYS_acct,
       SYS_quotactl,      kQuotactlFd,       SYS_bpf,          SYS_perf_event_open, SYS_add_key,
       SYS_request_key,   SYS_keyctl,        SYS_userfaultfd,  SYS_vhangup,         SYS_iopl,
       SYS_ioperm,        SYS_syslog,        SYS_fanotify_init});
  filter.never({kIoUringSetup}, ENOSYS);  // does calls that no filter sees
}

}  // namespace

bool can_filter_calls() {
  // Asked with nothing to install: EFAULT where it would look at it, EINVAL where it knows nothing.
  return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, nullptr) != 0 && errno == EFAULT;
}

bool filter_calls(const SandboxRules& rules, int landlock_abi) {
  Filter filter;
  leave_others_alone(filter, rules, landlock_abi);
  leave_files_alone(filter, rules, landlock_abi);
  leave_machine_alone(filter);
  control_only(filter, rules);
  talk_only(filter, rules);
  return filter.install();
}

}  // namespace avoidbench
