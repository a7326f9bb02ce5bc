#include "process/sandbox.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

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
constexpr std::uint64_t kWriteFile = 1U << 1U;
constexpr std::uint64_t kRemoveDirToMakeSym = 0x1FF0;  // bits 4 to 12: remove and make anything
constexpr std::uint64_t kRemoveFile = 1U << 5U, kMakeRegular = 1U << 8U;
constexpr std::uint64_t kRefer = 1U << 13U;                  // from version 2
constexpr std::uint64_t kTruncate = 1U << 14U;               // from version 3
constexpr std::uint64_t kControlDevice = 1U << 15U;          // from version 5
constexpr std::uint64_t kBindAndConnect = 3;                 // TCP, from version 4
constexpr std::uint64_t kAbstractSockets = 1, kSignals = 2;  // from version 6

long landlock_version() { return ::syscall(kCreateRuleset, nullptr, std::size_t{0}, kAskVersion); }

void allow(int ruleset, const char* path, std::uint64_t access) {
  const int folder = ::open(path, O_PATH | O_CLOEXEC);
  // A container may lack /dev/shm; what is not there needs no permission.
  if (folder < 0) return;
  const PathBeneath rule{.allowed_access = access, .parent_fd = folder};
  ::syscall(kAddRule, ruleset, kRulePathBeneath, &rule, 0U);
  ::close(folder);
}

/// As much as the kernel's version of Landlock can do; false where it refuses.
bool enter_landlock(const SandboxRules& rules, int abi) {
  // What is handled and not allowed below is refused: reading is not handled.
  RulesetAttributes attributes{.handled_access_fs = kWriteFile | kRemoveDirToMakeSym};
  // Older kernels refuse a struct that is longer than the one they know.
  std::size_t size = sizeof attributes.handled_access_fs;
  if (abi >= 2) attributes.handled_access_fs |= kRefer;
  if (abi >= 3) attributes.handled_access_fs |= kTruncate;
  if (abi >= 4) {
    size = 2 * sizeof(std::uint64_t);
    if (!rules.network) attributes.handled_access_net = kBindAndConnect;
  }
  if (abi >= 5) attributes.handled_access_fs |= kControlDevice;
  if (abi >= 6) {
    size = sizeof attributes;
    attributes.scoped = kSignals | kAbstractSockets;
  }
  const auto ruleset =
      static_cast<int>(::syscall(kCreateRuleset, &attributes, size, std::uint32_t{0}));
  if (ruleset < 0) return false;
  const std::uint64_t of_files = kWriteFile | (attributes.handled_access_fs & kTruncate);
  const std::uint64_t of_devices = of_files | (attributes.handled_access_fs & kControlDevice);
  allow(ruleset, "/dev/null", of_files);
  if (rules.devices) allow(ruleset, "/dev", of_devices);
  // Shared memory of such planners: GPU libraries, thread libraries, Python's multiprocessing.
  if (rules.devices || rules.processes) {
    allow(ruleset, "/dev/shm", of_files | kRemoveFile | kMakeRegular);
  }
  const bool is_in = ::syscall(kRestrictSelf, ruleset, 0U) == 0;
  ::close(ruleset);
  return is_in;
}

/// Calls `visit(name, member)` for each rule.
template <class Visit>
void for_each_rule(Visit visit) {
  visit("processes", &SandboxRules::processes);
  visit("devices", &SandboxRules::devices);
  visit("network", &SandboxRules::network);
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
  // The kernel's condition for filters without root: no program that is started gains rights.
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return entered;
  if (support.landlock_abi > 0 && enter_landlock(rules, support.landlock_abi)) {
    entered.landlock_abi = support.landlock_abi;
  }
  if (support.has_seccomp) entered.has_seccomp = filter_calls(rules, entered.landlock_abi);
  return entered;
}

}  // namespace avoidbench
