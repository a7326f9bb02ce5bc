#pragma once

namespace avoidbench {

/// CPUs that this process may use: its affinity, cut to the cgroup's quota; at least 1. Not what
/// the machine has.
int allowed_cpus();

/// Memory that this process may use: the machine's, or the cgroup's limit where that is less.
double allowed_memory_mib();

}  // namespace avoidbench
