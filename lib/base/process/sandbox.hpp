#pragma once

#include <string>

/// What shuts a process in that runs code of others: Landlock for files, signals and debugging,
/// seccomp for the rest. Needs no privileges; threads and children inherit it; it can't be left.
namespace avoidbench {

/// What the kernel offers for it.
struct SandboxSupport {
  int landlock_abi = 0;  ///< 0: none
  bool has_seccomp = false;
};

/// What a sandboxed process may do beside computing, starting threads, reading files that are no
/// devices and using the descriptors it has.
struct SandboxRules {
  bool processes = false;  ///< start programs and signal them
  bool devices = false;    ///< use files in /dev, as GPU drivers do; none are terminals or disks
  bool network = false;    ///< open sockets
  bool operator==(const SandboxRules&) const = default;
};

SandboxSupport sandbox_support();

/// "landlock 7, seccomp"; "seccomp"; "" for none.
std::string text(const SandboxSupport& support);

/// "processes,devices"; "" for none. The way back ignores words it does not know.
std::string text(const SandboxRules& rules);
SandboxRules sandbox_rules_from(const std::string& text);

/// Shuts this process in for good; call it while it has one thread. Returns what took effect,
/// which is less than `support` where the kernel refused.
SandboxSupport enter_sandbox(const SandboxRules& rules, const SandboxSupport& support);

/// For a child that is about to become a program of others: a sandbox within that of its parent, so
/// that it can't look into the parent's memory nor, from version 6 of Landlock on, signal it. Does
/// nothing without Landlock or where the parent is in no sandbox. False where the kernel refuses.
/// Allocates nothing.
bool enter_inner_sandbox();

}  // namespace avoidbench
