#include "process/sandbox.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "process/seccomp_filter.hpp"

namespace avoidbench {
namespace {

// As in the kernel's linux/landlock.h, whose version on older systems lacks most of it.
constexpr long kCreateRuleset = 444, kAddRule = 445, kRestrictSelf = 446;
constexpr std::uint32_t kAskVersion = 1;
constexpr int kRulePathBeneath = 1;
struct RulesetAttributes {
  std::uint64_t handled_access_fs = 0;
  std::uint64_t handled_access_net = 0;  // from version 4
  std::uint64_t scoped = 0;              // from version 6
};
struct [[gnu::packed]] PathBeneath {
  std::uint64_t allowed_access = 0;
  std::int32_t parent_fd = -1;
};
constexpr std::uint64_t kWriteFile = 1U << 1U, kReadFile = 1U << 2U;
constexpr std::uint64_t kRemoveDirToMakeSym = 0x1FF0;  // bits 4 to 12: remove and make anything
constexpr std::uint64_t kRemoveFile = 1U << 5U, kMakeRegular = 1U << 8U, kMakeLink = 1U << 12U;
constexpr std::uint64_t kRefer = 1U << 13U;                  // from version 2
constexpr std::uint64_t kTruncate = 1U << 14U;               // from version 3
constexpr std::uint64_t kControlDevice = 1U << 15U;          // from version 5
constexpr std::uint64_t kBindAndConnect = 3;                 // TCP, from version 4
constexpr std::uint64_t kAbstractSockets = 1, kSignals = 2;  // from version 6

/// Of Landlock, in which this process is; 0: in none.
int entered_abi = 0;

long landlock_version() { return ::syscall(kCreateRuleset, nullptr, std::size_t{0}, kAskVersion); }

/// Its descriptor; -1 where the kernel refuses.
int made_ruleset(const RulesetAttributes& attributes, int abi) {
  // Older kernels refuse a struct that is longer than the one they know.
  const std::size_t words = abi >= 6 ? 3 : abi >= 4 ? 2 : 1;
  return static_cast<int>(
      ::syscall(kCreateRuleset, &attributes, words * sizeof(std::uint64_t), std::uint32_t{0}));
}

/// For good; closes the ruleset.
bool restrict_self(int ruleset) {
  const bool is_in = ::syscall(kRestrictSelf, ruleset, 0U) == 0;
  ::close(ruleset);
  return is_in;
}

void allow(int ruleset, const char* path, std::uint64_t access) {
  const int folder = ::open(path, O_PATH | O_CLOEXEC);
  // A container may lack /dev/shm; what is not there needs no permission.
  if (folder < 0) return;
  const PathBeneath rule{.allowed_access = access, .parent_fd = folder};
  ::syscall(kAddRule, ruleset, kRulePathBeneath, &rule, 0U);
  ::close(folder);
}

/// What is in a folder; empty where it can't be listed.
std::vector<std::filesystem::path> entries_of(const char* folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  return error ? std::vector<std::filesystem::path>() : entries;
}

/// Whether planners that declare devices get this one of /dev: no terminal or keyboard, where
/// people type and what is written is obeyed; no disk; not the machine's memory.
bool is_for_planners(const std::filesystem::path& device) {
  const std::string name = device.filename().string();
  for (const std::string_view kept : {"tty", "pts", "ptmx", "console", "vcs", "input", "hidraw",
                                      "uinput", "mapper", "mem", "kmem", "kmsg", "port"}) {
    if (name.starts_with(kept)) return false;
  }
  struct stat file {};
  // Links lead to devices that are listed themselves.
  return ::lstat(device.c_str(), &file) == 0 && !S_ISBLK(file.st_mode) && !S_ISLNK(file.st_mode);
}

/// Reading everything except devices, since a rule can't take away what one above it allows: else
/// who knows the number of a terminal (/dev/pts/3) would read what is typed there. Allows what
/// `rules` grants of devices and of shared memory.
void allow_devices_and_reading(int ruleset, const SandboxRules& rules,
                               const std::vector<std::filesystem::path>& roots,
                               std::uint64_t handled) {
  const std::uint64_t read = handled & kReadFile, write = kWriteFile | (handled & kTruncate);
  for (const std::filesystem::path& root : roots) {
    if (root != "/dev") allow(ruleset, root.c_str(), read);
  }
  allow(ruleset, "/dev/null", read | write);
  for (const char* device : {"/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/shm"}) {
    allow(ruleset, device, read);
  }
  if (!rules.devices) return;
  for (const std::filesystem::path& device : entries_of("/dev")) {
    if (!is_for_planners(device)) continue;
    allow(ruleset, device.c_str(), read | write | (handled & kControlDevice));
  }
  // GPU and thread libraries, Python's multiprocessing.
  allow(ruleset, "/dev/shm", read | write | kRemoveFile | kMakeRegular);
}

/// As much as the kernel's version of Landlock can do; false where it refuses.
bool enter_landlock(const SandboxRules& rules, int abi) {
  // What is handled and not allowed below is refused.
  RulesetAttributes attributes{.handled_access_fs = kWriteFile | kRemoveDirToMakeSym};
  const std::vector<std::filesystem::path> roots = entries_of("/");
  // Where / can't be listed, reading stays free.
  if (!roots.empty()) attributes.handled_access_fs |= kReadFile;
  if (abi >= 2) attributes.handled_access_fs |= kRefer;
  if (abi >= 3) attributes.handled_access_fs |= kTruncate;
  if (abi >= 4 && !rules.network) attributes.handled_access_net = kBindAndConnect;
  if (abi >= 5) attributes.handled_access_fs |= kControlDevice;
  if (abi >= 6) attributes.scoped = kSignals | kAbstractSockets;
  const int ruleset = made_ruleset(attributes, abi);
  if (ruleset < 0) return false;
  allow_devices_and_reading(ruleset, rules, roots, attributes.handled_access_fs);
  return restrict_self(ruleset);
}

/// Calls `visit(name, member)` for each rule.
template <class Visit>
void for_each_rule(Visit visit) {
  visit("processes", &SandboxRules::processes);
  visit("devices", &SandboxRules::devices);
  visit("network", &SandboxRules::network);
}

/// Root's: to set up interfaces and routes, which sockets of AF_NETLINK would do, and raw packets.
void give_up_network_rights() {
  constexpr std::uint32_t kRights = (1U << CAP_NET_ADMIN) | (1U << CAP_NET_RAW);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3] = {};
  if (::syscall(SYS_capget, &header, sets) != 0) return;
  sets[0].effective &= ~kRights;
  sets[0].permitted &= ~kRights;
  sets[0].inheritable &= ~kRights;
  ::syscall(SYS_capset, &header, sets);
  // Else programs that root starts would have them again.
  for (const int right : {CAP_NET_ADMIN, CAP_NET_RAW}) ::prctl(PR_CAPBSET_DROP, right, 0, 0, 0);
}

}  // namespace

SandboxSupport sandbox_support() {
  const long abi = landlock_version();
  return {.landlock_abi = abi > 0 ? static_cast<int>(abi) : 0, .has_seccomp = can_filter_calls()};
}

std::string text(const SandboxSupport& support) {
  std::string words;
  if (support.landlock_abi > 0) words = "landlock " + std::to_string(support.landlock_abi);
  if (support.has_seccomp) words += words.empty() ? "seccomp" : ", seccomp";
  return words;
}

std::string text(const SandboxRules& rules) {
  std::string words;
  for_each_rule([&](const char* name, bool SandboxRules::*member) {
    if (rules.*member) words += (words.empty() ? "" : ",") + std::string(name);
  });
  return words;
}

SandboxRules sandbox_rules_from(const std::string& text) {
  SandboxRules rules;
  for_each_rule([&](const char* name, bool SandboxRules::*member) {
    // Between commas, so that no name is found within another.
    rules.*member = ("," + text + ",").find("," + std::string(name) + ",") != std::string::npos;
  });
  return rules;
}

SandboxSupport enter_sandbox(const SandboxRules& rules, const SandboxSupport& support) {
  SandboxSupport entered;
  give_up_network_rights();
  // The kernel's condition for filters without root: no program that is started gains rights.
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return entered;
  if (support.landlock_abi > 0 && enter_landlock(rules, support.landlock_abi)) {
    entered.landlock_abi = entered_abi = support.landlock_abi;
  } else {
    // No other process of an ordinary user may look into this one; with Landlock
    // enter_inner_sandbox() sees to that, of root's, too.
    ::prctl(PR_SET_DUMPABLE, 0);
  }
  if (support.has_seccomp) entered.has_seccomp = filter_calls(rules, entered.landlock_abi);
  return entered;
}

bool enter_inner_sandbox() {
  if (entered_abi == 0) return true;
  // Refuses nothing that is not refused already. What counts is that it lies within the other one.
  const RulesetAttributes attributes{.handled_access_fs = kMakeLink,
                                     .scoped = entered_abi >= 6 ? kSignals | kAbstractSockets : 0};
  const int ruleset = made_ruleset(attributes, entered_abi);
  return ruleset >= 0 && restrict_self(ruleset);
}

}  // namespace avoidbench
