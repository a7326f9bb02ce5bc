#include "sweep/run_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "metrics/metric_table.hpp"
#include "sweep/listed_missions.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

/// The map is known: missions that can't be flown leave the schedule.
void settle_map(Run& run, MapPlan& map, MapRecord record) {
  record.key = map.key;
  map.record = std::move(record);
  // Only what waits is counted: trials that the database has stay done.
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

/// The latencies that the trial replays, if it does.
std::optional<std::vector<double>> latencies_of(Run& run, const TrialSpec& spec) {
  if (spec.latency.mode != LatencyMode::replay) return std::nullopt;
  auto latencies_s = run.recorded.of(spec);
  // The key of this trial was made of the digest: other times would be stored under it.
  if (!latencies_s || latency_digest(*latencies_s) != spec.latency_digest) {
    throw InputError(
        {.file = spec.latency.database, .message = "the replayed trials changed during the run"});
  }
  return latencies_s;
}

/// Stored first: a run that is killed after it need not measure the map again.
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

/// A library that is written over while it is flown flies neither the old planner nor the new one,
/// or crashes: such a trial is nobody's.
void require_unchanged(Run& run, const PluginChoice& planner) {
  // Size, inode and times first: a digest of the files for each trial would cost more than short
  // flights do.
  for (const std::filesystem::path& file : files_of(planner)) {
    const auto known = run.planner_files.find(file.string());
    const FileState now = file_state(file);
    if (known == run.planner_files.end() || known->second == now) continue;
    if (now.bytes < 0 || digest_now(planner.file, planner.files) != planner.file_digest) {
      throw InputError(
          {.file = file.string(), .message = "the planner's file changed during the run"});
    }
    known->second = now;  // touched only
  }
}

/// One transaction a trial: a run that is killed loses only the flights under way.
void commit_trial(Run& run, const Assignment& assignment, TrialRecord record,
                  std::vector<double> metrics, double wall_time_s) {
  const TrialSpec spec = run.schedule.trials[*assignment.trial].spec();
  for (const PluginChoice* plugin : plugins_of(spec.planner)) require_unchanged(run, *plugin);
  // All levels of a limit's field together: there are dozens.
  PlannerProgress& planner =
      run.progress.planners[label_without(spec.planner.label, run.sweep.limit)];
  ++planner.flown;
  if (record.outcome == Outcome::reached_goal) ++planner.reached_goal;
  run.database.add_trial({.key = run.schedule.keys[*assignment.trial],
                          .sweep = run.sweep.name,
                          .map_key = run.schedule.maps[assignment.map].key,
                          .planner_label = spec.planner.label,
                          .planner_file_digest = flown_digest(spec.planner),
                          .mission_index = spec.mission_index,
                          .spec_json = trial_json(spec),
                          .record = std::move(record),
                          .metrics = std::move(metrics),
                          .wall_time_s = wall_time_s});
  ++run.progress.done;
  report_progress(run);
}

}  // namespace

void report_progress(const Run& run) {
  if (run.options.on_progress) run.options.on_progress(run.progress);
}

/// Maps that the database has need not be measured.
void recall_maps(Run& run) {
  for (MapPlan& map : run.schedule.maps) {
    if (waiting_count(map) == 0) continue;
    const auto count = static_cast<std::size_t>(mission_count(run.sweep, map.spec));
    auto known = run.database.read_map(map.key);
    // A sweep of more missions measures the map again: the missions that are there come out the
    // same.
    if (!known || known->record.missions.size() < count) continue;
    known->record.missions.resize(count);
    run.database.add_map(*known, run.sweep.name);
    settle_map(run, map, std::move(known->record));
  }
}

Job job_of(Run& run, const Assignment& assignment) {
  const MapPlan& map = run.schedule.maps[assignment.map];
  if (!assignment.trial) {
    return {.token = make_token(),
            .spec = map.spec,
            .mission_count = mission_count(run.sweep, map.spec),
            .listed_missions = missions_of(run.sweep.missions, map.spec),
            .mission = {},
            .recorded_latency_s = {}};
  }
  const TrialSpec spec = run.schedule.trials[*assignment.trial].spec();
  return {.token = make_token(),
          .spec = spec,
          .mission_count = 0,
          .listed_missions = {},
          .mission = map.record->missions[static_cast<std::size_t>(spec.mission_index)],
          .recorded_latency_s = latencies_of(run, spec)};
}

void take_result(Run& run, const Assignment& assignment, JobResult result) {
  MapPlan& map = run.schedule.maps[assignment.map];
  // No map, no file: an error of the run, not an outcome of a trial.
  if (!result.error.empty()) throw InputError(run.sweep.name + ": " + result.error);
  if (assignment.trial) {
    commit_trial(run, assignment, std::move(*result.trial), std::move(result.metrics),
                 result.wall_time_s);
  } else {
    commit_map(run, map, std::move(*result.map));
  }
}

void take_death(Run& run, const Assignment& assignment, const Job& job, const Death& death) {
  // No planner is in the process then: the fault is the machine's or ours.
  if (!assignment.trial) {
    const bool has_words = !death.reason.ends_with(death.last_words);
    throw InputError("the worker that measured a map of " + run.sweep.name + " ended: " +
                     death.reason + (has_words ? " (it printed: " + death.last_words + ")" : "") +
                     "; run the same command again, with fewer workers if memory is short");
  }
  TrialRecord record;
  // As far as it came; the outcome is the death's.
  if (death.flown) record = *death.flown;
  record.outcome = death.outcome;
  record.reason = death.reason;
  std::vector<double> metrics = compute_metrics({job.spec, *job.mission, record});
  if (!death.last_words.empty()) {
    run.last_words[run.schedule.keys[*assignment.trial]] = death.last_words;
  }
  // How long the flight took is not known.
  commit_trial(run, assignment, std::move(record), std::move(metrics), std::nan(""));
}

}  // namespace avoidbench
