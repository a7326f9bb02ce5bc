#include "sweep/run_in_workers.hpp"

#include <chrono>
#include <utility>

#include "fleet/fleet.hpp"

namespace avoidbench {
namespace {

FleetJob fleet_job(Run& run, const Assignment& assignment) {
  FleetJob next{
      .index = assignment.trial.value_or(0), .job = job_of(run, assignment), .map = assignment.map};
  if (assignment.trial) next.planner_label = next.job.spec.planner.label;
  // A map job runs no planner's code: its process gets the rules of the planner that will fly there
  // first, and stays for it with the map.
  const std::string& label =
      assignment.trial ? next.planner_label : first_planner(run.schedule, assignment.map);
  const auto known = run.sandbox_rules.find(label);
  if (known != run.sandbox_rules.end()) next.rules = known->second;
  next.needs_new_process = run.planners_with_globals.contains(next.planner_label);
  return next;
}

/// Its workers were killed by somebody else, each time: that is no result of the planner's.
void leave_unflown(Run& run, const Assignment& assignment, const std::string& reason) {
  const auto leave = [&](std::size_t trial, const std::string& why) {
    run.unflown.push_back({.key = run.schedule.keys[trial],
                           .planner_label = run.schedule.trials[trial].planner_label(),
                           .reason = why});
  };
  if (assignment.trial) return leave(*assignment.trial, reason);
  for (TrialGroup& group : run.schedule.maps[assignment.map].groups) {
    for (const std::size_t trial : std::exchange(group.waiting, {})) {
      leave(trial, reason + ", while it measured the map");
    }
  }
}

}  // namespace

void run_in_workers(Run& run) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point saved = Clock::now();
  const auto save_and_report = [&] {
    constexpr auto kSaving = std::chrono::seconds(5);  // a copy of the file alone has nearly all
    if (Clock::now() - saved > kSaving) {
      run.database.checkpoint();
      saved = Clock::now();
    }
    report_progress(run);
  };
  const auto next = [&](const Memory& memory) -> std::optional<FleetJob> {
    const auto assignment = next_assignment(run.schedule, memory);
    if (!assignment) return std::nullopt;
    return fleet_job(run, *assignment);
  };
  const auto ended = [&](const FleetJob& job, JobEnd end) {
    const bool is_trial = job.job.mission.has_value();
    const Assignment assignment{job.map, is_trial ? std::optional(job.index) : std::nullopt};
    if (end.answer) return take_result(run, assignment, std::move(*end.answer));
    if (end.death) return take_death(run, assignment, job.job, *end.death);
    leave_unflown(run, assignment, end.killed_by);
  };
  FleetOptions options = run.options;
  options.on_turn = save_and_report;
  for (const auto& [label, count] : fly(next, ended, options)) run.left_behind[label] += count;
}

}  // namespace avoidbench
