#pragma once

#include "avoidbench/planner.h"
#include "program_planner/planner_source.hpp"

/// Planners that are programs, behind the table by which libraries are called. One started program
/// serves one instance at a time and the next one after it; a second instance beside it gets a
/// program of its own. docs/process_planners.md has the protocol.
namespace avoidbench {

/// The planner of this program, which is started and asked for it. The table, never null, stays
/// until the process ends; it is not checked. Throws InputError where the program can't be started,
/// ends, or answers wrongly.
const ab_planner* program_table(PlannerSource source);

/// Whether the table is one of these.
bool is_program_table(const ab_planner& table);

/// Of an instance of such a table: CPU time that its program has used since the instance was made.
double program_cpu_time_s(const void* instance);

/// Of such an instance: whether its last call failed since its program had ended. The next reset()
/// starts another one.
bool program_has_ended(const void* instance);

/// Whether it ended by SIGKILL or the like: nobody knows by whom, so the trial is worth a retry.
bool program_was_killed(const void* instance);

}  // namespace avoidbench
