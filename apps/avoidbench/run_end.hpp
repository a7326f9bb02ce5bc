#pragma once

#include <string>

#include "store/database.hpp"
#include "sweep/run_sweep.hpp"

/// What a run says of its sweep as a whole, on stderr.
namespace avoidbench {

/// That the sweep's name stands for several contents: what differs, and which one reports show.
void print_revision(const Database& database, const std::string& sweep,
                    const SweepRevision& revision);

/// What was there, was not flown or was left behind.
void print_summary(const RunSummary& summary, int ignored_signals);

/// Why trials of this revision did not reach the goal: a line for each kind of end,
/// with the most frequent reason and the command that shows such a trial.
void print_failures(const Database& database, const std::string& sweep, const RunSummary& summary);

/// Warns of planners that never flew in a trial of this revision, and of those that computed for
/// longer than its flights let them.
void warn_of_planners(const Database& database, const std::string& sweep, std::int64_t revision);

/// The command that shows this revision of a sweep, which need not be the latest one.
std::string command_that_reports(const Database& database, const std::string& sweep,
                                 std::int64_t revision);

}  // namespace avoidbench
