#include "sweep/allowance.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace avoidbench {
namespace {

/// CPUs of the cgroup's quota (version 2, as a container sees its own), or 0 where there is none.
double cgroup_quota() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  double quota = 0.0, period = 0.0;  // "max" is no number: no limit
  return file >> quota >> period && period > 0.0 ? quota / period : 0.0;
}

constexpr double kMib = 1024.0 * 1024.0;

/// The cgroup's limit (version 2 or 1), or `all` where there is none.
double cgroup_memory_mib(double all_mib) {
  for (const char* name :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(name);
    double bytes = 0.0;
    // "max" is no number; version 1 says "no limit" by a number beyond all memory.
    if (file >> bytes && bytes > 0.0) return std::min(all_mib, bytes / kMib);
  }
  return all_mib;
}

}  // namespace

int allowed_cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  // The CPUs that this process may run on, and no more than its container's quota.
  int count = ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  if (const double quota = cgroup_quota(); quota > 0.0) {
    count = std::min(count, static_cast<int>(std::ceil(quota)));
  }
  return std::max(1, count);
}

double allowed_memory_mib() {
  const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  return cgroup_memory_mib(pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMib);
}

}  // namespace avoidbench
