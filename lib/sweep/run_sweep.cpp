#include "sweep/run_sweep.hpp"

#include <poll.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "plugin/planner_library.hpp"
#include "sweep/job.hpp"
#include "sweep/schedule.hpp"
#include "sweep/worker.hpp"
#include "sweep/worker_process.hpp"

namespace avoidbench {
namespace {

/// The run as the parent sees it.
struct Run {
  const SweepSpec& sweep;
  const RunOptions& options;
  Database& database;
  Schedule schedule;
  Progress progress;

  bool is_stopped() const { return options.stop != nullptr && options.stop->load(); }
};

/// A worker process and what it is doing.
struct Seat {
  WorkerProcess process;
  std::optional<Assignment> assignment;
  std::optional<std::size_t> last_map;
};

/// Of a map's file only the name is kept; its file_digest says which it is.
void forget_folder(nlohmann::json& map) {
  if (!map.contains("file")) return;
  map["file"] = std::filesystem::path(map["file"].get<std::string>()).filename().string();
}

nlohmann::json axis_json(const Axis& axis) {
  nlohmann::json values = axis.values;
  if (axis.path == "map.file") {
    for (nlohmann::json& value : values) {
      value = {{"file", value}, {"file_digest", file_digest(value.get<std::string>())}};
      forget_folder(value);
    }
  }
  return {{"path", axis.path}, {"values", values}};
}

std::string sweep_json(const SweepSpec& sweep) {
  nlohmann::json axes = nlohmann::json::array(), planners = nlohmann::json::array();
  for (const Axis& axis : sweep.axes) axes.push_back(axis_json(axis));
  for (const PlannerChoice& planner : sweep.planners) {
    nlohmann::json choice = spec_to_json(planner);
    choice.erase("file");
    planners.push_back(choice);
  }
  nlohmann::json base = spec_to_json(sweep.base);
  base.erase("planner");
  forget_folder(base["map"]);
  return nlohmann::json{{"name", sweep.name},
                        {"base", base},
                        {"axes", axes},
                        {"trials", sweep.trials},
                        {"planners", planners}}
      .dump();
}

PlannerRow planner_row(const PlannerChoice& choice) {
  const PlannerDescription planner = PlannerLibrary::load(choice.file).description();
  nlohmann::json parameters = nlohmann::json::object();
  for (const ParameterChoice& parameter : choice.parameters) {
    if (parameter.is_text) {
      parameters[parameter.name] = parameter.text;
    } else {
      parameters[parameter.name] = parameter.number;
    }
  }
  return {.label = choice.label,
          .name = planner.name,
          .version = planner.version,
          .file_digest = choice.file_digest,
          .parameters_json = parameters.dump(),
          .is_privileged = (planner.needs & AB_SEES_WORLD) != 0};
}

void report_progress(const Run& run) {
  if (run.options.on_progress) run.options.on_progress(run.progress);
}

/// The map is known: missions that can't be flown leave the schedule.
void settle_map(Run& run, MapPlan& map, MapRecord record) {
  record.key = map.key;
  map.record = std::move(record);
  const std::size_t before = map.waiting.size();
  std::erase_if(map.waiting, [&](std::size_t trial) {
    const auto index = static_cast<std::size_t>(run.schedule.trials[trial].mission_index);
    return !map.record->missions[index].is_valid;
  });
  run.progress.invalid_missions += static_cast<std::int64_t>(before - map.waiting.size());
  report_progress(run);
}

/// Takes from the database the maps that an earlier run measured with at least as many missions.
void recall_maps(Run& run) {
  const auto mission_count = static_cast<std::size_t>(run.sweep.trials);
  for (MapPlan& map : run.schedule.maps) {
    auto known = run.database.read_map(map.key);
    if (!known || known->record.missions.size() < mission_count) continue;
    known->record.missions.resize(mission_count);
    run.database.add_map(*known, run.sweep.name);
    settle_map(run, map, std::move(known->record));
  }
}

Job job_of(const Run& run, const Assignment& assignment) {
  const MapPlan& map = run.schedule.maps[assignment.map];
  if (!assignment.trial)
    return {.spec = map.spec, .mission_count = run.sweep.trials, .mission = {}};
  const TrialSpec& spec = run.schedule.trials[*assignment.trial];
  return {.spec = spec,
          .mission_count = 0,
          .mission = map.record->missions[static_cast<std::size_t>(spec.mission_index)]};
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

void commit_trial(Run& run, const Assignment& assignment, TrialRecord record,
                  std::vector<double> metrics) {
  const TrialSpec& spec = run.schedule.trials[*assignment.trial];
  PlannerProgress& planner = run.progress.planners[spec.planner.label];
  ++planner.flown;
  if (record.outcome == Outcome::reached_goal) ++planner.reached_goal;
  nlohmann::json canonical = spec_to_json(spec);
  canonical["planner"].erase("file");
  forget_folder(canonical["map"]);
  run.database.add_trial({.key = run.schedule.keys[*assignment.trial],
                          .sweep = run.sweep.name,
                          .map_key = run.schedule.maps[assignment.map].key,
                          .planner_label = spec.planner.label,
                          .planner_file_digest = spec.planner.file_digest,
                          .mission_index = spec.mission_index,
                          .spec_json = canonical.dump(),
                          .record = std::move(record),
                          .metrics = std::move(metrics)});
  ++run.progress.done;
  report_progress(run);
}

void take_result(Run& run, const Assignment& assignment, JobResult result) {
  MapPlan& map = run.schedule.maps[assignment.map];
  if (!result.error.empty()) throw InputError(run.sweep.name + ": " + result.error);
  if (assignment.trial) {
    commit_trial(run, assignment, std::move(*result.trial), std::move(result.metrics));
  } else {
    commit_map(run, map, std::move(*result.map));
  }
}

/// The worker is gone: its trial has an outcome all the same.
void take_death(Run& run, const Assignment& assignment, const ProcessEnd& end) {
  if (!assignment.trial) {
    throw InputError("the worker that measured a map of " + run.sweep.name + " ended by " +
                     end.text);
  }
  const Job job = job_of(run, assignment);
  TrialRecord record;
  const bool is_hung = end.exit_code == kHungExitCode;
  record.outcome = is_hung ? Outcome::planner_hung : Outcome::planner_crashed;
  record.reason = is_hung ? "a planner call lasted longer than the plan timeout"
                          : "the worker ended by " + end.text;
  std::vector<double> metrics = compute_metrics({job.spec, *job.mission, record});
  commit_trial(run, assignment, std::move(record), std::move(metrics));
}

void run_in_process(Run& run) {
  Worker worker;
  std::optional<std::size_t> last_map;
  while (!run.is_stopped()) {
    const auto assignment = next_assignment(run.schedule, last_map);
    if (!assignment) return;
    last_map = assignment->map;
    take_result(run, *assignment, worker.work(job_of(run, *assignment)));
  }
}

/// Hands the seat its next job, if there is one for it. A worker that is gone is replaced once.
void hand_out(Run& run, Seat& seat) {
  seat.assignment = next_assignment(run.schedule, seat.last_map);
  if (!seat.assignment) return;
  seat.last_map = seat.assignment->map;
  const Message message = job_message(job_of(run, *seat.assignment));
  if (seat.process.send(message)) return;
  seat.process = WorkerProcess(run.options.worker_command);
  if (!seat.process.send(message)) throw InputError("worker processes end before they take a job");
}

/// Waits until a busy seat has something to say, and takes it.
void take_next_results(Run& run, std::vector<Seat>& seats) {
  std::vector<pollfd> waiting;
  std::vector<Seat*> busy;
  for (Seat& seat : seats) {
    if (!seat.assignment) continue;
    waiting.push_back({.fd = seat.process.result_fd(), .events = POLLIN, .revents = 0});
    busy.push_back(&seat);
  }
  if (::poll(waiting.data(), waiting.size(), -1) < 0)
    return;  // a signal: the caller looks at `stop`
  for (std::size_t i = 0; i < busy.size(); ++i) {
    if (waiting[i].revents == 0) continue;
    Seat& seat = *busy[i];
    const Assignment assignment = *seat.assignment;
    seat.assignment.reset();
    if (const auto message = seat.process.receive()) {
      take_result(run, assignment, result_from(*message));
    } else {
      take_death(run, assignment, seat.process.wait());
      seat.process = WorkerProcess(run.options.worker_command);
      seat.last_map.reset();
    }
  }
}

void run_in_workers(Run& run) {
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
  std::vector<Seat> seats;
  for (int i = 0; i < run.options.jobs; ++i) {
    seats.push_back(
        {.process = WorkerProcess(run.options.worker_command), .assignment = {}, .last_map = {}});
  }
  while (true) {
    bool is_busy = false;
    for (Seat& seat : seats) {
      if (!seat.assignment && !run.is_stopped()) hand_out(run, seat);
      is_busy = is_busy || seat.assignment.has_value();
    }
    if (!is_busy) return;
    take_next_results(run, seats);
  }
}

}  // namespace

RunSummary run_sweep(const SweepSpec& sweep, const RunRow& provenance, Database& database,
                     const RunOptions& options) {
  Run run{.sweep = sweep, .options = options, .database = database, .schedule = {}, .progress = {}};
  run.schedule = make_schedule(expand(sweep), database.finished_keys());
  run.progress.total = static_cast<std::int64_t>(run.schedule.trials.size());
  run.progress.done_before = static_cast<std::int64_t>(run.schedule.done_before);
  run.progress.done = run.progress.done_before;
  database.add_sweep({.name = sweep.name, .spec_json = sweep_json(sweep)});
  for (const PlannerChoice& planner : sweep.planners) database.add_planner(planner_row(planner));
  database.add_to_sweep(sweep.name, run.schedule.keys);
  const bool has_work = run.progress.done < run.progress.total;
  if (has_work) database.add_run(provenance);
  recall_maps(run);
  report_progress(run);
  if (options.in_process) {
    run_in_process(run);
  } else if (has_work) {
    run_in_workers(run);
  }
  return {.progress = run.progress, .is_stopped = run.is_stopped()};
}

}  // namespace avoidbench
