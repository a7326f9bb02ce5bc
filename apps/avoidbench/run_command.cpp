#include <cmath>
#include <iostream>

#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "run_flights.hpp"
#include "run_progress.hpp"
#include "store/database.hpp"
#include "sweep/allowance.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/run_estimate.hpp"
#include "sweep/schedule.hpp"

namespace avoidbench {
namespace {

/// What the trials that are missing will take, by those of the same planners that the file has.
void print_estimate(const std::vector<PlannedTrial>& trials, const std::filesystem::path& file,
                    int jobs) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    std::cerr << "no estimate of time and size: " << file.string() << " has no trials yet\n";
    return;
  }
  const RunEstimate estimate = estimate_run(trials, Database::open_for_reading(file));
  std::cerr << estimate.missing << " to fly: about " << duration_text(estimate.worker_time_s / jobs)
            << " with " << counted(jobs, "worker") << ", " << std::llround(estimate.bytes / 1e6)
            << " MB";
  if (estimate.unknown > 0) {
    std::cerr << "; without " << estimate.unknown << " of planners not flown yet";
  }
  std::cerr << '\n';
}

void print_trials(const std::vector<PlannedTrial>& trials) {
  KeyMaker keys;
  for (const PlannedTrial& trial : trials) {
    std::cout << keys.trial_key(trial).substr(0, 12) << "  map "
              << keys.map_key(trial).substr(0, 12) << " seed " << trial.setting->map_seed
              << "  mission " << trial.mission_index << "  " << trial.planner_label() << '\n';
  }
  std::cerr << counted(trials.size(), "trial") << '\n';
}

void run(const RunCommand& command) {
  std::vector<std::string> overrides = command.overrides;
  if (!command.until.empty()) overrides.push_back("until=" + command.until);
  const SweepSpec sweep = read_sweep(command.sweep_file, overrides);
  const Shard shard = command.shard ? shard_from(*command.shard) : Shard{};
  if (!command.dry_run) {
    fly_sweep(command, sweep, shard);
    return;
  }
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  const std::vector<PlannedTrial> trials = trials_of(shard, expand(sweep));
  print_trials(trials);
  const int jobs = command.jobs > 0 ? command.jobs : allowed_cpus();
  print_estimate(trials, database_file(command, sweep, shard), jobs);
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "run", "Fly a sweep's trials and store them in a database", run);
  add_sweep_options(command, options);
  add_typed(command, "--shard", options.shard, "I/N|auto|auto/N",
            "Fly only this part of the sweep, one of N for N machines; auto: the task of a Slurm, "
            "PBS or Kubernetes array");
  add_typed(command, "--until", options.until, "RULE",
            "When a planner has flown enough, as in 'success_rate ci<0.05': its success rate is "
            "known to ± 0.05 (95 %); checked after each tenth of the missions. Part of the sweep, "
            "like --set until=RULE");
  add_typed(command, "--rerun", options.rerun, "failed|all|KEY",
            "Fly stored trials again: failed (planner_error, planner_crashed, planner_hung), all, "
            "or one by its key");
  command.add_flag(
      "--dry-run", options.dry_run,
      "Print the trials and fly none; with an estimate of time and size, if some were flown");
  add_flight_options(command, options);
  add_typed(command, "--page", options.page, "FILE",
            "Page of the sweep, as `report --page` writes it: from the beginning on, and again "
            "every few seconds with what was flown since; open in a browser it follows the run "
            "(docs/page.md)");
  command.footer(
      "The same sweep gives the same rows for any number of workers. Trials that the database has "
      "are skipped, so the\n"
      "same command resumes where it was stopped.\n\n"
      "Examples:\n"
      "  avoidbench run quick\n"
      "  avoidbench run forest_small --set trials=20 --db forest.db --jobs 2\n"
      "  avoidbench run quick --page quick.html            # watch it in a browser\n\n"
      "Exit codes: 0 done, 1 done except trials whose worker was killed from outside, 2 usage, "
      "input or no mission that can be flown, 75 stopped by SIGTERM, SIGHUP, SIGUSR1 or SIGXCPU, "
      "130 interrupted, "
      "128 + N ended at once by a second signal N");
}

}  // namespace avoidbench
