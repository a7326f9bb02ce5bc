#include "sweep/run_sweep.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "sweep/crash_report.hpp"
#include "sweep/job.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/schedule.hpp"
#include "sweep/sweep_rows.hpp"
#include "sweep/worker.hpp"
#include "sweep/worker_process.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

/// The run as the parent sees it.
struct Run {
  const SweepSpec& sweep;
  const RunOptions& options;
  const RunRow& provenance;
  Database& database;
  Schedule schedule;
  Progress progress;
  RecordedLatencies recorded;
  /// Jobs whose worker was killed from outside.
  std::set<std::pair<std::size_t, std::optional<std::size_t>>> killed_once;
  std::map<std::string, std::filesystem::file_time_type> planner_written;  ///< by file
  bool has_begun = false;  ///< the database knows of this run

  bool is_stopped() const { return options.stop != nullptr && options.stop->load(); }
};

/// A worker process, what it is doing and what it has in memory.
struct Seat {
  WorkerProcess process;
  std::optional<Assignment> assignment;
  Memory memory;
  double silent_s = 0.0;  ///< since it last said that it lives
};

void report_progress(const Run& run) {
  if (run.options.on_progress) run.options.on_progress(run.progress);
}

/// What a worker has in memory once it did this.
Memory memory_after(const Run& run, const Assignment& assignment) {
  if (!assignment.trial) return {.map = assignment.map, .planner_label = {}};
  return {.map = assignment.map,
          .planner_label = run.schedule.trials[*assignment.trial].planner_label()};
}

/// The map is known: missions that can't be flown leave the schedule.
void settle_map(Run& run, MapPlan& map, MapRecord record) {
  record.key = map.key;
  map.record = std::move(record);
  const std::size_t before = waiting_count(map);
  for (TrialGroup& group : map.groups) {
    std::erase_if(group.waiting, [&](std::size_t trial) {
      const auto index = static_cast<std::size_t>(run.schedule.trials[trial].mission_index);
      return !map.record->missions[index].is_valid;
    });
  }
  run.progress.invalid_missions += static_cast<std::int64_t>(before - waiting_count(map));
  report_progress(run);
}

/// Takes from the database the maps that an earlier run measured with at least as many missions,
/// where trials are left to be flown on them.
void recall_maps(Run& run) {
  const auto mission_count = static_cast<std::size_t>(run.sweep.trials);
  for (MapPlan& map : run.schedule.maps) {
    if (waiting_count(map) == 0) continue;
    auto known = run.database.read_map(map.key);
    if (!known || known->record.missions.size() < mission_count) continue;
    known->record.missions.resize(mission_count);
    run.database.add_map(*known, run.sweep.name);
    settle_map(run, map, std::move(known->record));
  }
}

/// The latencies that the trial replays, if it does.
std::optional<std::vector<double>> latencies_of(Run& run, const TrialSpec& spec) {
  if (spec.latency.mode != LatencyMode::replay) return std::nullopt;
  auto latencies_s = run.recorded.of(spec);
  if (!latencies_s || latency_digest(*latencies_s) != spec.latency_digest) {
    throw InputError(
        {.file = spec.latency.database, .message = "the replayed trials changed during the run"});
  }
  return latencies_s;
}

Job job_of(Run& run, const Assignment& assignment) {
  const MapPlan& map = run.schedule.maps[assignment.map];
  if (!assignment.trial)
    return {.spec = map.spec,
            .mission_count = run.sweep.trials,
            .mission = {},
            .recorded_latency_s = {}};
  const TrialSpec spec = run.schedule.trials[*assignment.trial].spec();
  return {.spec = spec,
          .mission_count = 0,
          .mission = map.record->missions[static_cast<std::size_t>(spec.mission_index)],
          .recorded_latency_s = latencies_of(run, spec)};
}

void commit_map(Run& run, MapPlan& map, MapRecord record) {
  record.key = map.key;
  nlohmann::json spec = spec_to_json(map.spec.map);
  forget_folder(spec);
  run.database.add_map({.record = record,
                        .generator = std::string(kind(map.spec.map)),
                        .spec_json = spec.dump(),
                        .map_seed = map.spec.map_seed},
                       run.sweep.name);
  settle_map(run, map, std::move(record));
}

std::filesystem::file_time_type time_written(const std::string& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

/// A library that is written over while it is flown flies neither the old planner nor the new one,
/// or crashes: such a trial is nobody's.
void require_unchanged(const Run& run, const PlannerChoice& planner) {
  const auto written = run.planner_written.find(planner.file);
  if (written == run.planner_written.end() || written->second == time_written(planner.file)) return;
  if (file_digest(planner.file) == planner.file_digest) return;
  throw InputError({.file = planner.file, .message = "the planner's file changed during the run"});
}

void commit_trial(Run& run, const Assignment& assignment, TrialRecord record,
                  std::vector<double> metrics, double wall_time_s) {
  const TrialSpec spec = run.schedule.trials[*assignment.trial].spec();
  require_unchanged(run, spec.planner);
  PlannerProgress& planner = run.progress.planners[spec.planner.label];
  ++planner.flown;
  if (record.outcome == Outcome::reached_goal) ++planner.reached_goal;
  run.database.add_trial({.key = run.schedule.keys[*assignment.trial],
                          .sweep = run.sweep.name,
                          .map_key = run.schedule.maps[assignment.map].key,
                          .planner_label = spec.planner.label,
                          .planner_file_digest = spec.planner.file_digest,
                          .mission_index = spec.mission_index,
                          .spec_json = trial_json(spec),
                          .record = std::move(record),
                          .metrics = std::move(metrics),
                          .wall_time_s = wall_time_s});
  ++run.progress.done;
  report_progress(run);
}

void take_result(Run& run, const Assignment& assignment, JobResult result) {
  MapPlan& map = run.schedule.maps[assignment.map];
  if (!result.error.empty()) throw InputError(run.sweep.name + ": " + result.error);
  if (assignment.trial) {
    commit_trial(run, assignment, std::move(*result.trial), std::move(result.metrics),
                 result.wall_time_s);
  } else {
    commit_map(run, map, std::move(*result.map));
  }
}

/// Whether somebody else ended the worker: a person, the kernel out of memory, a cluster.
bool is_from_outside(const ProcessEnd& end) {
  return end.signal == SIGKILL || end.signal == SIGTERM || end.signal == SIGHUP;
}

/// Why a worker is gone: what that makes of the trial it flew.
struct Death {
  Outcome outcome = Outcome::planner_crashed;
  std::string reason;
};

Death death_of(const ProcessEnd& end, const std::string& notes, const PlannerChoice& planner) {
  switch (end.exit_code) {
    case kHungExitCode:
      return {Outcome::planner_hung, "a planner call lasted longer than the plan timeout"};
    case kMemoryExitCode:
      return {.reason = "the worker used more memory than --memory-limit allows"};
    case kPipesExitCode:
      return {.reason = "the worker's own pipes were closed or written to"};
    default:
      break;
  }
  const std::string places = crash_places(notes, planner.file);
  return {.reason = "the worker ended by " + end.text + (places.empty() ? "" : " in " + places)};
}

/// The worker is gone: its trial has an outcome all the same.
void take_death(Run& run, const Assignment& assignment, const Death& death) {
  if (!assignment.trial) {
    throw InputError("the worker that measured a map of " + run.sweep.name +
                     " ended: " + death.reason);
  }
  const Job job = job_of(run, assignment);
  TrialRecord record;
  record.outcome = death.outcome;
  record.reason = death.reason;
  std::vector<double> metrics = compute_metrics({job.spec, *job.mission, record});
  commit_trial(run, assignment, std::move(record), std::move(metrics), std::nan(""));
}

void run_in_process(Run& run) {
  Worker worker;
  Memory memory;
  while (!run.is_stopped()) {
    const auto assignment = next_assignment(run.schedule, memory);
    if (!assignment) return;
    memory = memory_after(run, *assignment);
    take_result(run, *assignment, worker.work(job_of(run, *assignment)));
  }
}

void replace_process(const Run& run, Seat& seat) {
  seat.process = WorkerProcess(run.options.worker_command);
  seat.memory = {};
}

/// Hands the seat its next job, if there is one for it. A process flies one planner only, so that
/// what one does to its process is no other one's misfortune. A worker that is gone is replaced
/// once.
void hand_out(Run& run, Seat& seat) {
  seat.assignment = next_assignment(run.schedule, seat.memory);
  if (!seat.assignment) return;
  const Memory next = memory_after(run, *seat.assignment);
  const std::string& flown = seat.memory.planner_label;
  if (!flown.empty() && flown != next.planner_label) replace_process(run, seat);
  seat.memory = next;
  seat.silent_s = 0.0;
  const Message message = job_message(job_of(run, *seat.assignment));
  if (seat.process.send(message)) return;
  seat.process = WorkerProcess(run.options.worker_command);
  if (!seat.process.send(message)) throw InputError("worker processes end before they take a job");
}

/// What a busy seat has to say.
void take_from(Run& run, Seat& seat) {
  const Assignment assignment = *seat.assignment;
  seat.assignment.reset();
  const auto message = seat.process.receive();
  std::optional<JobResult> result;
  if (message) result = result_from(*message);
  if (result && !(result->is_out_of_memory && assignment.trial)) {
    return take_result(run, assignment, std::move(*result));
  }
  const ProcessEnd end =
      result ? ProcessEnd{.text = {}, .exit_code = kMemoryExitCode} : seat.process.wait();
  if (is_from_outside(end) && run.killed_once.insert({assignment.map, assignment.trial}).second) {
    give_back(run.schedule, assignment);  // once; a planner may have done it itself
    return replace_process(run, seat);
  }
  const PlannerChoice& planner = run.schedule.trials[assignment.trial.value_or(0)].setting->planner;
  take_death(run, assignment, death_of(end, seat.process.notes(), planner));
  replace_process(run, seat);
}

/// Ends a worker that does not even say that it lives: stopped by a signal, or worse.
void give_up_on(Run& run, Seat& seat) {
  const Assignment assignment = *seat.assignment;
  seat.assignment.reset();
  take_death(run, assignment, {Outcome::planner_hung, "the worker did not answer any more"});
  replace_process(run, seat);
}

/// Waits a second at most until busy seats have something to say, and takes it.
void take_next_results(Run& run, std::vector<Seat>& seats) {
  constexpr int kWait_ms = 1000;
  std::vector<pollfd> waiting;
  std::vector<Seat*> busy;
  for (Seat& seat : seats) {
    if (!seat.assignment) continue;
    waiting.push_back({.fd = seat.process.result_fd(), .events = POLLIN, .revents = 0});
    busy.push_back(&seat);
  }
  const Clock::time_point began = Clock::now();
  if (::poll(waiting.data(), waiting.size(), kWait_ms) < 0) {
    return;  // a signal: the caller looks at `stop`
  }
  // No wait counts for longer: what stops this process stops its workers, too.
  const std::chrono::duration<double> waited = Clock::now() - began;
  const double waited_s = std::min(waited.count(), 1e-3 * kWait_ms);
  for (std::size_t i = 0; i < busy.size(); ++i) {
    Seat& seat = *busy[i];
    seat.silent_s = seat.process.listen() ? 0.0 : seat.silent_s + waited_s;
    if (waiting[i].revents != 0) {
      take_from(run, seat);
    } else if (seat.silent_s > run.options.silence_s) {
      give_up_on(run, seat);
    }
  }
}

void run_in_workers(Run& run) {
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
  std::vector<Seat> seats;
  for (int i = 0; i < run.options.jobs; ++i) {
    seats.push_back({.process = WorkerProcess(run.options.worker_command),
                     .assignment = {},
                     .memory = {},
                     .silent_s = 0.0});
  }
  std::optional<Clock::time_point> stopped;
  while (true) {
    bool is_busy = false;
    for (Seat& seat : seats) {
      if (!seat.assignment && !run.is_stopped()) hand_out(run, seat);
      is_busy = is_busy || seat.assignment.has_value();
    }
    if (!is_busy) return;
    if (run.is_stopped() && !stopped) stopped = Clock::now();
    const std::chrono::duration<double> grace(run.options.grace_s);
    if (stopped && Clock::now() - *stopped > grace) return;  // the seats' processes are killed
    take_next_results(run, seats);
    report_progress(run);
  }
}

/// The finished trials, but for those that are wanted again.
std::set<std::string> keys_to_skip(const Database& database, const RunOptions& options) {
  if (options.rerun == Rerun::none) return database.finished_keys();
  std::set<std::string> keys;
  for (const auto& [key, outcome] : database.finished_trials()) {
    const bool has_failed = outcome == Outcome::planner_error ||
                            outcome == Outcome::planner_crashed || outcome == Outcome::planner_hung;
    const bool again = options.rerun == Rerun::all ||
                       (options.rerun == Rerun::failed && has_failed) ||
                       (options.rerun == Rerun::chosen && key.starts_with(options.rerun_key));
    if (!again) keys.insert(key);
  }
  return keys;
}

/// Flies those of `trials` that are not in `skip`.
void fly(Run& run, std::vector<PlannedTrial> trials, const std::set<std::string>& skip) {
  const std::int64_t flown = run.progress.done - run.progress.done_before;
  run.schedule = make_schedule(std::move(trials), skip);
  run.progress.total = static_cast<std::int64_t>(run.schedule.trials.size());
  run.progress.done = static_cast<std::int64_t>(run.schedule.done_before);
  run.progress.done_before = run.progress.done - flown;
  run.progress.invalid_missions = 0;
  run.killed_once.clear();
  run.database.add_to_sweep(run.sweep.name, run.schedule.keys);
  const bool has_work = run.progress.done < run.progress.total;
  if (has_work && !run.has_begun) run.database.add_run(run.provenance);
  run.has_begun = run.has_begun || has_work;
  recall_maps(run);
  report_progress(run);
  if (run.options.in_process) {
    run_in_process(run);
  } else if (has_work) {
    run_in_workers(run);
  }
}

/// Those planners of the last schedule that have flown enough.
std::set<std::string> planners_with_enough(const Run& run) {
  struct Counts {
    std::int64_t finished = 0, trials = 0;
  };
  std::map<std::string, Counts> planners;
  const std::map<std::string, Outcome> outcomes = run.database.finished_trials();
  for (std::size_t i = 0; i < run.schedule.trials.size(); ++i) {
    const auto outcome = outcomes.find(run.schedule.keys[i]);
    if (outcome == outcomes.end()) continue;  // an invalid mission
    Counts& counts = planners[run.schedule.trials[i].planner_label()];
    counts.trials += 1;
    counts.finished += outcome->second == Outcome::reached_goal ? 1 : 0;
  }
  std::set<std::string> enough;
  for (const auto& [label, counts] : planners) {
    if (is_enough(run.sweep.until, counts.finished, counts.trials)) enough.insert(label);
  }
  return enough;
}

/// Flies the sweep's missions in rounds; a planner whose rule is met stays out of further ones.
void fly_until(Run& run, const std::vector<PlannedTrial>& trials, std::set<std::string>& skip) {
  std::map<std::string, std::int64_t> last_mission;  // of the planners that have flown enough
  for (const std::int64_t mission_count : looks(run.sweep.trials)) {
    std::vector<PlannedTrial> round;
    for (const PlannedTrial& trial : trials) {
      const auto end = last_mission.find(trial.planner_label());
      const std::int64_t count = end == last_mission.end() ? mission_count : end->second;
      if (trial.mission_index < count) round.push_back(trial);
    }
    fly(run, std::move(round), skip);
    if (run.is_stopped()) return;
    skip.insert(run.schedule.keys.begin(), run.schedule.keys.end());
    for (const std::string& label : planners_with_enough(run)) {
      last_mission.emplace(label, mission_count);
    }
  }
}

}  // namespace

RunSummary run_sweep(const SweepSpec& sweep, const RunRow& provenance, Database& database,
                     const RunOptions& options) {
  if (sweep.until.is_set() && options.shard.count > 1) {
    throw InputError(
        "until: whether a planner has flown enough is seen from all of its trials, a shard has "
        "only some: fly the sweep on one machine, or without 'until'");
  }
  Run run{.sweep = sweep,
          .options = options,
          .provenance = provenance,
          .database = database,
          .schedule = {},
          .progress = {},
          .recorded = {},
          .killed_once = {},
          .planner_written = {}};
  for (const PlannerChoice& planner : sweep.planners) {
    run.planner_written[planner.file] = time_written(planner.file);
  }
  std::set<std::string> skip = keys_to_skip(database, options);
  std::vector<PlannedTrial> trials = expand(sweep);
  const std::int64_t revision =
      database.add_sweep({.name = sweep.name, .spec_json = sweep_json(sweep, trials)});
  trials = trials_of(options.shard, std::move(trials));
  for (const PlannerChoice& planner : sweep.planners) database.add_planner(planner_row(planner));
  if (sweep.until.is_set()) {
    fly_until(run, trials, skip);
  } else {
    fly(run, std::move(trials), skip);
  }
  return {.progress = run.progress, .revision = revision, .is_stopped = run.is_stopped()};
}

}  // namespace avoidbench
