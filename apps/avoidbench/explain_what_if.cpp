#include "explain_what_if.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>

#include "database_choice.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "process/sandbox.hpp"
#include "sweep/allowance.hpp"
#include "text/number_text.hpp"
#include "text/visible_text.hpp"
#include "version.hpp"
#include "what_if/what_if_tables.hpp"

namespace avoidbench {
namespace {

constexpr int kExplainCheckFailed = 1;

/// Flights so far: at each tenth of the way.
void tell_flights(std::size_t done, std::size_t total) {
  if (10 * done / total == 10 * (done - 1) / total) return;
  std::cerr << done << " of " << total << " flights\n";
}

WhatIfRequest request_of(const ExplainOptions& options, const Database& database) {
  WhatIfRequest request{.changes = changes_of(options.what_if)};
  request.control = options.control;
  const std::vector<TrialListing> all = database.list_trials();
  if (all.empty()) {
    throw InputError({.file = database.path().string(), .message = "holds no finished trial"});
  }
  if (!options.choice.trial.empty()) request.trial = the_trial(all, options.choice).key;
  if (!options.choice.planner.empty()) {
    chosen_trials(all, {.planner = options.choice.planner});  // says which planners there are
    request.planner = options.choice.planner;
  }
  return request;
}

WhatIfSource source_of(const ExplainOptions& options, const Database& database) {
  return {.read = [](const Database& from,
                     const std::string& key) { return possible_trial(from, key); },
          .files = explain_files(options, database),
          .program_version = std::string(kVersion) + " " + kGitHash};
}

/// Flies what is missing. The database is opened for writing only if there is something.
WhatIfRun fly_missing(const ExplainOptions& options, WhatIfPlan& plan, const WhatIfSource& source,
                      Database reader) {
  const std::filesystem::path file = reader.path();
  const StopSignals& signals = watch_stop_signals();
  std::vector<std::string> keys;
  for (const WhatIfTrial& trial : plan.trials) keys.push_back(trial.key);
  const FleetOptions fleet = explain_fleet(options, reader, keys, signals);
  reader.close();
  Database database = Database::open_for_run(file, metric_table());
  std::cerr << counted(plan.missing_count(), "flight") << " to fly, " << fleet.jobs << " at once\n";
  WhatIfRun run = fly_what_ifs(plan, database, source, fleet, tell_flights);
  database.require_in_place();
  for (const std::string& line : run.unflown) {
    std::cerr << "not flown: " << visible_line(line) << '\n';
  }
  if (run.is_stopped) {
    std::cerr << "stopped: what was flown is stored, the same command goes on from there\n";
    end_stopped_flights(signals);
  }
  return run;
}

std::string change_list() {
  std::string list = "Changes of --what-if:\n";
  for (const Change& change : changes()) {
    std::string name(change.name);
    name.resize(18, ' ');
    list += "  " + name + std::string(change.doc) + "\n";
  }
  return list;
}

}  // namespace

FleetOptions explain_fleet(const ExplainOptions& options, const Database& database,
                           const std::vector<std::string>& keys, const StopSignals& signals) {
  const int jobs = options.jobs > 0 ? options.jobs : allowed_cpus();
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  // As they were flown: a planner that was let out may do something else within it.
  const bool had_sandbox = std::none_of(keys.begin(), keys.end(), [&](const std::string& key) {
    return database.sandbox_of(key).starts_with("none");
  });
  return {.apart = {.worker_command = {program, "worker", "--plan-timeout",
                                       shortest(options.plan_timeout_s), "--memory-limit",
                                       shortest(0.9 * allowed_memory_mib() / jobs)},
                    .sandbox = had_sandbox ? text(sandbox_support()) : "",
                    .silence_s = options.plan_timeout_s + 20.0},
          .jobs = jobs,
          .stop = &signals.stop,
          .stop_now = &signals.stop_now};
}

void end_stopped_flights(const StopSignals& signals) {
  constexpr int kExitStopped = 75, kExitInterrupted = 130;
  throw CLI::RuntimeError(signals.number == SIGINT ? kExitInterrupted : kExitStopped);
}

void explain_what_if(const ExplainOptions& options) {
  changes_of(options.what_if);  // wrong names first
  check_output(options.output.output, text(options.output.format));
  Database reader = open_checked(database_of(options.database));
  const std::string name = reader.path().stem().string();
  const WhatIfRequest request = request_of(options, reader);
  const WhatIfSource source = source_of(options, reader);
  WhatIfPlan plan = plan_what_ifs(reader, request, source);
  if (plan.trials.empty()) {
    std::cerr << "every trial reached its goal: there is no failure to explain (--control N flies "
                 "successes)\n";
    return;
  }
  WhatIfRun run;
  if (plan.missing_count() > 0) run = fly_missing(options, plan, source, std::move(reader));
  const Section section = what_if_section(plan, request, name);
  write_sections(std::span(&section, 1), options.output);
  const bool is_well = run.unflown.empty() && what_if_differences(plan).empty();
  if (!is_well) throw CLI::RuntimeError(kExplainCheckFailed);
}

void add_what_if_options(CLI::App& command, ExplainOptions& options) {
  CLI::Option* what_if =
      command
          .add_option(
              "--what-if", options.what_if,
              "Fly failed trials again, each of these changes alone (list below), and count "
              "how many reach the goal then; names separated by commas, or all")
          ->type_name("LIST")
          ->delimiter(',');
  command
      .add_option("--control", options.control,
                  "Successes of each planner that are flown with the changes, too, to see which "
                  "break (default: as many as failed)")
      ->check(CLI::NonNegativeNumber)
      ->needs(what_if);
  CLI::Option* minimal =
      command
          .add_option("--minimal", options.minimal,
                      "Find the smallest set of obstacles with which the trial still fails, and "
                      "write it into this folder: a map and a sweep file that flies it")
          ->type_name("FOLDER")
          ->excludes(what_if);
  command
      .add_option("--most-flights", options.most_flights, "Most flights that --minimal may take")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str()
      ->needs(minimal);
  command.add_option("-j,--jobs", options.jobs, "Worker processes; 0: one per allowed CPU")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      .add_option("--plan-timeout", options.plan_timeout_s,
                  "Wall time after which a call of the planner counts as hung, s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.footer(change_list() + command.get_footer());
}

}  // namespace avoidbench
