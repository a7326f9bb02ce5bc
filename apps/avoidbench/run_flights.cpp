#include <cmath>
#include <filesystem>
#include <iostream>

#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "metrics/flyable.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "plugin/planner_description.hpp"
#include "process/sandbox.hpp"
#include "replay/provenance.hpp"
#include "run_end.hpp"
#include "run_flights.hpp"
#include "run_page.hpp"
#include "run_progress.hpp"
#include "stop_signals.hpp"
#include "store/database.hpp"
#include "sweep/allowance.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/listed_missions.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/run_estimate.hpp"
#include "sweep/run_sweep.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

/// What workers enter; "" for none.
std::string sandbox_of(const RunCommand& command) {
  return command.no_sandbox || command.in_process ? "" : text(sandbox_support());
}

/// The same for people: "landlock 7, seccomp", "none: --no-sandbox"; with what is granted to
/// planners that declare needs: "landlock 7, seccomp; mine: processes".
std::string sandbox_text(const RunCommand& command, const SweepSpec& sweep) {
  std::string sandbox = sandbox_of(command);
  if (!sandbox.empty()) {
    for (const PlannerChoice& planner : sweep.planners) {
      const std::string granted = text(sandbox_rules(needs_of(planner)));
      if (!granted.empty()) sandbox += "; " + planner.label + ": " + granted;
    }
    return sandbox;
  }
  if (command.in_process) return "none: --in-process";
  return command.no_sandbox ? "none: --no-sandbox" : "none: the kernel has none";
}

RunRow provenance(const RunCommand& command, const SweepSpec& sweep, const Shard& shard) {
  RunRow run = run_on_this_host();
  run.program_version = kVersion;
  run.git_hash = kGitHash;
  run.compiler = kCompiler;
  run.flags = kCompilerFlags;
  run.shard = text(shard);
  run.sandbox = sandbox_text(command, sweep);
  return run;
}

Rerun rerun_from(const std::string& text) {
  if (text.empty()) return Rerun::none;
  if (text == "failed") return Rerun::failed;
  if (text == "all") return Rerun::all;
  constexpr std::size_t kLeastDigits = 6;
  const bool is_key = text.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (is_key && text.size() >= kLeastDigits) return Rerun::chosen;
  throw InputError("--rerun " + text +
                   ": expected failed, all, or a trial's key (its first six digits or more)");
}

void warn(const RunCommand& command, const SweepSpec& sweep, int jobs) {
  if (measures_latency(sweep)) {
    std::cerr << "warning: latency is measured: results depend on this machine and its load\n";
  }
  if (sweep.trials < 10 && !sweep.limit.is_set() && !command.is_of_suite) {
    std::cerr << "warning: " << counted(sweep.trials, "trial")
              << " per map: success rates of single maps are too coarse to compare\n";
  }
  if (jobs > allowed_cpus()) {
    std::cerr << "warning: " << counted(jobs, "worker") << " on " << counted(allowed_cpus(), "CPU")
              << ": processing times will be too long (results do not change, except with "
                 "measured latency)\n";
  }
  for (const PlannerChoice& planner : sweep.planners) {
    const std::string granted = text(sandbox_rules(needs_of(planner)));
    if (granted.empty() || sandbox_of(command).empty()) continue;
    warn_of_granted(planner.label, granted);
  }
  if (!command.in_process && text(sandbox_support()).empty()) {
    std::cerr << "warning: this kernel has no sandbox: planners can do all that you can\n";
  } else if (!sandbox_of(command).empty() && sandbox_support().landlock_abi == 0) {
    std::cerr
        << "warning: this kernel has no Landlock: a planner can write all files that you can\n";
  }
  if (command.in_process) {
    std::cerr << "warning: --in-process: a planner's crash ends the run\n";
  }
}

/// Waits for as long as another program locks the database, and says so; less long once the run is
/// told to stop.
OnWait patience(const RunCommand& command, const StopSignals& signals,
                const std::filesystem::path& file) {
  constexpr double kFirst_s = 3.0, kNext_s = 30.0;
  const auto next_s = std::make_shared<double>(kFirst_s);
  return [grace_s = command.grace_s, &signals, file, next_s](double waited_s) {
    if (waited_s < kFirst_s) *next_s = kFirst_s;
    if (waited_s >= *next_s) {
      std::cerr << "another program holds a lock on " << file.string() << ": waiting for it, "
                << duration_text(waited_s) << " so far\n";
      *next_s = waited_s + kNext_s;
    }
    return !signals.stop_now && !(signals.stop && waited_s > grace_s);
  };
}

[[noreturn]] void end_stopped_run(const StopSignals& signals) {
  if (signals.stop_now) {
    std::cerr << "ended at once; run the same command again to resume\n";
    throw CLI::RuntimeError(128 + signals.number);
  }
  end_stopped(signals, "stopped; run the same command again to resume");
}

Database open_database(const RunCommand& command, const StopSignals& signals,
                       const std::filesystem::path& file) {
  try {
    return Database::open_for_run(file, metric_table(), patience(command, signals, file));
  } catch (const InputError&) {
    if (!signals.stop) throw;
    end_stopped_run(signals);  // it was told to while it waited for a lock
  }
}

/// The database of a sweep whose listed missions can all be flown: none is made for others.
Database open_checked(const RunCommand& command, const SweepSpec& sweep, const Shard& shard,
                      const StopSignals& signals, const std::filesystem::path& file) {
  if (sweep.missions.empty()) return open_database(command, signals, file);
  const std::vector<PlannedTrial> trials = trials_of(shard, expand(sweep));
  std::error_code error;
  const bool is_new = !std::filesystem::exists(file, error);
  if (is_new) check_listed_missions(sweep, trials);
  Database database = open_database(command, signals, file);
  if (!is_new) check_listed_missions(sweep, trials, &database);
  return database;
}

/// Throws where the sweep has no mission that can be flown: that is no result.
void require_flights(const SweepSpec& sweep, const RunSummary& summary, const std::string& file) {
  const Progress& progress = summary.progress;
  const bool has_none = progress.invalid_missions > 0 && progress.done == 0 &&
                        progress.done_before == 0 && summary.unflown.empty();
  if (!has_none) return;
  const TrialSpec first = expand(sweep).front().spec();
  refuse_file(file, "nothing to fly: none of the missions can be flown; " +
                        unflyable_hint(first, sweep.trials) +
                        ". `avoidbench maps show` draws the map");
}

/// What planners may do, and what is kept of them.
void add_protection(CLI::App& command, RunCommand& options) {
  command.add_flag("--in-process", options.in_process, "Fly in this process, for debuggers");
  command.add_flag("--no-sandbox", options.no_sandbox,
                   "Let planners write files, start programs and use the network (docs/trust.md)");
  CLI::Option* bundle =
      command.add_flag("--bundle", options.is_bundle,
                       "Also keep copies of map and wind field files next to the database "
                       "(NAME.maps), so that others can fly its trials again");
  command
      .add_flag("--no-keep", options.no_keep,
                "Keep no copies of the planners next to the database (NAME.planners), which replay "
                "uses to fly a trial again after a rebuild")
      ->excludes(bundle);
}

}  // namespace

std::filesystem::path database_file(const RunCommand& command, const SweepSpec& sweep,
                                    const Shard& shard) {
  if (!command.database_file.empty()) return command.database_file;
  std::string name = sweep.name;
  if (shard.count > 1) {
    name += ".shard" + std::to_string(shard.index) + "of" + std::to_string(shard.count);
  }
  return "results/" + name + ".db";
}

std::int64_t fly_sweep(const RunCommand& command, const SweepSpec& sweep, const Shard& shard) {
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  const int jobs = command.jobs > 0 ? command.jobs : allowed_cpus();
  const Rerun rerun = rerun_from(command.rerun);
  const std::filesystem::path file = database_file(command, sweep, shard);
  if (!command.page.empty()) check_run_page(command.page);
  if (command.database_file.empty()) made_folder("results");
  const StopSignals& signals = watch_stop_signals();
  Database database = open_checked(command, sweep, shard, signals, file);
  warn(command, sweep, jobs);
  const ProgressStyle style = command.quiet                ? ProgressStyle::none
                              : command.progress == "json" ? ProgressStyle::json
                                                           : ProgressStyle::line;
  RunProgress shown(style, command.heartbeat);
  std::optional<RunPage> page;
  if (!command.page.empty()) page.emplace(command.page, file, sweep.name);
  RunOptions options;
  options.worker_command = worker_words(command.plan_timeout_s, command.memory_limit_mib, jobs);
  options.sandbox = sandbox_of(command);
  options.jobs = jobs;
  options.silence_s = silence_limit_s(command.plan_timeout_s);
  options.trial_timeout_s = command.trial_timeout_s;
  options.grace_s = command.grace_s;
  options.stop = &signals.stop;
  options.stop_now = &signals.stop_now;
  options.shard = shard;
  options.rerun = rerun;
  options.rerun_key = command.rerun;
  options.in_process = command.in_process;
  options.is_wanted = command.is_wanted;
  options.keep_planners = !command.no_keep;
  options.keep_maps = command.is_bundle;
  options.on_progress = [&](const Progress& progress) {
    shown.show(progress);
    if (page) page->show(progress);
  };
  options.on_revision = [&](const SweepRevision& revision) {
    if (page) page->set_revision(revision.revision);
    print_revision(database, sweep.name, revision);
  };
  RunSummary summary;
  try {
    summary = run_sweep(sweep, provenance(command, sweep, shard), database, options);
  } catch (const InputError&) {
    if (!database.has_given_up()) {
      if (page) page->finish(RunState::interrupted);
      throw;
    }
    summary.is_stopped = true;  // it was told to while it waited for a lock
  }
  print_summary(summary, signals.ignored);
  if (summary.revision > 0) {
    // Failures are what a search for a limit goes to.
    if (!sweep.limit.is_set() && !command.is_of_suite) {
      print_failures(database, sweep.name, summary);
    }
    warn_of_planners(database, sweep.name, summary.revision);
  }
  if (page && !signals.stop_now) {
    page->finish(summary.is_stopped ? RunState::interrupted : RunState::complete);
  }
  if (summary.is_stopped) end_stopped_run(signals);
  database.checkpoint();
  if (shard.count == 1) require_flights(sweep, summary, command.sweep_file);
  if (!command.is_of_suite) {
    std::cerr << "results are in " << file.string()
              << "; to see them: " << command_that_reports(database, sweep.name, summary.revision)
              << '\n';
  }
  if (!summary.unflown.empty()) throw CLI::RuntimeError(kExitUnflown);
  return summary.revision;
}

void add_sweep_options(CLI::App& app, RunCommand& options) {
  add_typed(app, "sweep", options.sweep_file, "FILE",
            "Sweep file (YAML), or the name of one that comes with avoidbench (`config "
            "sweeps` lists them); - is standard input")
      ->required();
  add_overrides(app, options.overrides, "maps.poisson_radius_m=3.0");
  add_typed(app, "-o,--db", options.database_file, "FILE",
            "Database file [results/<sweep name>.db]");
  add_number(app, "-j,--jobs", options.jobs, CLI::Range(0, 1024),
             "Worker processes; 0: one per allowed CPU");
}

void add_limit_options(CLI::App& command, RunCommand& options) {
  add_number(
      command, "--plan-timeout", options.plan_timeout_s, CLI::PositiveNumber,
      "Wall time after which a plan call counts as hung, s; waiting for a processor does not "
      "count");
  add_number(command, "--trial-timeout", options.trial_timeout_s, CLI::PositiveNumber,
             "Wall time after which a trial counts as hung, s");
  add_number(command, "--memory-limit", options.memory_limit_mib, CLI::PositiveNumber,
             "Limit of a worker's resident memory, MiB; beyond it, its trial ends with "
             "planner_crashed [nine tenths of the memory, shared by the workers]");
  add_number(command, "--grace", options.grace_s, CLI::NonNegativeNumber,
             "Time for trials in flight to finish after a signal to stop, s");
}

void add_flight_options(CLI::App& app, RunCommand& options) {
  add_limit_options(app, options);
  app.add_option("--progress", options.progress, "On stderr: line, or json for machines")
      ->check(CLI::IsMember({"line", "json"}));
  add_typed(app, "--heartbeat", options.heartbeat, "FILE",
            "File to write the progress to, as JSON, every five seconds");
  add_protection(app, options);
  app.add_flag("-q,--quiet", options.quiet, "No progress on stderr");
}

}  // namespace avoidbench
