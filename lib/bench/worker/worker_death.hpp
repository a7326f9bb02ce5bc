#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {

/// Why a job has no answer: what that makes of the trial.
struct Death {
  Outcome outcome = Outcome::planner_crashed;
  std::string reason;
  std::optional<TrialRecord> flown = {};  ///< up to the planner's last call, where there was one
  std::string last_words = {};            ///< the last line that the worker printed
};

/// The reason of a hang in one call, which is the same call whenever it is flown.
inline constexpr std::string_view kCallTimeout =
    "a planner call lasted longer than the plan timeout";

/// Whether somebody else ended the worker: a person, the kernel out of memory, a limit of CPU time,
/// a cluster.
bool is_from_outside(const ProcessEnd& end);

/// The planner's file, or its filter's where the stack in the worker's notes has a place of that
/// alone.
std::string crashed_file(const std::string& notes, const PlannerChoice& planner);

/// What the end of a worker makes of the trial that it flew. `notes` are the worker's.
Death death_of(const ProcessEnd& end, const std::string& notes, const PlannerChoice& planner);
Death broken_pipes();
Death too_much_memory();

/// Ends the worker and adds to its death how far the flight had come and what it printed last.
void add_flight(Death& death, WorkerProcess& process);

/// The last line that the worker printed; "" if none. Not longer than people read.
std::string last_words(const WorkerProcess& process);

}  // namespace avoidbench
