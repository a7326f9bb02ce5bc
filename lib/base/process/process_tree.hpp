#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <set>

/// Processes that planners start, seen from the process that they descend from.
namespace avoidbench {

/// Descendants that lose their parent become children of this process, not of the system's first
/// one, so that they can be found.
void adopt_orphans();

/// Whether `pid` was started by `ancestor` or by what it started. May be called in a signal
/// handler.
bool descends_from(pid_t pid, pid_t ancestor);

/// Whether this process has a child, one that ended and was not waited for included. Cheap.
bool has_children();

/// The children of this process.
std::set<pid_t> own_children();

/// Ends all that descend from this process except `spared` and their descendants, and waits for
/// those that are its own children. How many processes there were that did not end already. Gives
/// up on what multiplies faster for longer than `time_limit_s`.
int end_orphans(const std::set<pid_t>& spared, double time_limit_s = 5.0);

/// Ends a child of this process, all that descends from it and all of the process group that has
/// its number, and waits for it. Its status, as waitpid gives it; 0 where it is no child.
int end_family(pid_t child, double time_limit_s = 5.0);

/// Whether a signal has stopped the process.
bool is_stopped_process(pid_t pid);

/// Memory in use by this process and by all that descend from it. What is more than `enough_mib` is
/// told exactly: what several processes share counts once, by shares.
double resident_mib_of_family(double enough_mib = 0.0);

/// How long each thread of this process and of all that descend from it could have run so far but
/// waited for a processor, by the thread's number. Empty where the kernel does not count it.
std::map<pid_t, std::uint64_t> processor_waits_ns();

}  // namespace avoidbench
