#include "sweep/run_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/json_path.hpp"
#include "base/kept_files.hpp"
#include "base/spec_json.hpp"
#include "plugin/planner_description.hpp"
#include "plugin/planner_library.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/limit_search.hpp"
#include "sweep/run_in_workers.hpp"
#include "sweep/run_state.hpp"
#include "sweep/spec_changes.hpp"
#include "sweep/sweep_rows.hpp"
#include "worker/worker.hpp"

namespace avoidbench {
namespace {

using Changes = std::vector<std::string>;

/// One job after the other, without sandbox and without time limits: for debuggers and tests.
void run_in_process(Run& run) {
  Worker worker;
  Memory memory;
  while (!run.is_stopped()) {
    const auto assignment = next_assignment(run.schedule, memory);
    if (!assignment) return;
    memory.map = assignment->map;
    if (assignment->trial)
      memory.planner_label = run.schedule.trials[*assignment->trial].planner_label();
    take_result(run, *assignment, worker.work(job_of(run, *assignment)));
  }
}

/// The finished trials, except those that are wanted again.
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
  // In a later round the progress goes on: what earlier rounds flew stays flown, not found.
  const std::int64_t flown = run.progress.done - run.progress.done_before;
  run.schedule = make_schedule(std::move(trials), skip);
  run.progress.total = static_cast<std::int64_t>(run.schedule.trials.size());
  run.progress.done = static_cast<std::int64_t>(run.schedule.done_before);
  run.progress.done_before = run.progress.done - flown;
  run.progress.invalid_missions = 0;
  // Trials that another sweep flew belong to this one, too.
  run.database.add_to_sweep(run.sweep.name, run.schedule.keys);
  const bool has_work = run.progress.done < run.progress.total;
  // A run that finds everything done leaves no row.
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

/// Adds the trials of the last round that are in the database, which those of invalid missions
/// never are.
void skip_flown(const Run& run, std::set<std::string>& skip) {
  const std::set<std::string> finished = run.database.finished_keys();
  for (const std::string& key : run.schedule.keys) {
    if (finished.contains(key)) skip.insert(key);
  }
}

/// The trials of the next round, those of rounds before it among them; nothing after the last.
using NextRound = std::function<std::optional<std::vector<PlannedTrial>>()>;

/// Flies round after round. What a round flies may follow from all trials of those before.
void fly_rounds(Run& run, const NextRound& next, std::set<std::string> skip) {
  for (bool is_first = true;; is_first = false) {
    std::optional<std::vector<PlannedTrial>> round = next();
    if (!round) return;
    if (!is_first) skip_flown(run, skip);
    fly(run, *std::move(round), skip);
    // A round that was not flown to its end decides nothing.
    if (run.is_stopped() || !run.unflown.empty()) return;
  }
}

/// All trials at once.
NextRound one_round(std::vector<PlannedTrial> trials) {
  return [trials = std::optional(std::move(trials))]() mutable {
    return std::exchange(trials, std::nullopt);
  };
}

/// More and more missions; a planner whose rule is met stays out of further rounds.
NextRound rounds_until_enough(const Run& run, std::vector<PlannedTrial> trials) {
  // A planner with enough keeps the missions of its last round in later ones: they are skipped as
  // done, and stay part of the schedule that is counted.
  std::map<std::string, std::int64_t> last_mission;  // of the planners that have flown enough
  return
      [&run, trials = std::move(trials), counts = looks(run.sweep.trials), round = std::size_t{0},
       last_mission]() mutable -> std::optional<std::vector<PlannedTrial>> {
        if (round > 0) {
          for (const std::string& label : planners_with_enough(run)) {
            last_mission.emplace(label, counts[round - 1]);
          }
        }
        if (round == counts.size()) return std::nullopt;
        std::vector<PlannedTrial> chosen;
        for (const PlannedTrial& trial : trials) {
          const auto end = last_mission.find(trial.planner_label());
          const std::int64_t count = end == last_mission.end() ? counts[round] : end->second;
          if (trial.mission_index < count) chosen.push_back(trial);
        }
        ++round;
        return chosen;
      };
}

/// The field's value in a trial.
double limit_value(const TrialSpec& trial, const nlohmann::json& spec, const std::string& field) {
  if (!field.starts_with(kOfPlanner)) {
    return spec.at(json_place(field)).get<double>();
  }
  for (const ParameterChoice& parameter : trial.planner.parameters) {
    if (parameter.name == field.substr(kOfPlanner.size())) return parameter.number;
  }
  return std::nan("");
}

std::string place_of(const nlohmann::json& spec, std::uint64_t map_seed, const LimitRule& rule) {
  nlohmann::json map = spec.at("map");
  forget_folder(map);
  return map_place(std::move(map), map_seed, rule);
}

/// What the search needs to know of all trials.
std::vector<LimitTrial> limit_trials(const LimitRule& rule,
                                     const std::vector<PlannedTrial>& trials) {
  struct Setting {
    std::size_t level = 0;
    std::string place, label;
  };
  std::map<const TrialSpec*, Setting> settings;  // shared by their missions
  KeyMaker keys;
  std::vector<LimitTrial> all;
  for (const PlannedTrial& trial : trials) {
    const TrialSpec& setting = *trial.setting;
    auto known = settings.find(&setting);
    if (known == settings.end()) {
      const nlohmann::json spec = spec_to_json(setting);
      const auto level = level_of(rule, limit_value(setting, spec, rule.field));
      AB_CHECK(level.has_value(), rule.field);
      known = settings
                  .emplace(&setting, Setting{*level, place_of(spec, setting.map_seed, rule),
                                             label_without(setting.planner.label, rule)})
                  .first;
    }
    all.push_back({.key = keys.trial_key(trial),
                   .planner = known->second.label,
                   .map = known->second.place,
                   .level = known->second.level,
                   .mission_index = trial.mission_index});
  }
  return all;
}

/// Of all finished trials, whether they count as a success of the limit.
std::map<std::string, bool> limit_successes(const Database& database, const LimitRule& rule) {
  const std::map<std::string, double> velocities = database.goal_velocities_mps();
  std::map<std::string, bool> successes;
  for (const auto& [key, outcome] : database.finished_trials()) {
    successes.emplace(key, rule.is_success(outcome, velocities.at(key)));
  }
  return successes;
}

/// The trials that tell most of the limit by what the rounds before found.
NextRound rounds_to_limit(const Run& run, std::vector<PlannedTrial> trials) {
  const auto search =
      std::make_shared<LimitSearch>(run.sweep.limit, limit_trials(run.sweep.limit, trials));
  return
      [&run, search, trials = std::move(trials),
       asked = std::vector<PlannedTrial>()]() mutable -> std::optional<std::vector<PlannedTrial>> {
        const std::vector<std::size_t> round =
            search->next_round(limit_successes(run.database, run.sweep.limit));
        if (round.empty()) return std::nullopt;
        // Those before are skipped as done, and counted.
        for (const std::size_t trial : round) asked.push_back(trials[trial]);
        return asked;
      };
}

NextRound rounds_of(const Run& run, std::vector<PlannedTrial> trials) {
  if (run.sweep.limit.is_set()) return rounds_to_limit(run, std::move(trials));
  if (run.sweep.until.is_set()) return rounds_until_enough(run, std::move(trials));
  return one_round(std::move(trials));
}

/// Adds the sweep, and says so where the database has it with other contents.
std::int64_t add_sweep(Database& database, const SweepRow& row, const RunOptions& options) {
  std::optional<SweepInfo> latest;  // before this run
  for (const SweepInfo& info : database.read_sweeps()) {
    if (info.name == row.name) latest = info;
  }
  const std::int64_t revision = database.add_sweep(row);
  if (!latest || latest->revision == revision || !options.on_revision) return revision;
  const bool is_new = revision > latest->revision;
  options.on_revision(
      {.revision = revision,
       .latest = std::max(revision, latest->revision),
       .is_new = is_new,
       .changes = is_new ? spec_changes(latest->spec_json, row.spec_json) : Changes{}});
  return revision;
}

/// The planners, and with `with_maps` the maps and wind fields that come from files, each once.
std::vector<FlownFile> flown_files(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials,
                                   bool with_maps) {
  std::map<std::string, FlownFile> files;  // by digest
  for (const PlannerChoice& planner : sweep.planners) {
    for (const PluginChoice* plugin : plugins_of(planner)) {
      // A copy of one of several files alone is no planner.
      if (!plugin->files.empty()) continue;
      files[plugin->file_digest] = {.file = plugin->file,
                                    .digest = plugin->file_digest,
                                    .is_program = PlannerLibrary::is_program(plugin->source())};
    }
  }
  std::set<const TrialSpec*> seen;
  for (const PlannedTrial& trial : trials) {
    if (!with_maps || !seen.insert(trial.setting.get()).second) continue;
    MapSpec map = trial.setting->map;
    const FileOfMap file = file_of(map);
    if (file.file != nullptr) files[*file.digest] = {*file.file, *file.digest, false};
    const WindFieldSpec& wind = trial.setting->wind.field;
    if (!wind.file.empty()) files[wind.file_digest] = {wind.file, wind.file_digest, false};
  }
  std::vector<FlownFile> all;
  for (auto& [digest, file] : files) all.push_back(std::move(file));
  return all;
}

}  // namespace

RunSummary run_sweep(const SweepSpec& sweep, const RunRow& provenance, Database& database,
                     const RunOptions& options) {
  // Shards do not know each other's results, and the rule must give the same trials wherever they
  // are flown.
  if (sweep.limit.is_set() && options.shard.count > 1) {
    throw InputError(
        "the search for a limit runs on one machine: each trial depends on those before");
  }
  if (sweep.until.is_set() && options.shard.count > 1) {
    throw InputError(
        "until: a shard has only some of a planner's trials, and all of them decide whether it has "
        "flown enough: fly the sweep on one machine, or without 'until'");
  }
  Run run{.sweep = sweep,
          .options = options,
          .provenance = provenance,
          .database = database,
          .schedule = {},
          .progress = {},
          .recorded = {},
          .planner_files = {},
          .sandbox_rules = {},
          .planners_with_globals = {},
          .unflown = {},
          .left_behind = {},
          .last_words = {}};
  for (const PlannerChoice& planner : sweep.planners) {
    // From here on a changed file ends the run, see require_unchanged().
    for (const PluginChoice* plugin : plugins_of(planner)) {
      for (const std::filesystem::path& file : files_of(*plugin)) {
        run.planner_files[file.string()] = file_state(file);
      }
    }
    const std::uint32_t needs = needs_of(planner);
    run.sandbox_rules[planner.label] = sandbox_rules(needs);
    if ((needs & AB_USES_GLOBALS) != 0) run.planners_with_globals.insert(planner.label);
  }
  std::vector<PlannedTrial> trials = expand(sweep);
  const std::int64_t revision =
      add_sweep(database, {.name = sweep.name, .spec_json = sweep_json(sweep, trials)}, options);
  // After add_sweep(): every shard stores the whole sweep, so that merge knows what is missing.
  trials = trials_of(options.shard, std::move(trials));
  if (options.is_wanted) {
    KeyMaker keys;
    std::erase_if(trials, [&](const PlannedTrial& trial) {
      return !options.is_wanted(keys.trial_key(trial));
    });
  }
  for (const PlannerChoice& planner : sweep.planners) database.add_planner(planner_row(planner));
  std::vector<std::string> unkept;
  if (options.keep_planners) {
    unkept = keep_files(flown_files(sweep, trials, options.keep_maps), database.path());
  }
  run.progress.is_open = sweep.limit.is_set() || sweep.until.is_set();
  fly_rounds(run, rounds_of(run, std::move(trials)), keys_to_skip(database, options));
  if (run.progress.is_open && !run.is_stopped()) {
    run.progress.is_open = false;
    report_progress(run);
  }
  return {.progress = run.progress,
          .revision = revision,
          .is_stopped = run.is_stopped(),
          .unflown = std::move(run.unflown),
          .unkept = std::move(unkept),
          .left_behind = std::move(run.left_behind),
          .last_words = std::move(run.last_words)};
}

}  // namespace avoidbench
