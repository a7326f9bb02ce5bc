#pragma once

namespace avoidbench {

/// CPUs that this process may use: its affinity, cut to the cgroup's quota; at least 1. Not what
/// the machine has.
int allowed_cpus();

}  // namespace avoidbench
