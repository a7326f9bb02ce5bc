#pragma once

#include "process/sandbox.hpp"

namespace avoidbench {

/// Whether the kernel filters system calls of processes that ask for it.
bool can_filter_calls();

/// From now on the kernel refuses this process what seccomp_filter.cpp lists: what Landlock of this
/// version (0: none) does not cover. False where it would not.
bool filter_calls(const SandboxRules& rules, int landlock_abi);

}  // namespace avoidbench
