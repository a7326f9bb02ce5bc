#include "explain.hpp"

#include <iostream>

#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "version.hpp"
#include "what_if/what_if_tables.hpp"

namespace avoidbench {
namespace {

constexpr int kExplainCheckFailed = 1;

/// Flights so far: at each tenth of the way.
void tell_flights(std::size_t done, std::size_t total) {
  if (10 * done / total == 10 * (done - 1) / total) return;
  std::cerr << done << " of " << counted(total, "flight") << '\n';
}

WhatIfRequest request_of(const ExplainOptions& options, const Database& database) {
  WhatIfRequest request{.changes = changes_of(options.what_if)};
  request.control = options.control;
  const std::vector<TrialListing> all = database.list_trials();
  if (all.empty()) refuse_file(database.path(), "holds no finished trial");
  if (!options.choice.trial.empty()) request.trial = the_trial(all, options.choice).key;
  if (!options.choice.planner.empty()) {
    chosen_trials(all, {.planner = options.choice.planner});  // says which planners there are
    request.planner = options.choice.planner;
  }
  return request;
}

WhatIfSource source_of(const ExplainOptions& options, const Database& database) {
  return {.read = possible_trial,
          .files = files_beside(options.database, database, options.flights),
          .program_version = std::string(kVersion) + " " + kGitHash};
}

/// Flies what is missing. The database is opened for writing only if there is something.
WhatIfRun fly_missing(const ExplainOptions& options, WhatIfPlan& plan, const WhatIfSource& source,
                      Database reader) {
  const std::filesystem::path file = reader.path();
  const StopSignals& signals = watch_stop_signals();
  const FleetOptions fleet = fleet_options(options.flights, options.flights.job_count(), &signals);
  reader.close();
  Database database = Database::open_for_run(file, metric_table());
  std::cerr << counted(plan.missing_count(), "flight") << " to fly, " << fleet.jobs << " at once\n";
  WhatIfRun run = fly_what_ifs(plan, database, source, fleet, tell_flights);
  database.require_in_place();
  for (const std::string& line : run.unflown) {
    std::cerr << "not flown: " << visible_line(line) << '\n';
  }
  if (run.is_stopped) {
    end_stopped(signals,
                "stopped: finished flights are stored, the same command resumes from there");
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
      add_list(command, "--what-if", options.what_if,
               "Fly failed trials again with each of these changes alone (list below), and count "
               "how many then reach the goal; names separated by commas, or all");
  add_number(command, "--control", options.control, CLI::NonNegativeNumber,
             "As a control, also fly this number of each planner's successes with the changes, to "
             "see which break (default: as many as failed)")
      ->needs(what_if);
  CLI::Option* minimal =
      add_typed(command, "--minimal", options.minimal, "FOLDER",
                "Find the smallest set of obstacles with which the trial still fails, and "
                "write it into this folder: a map and a sweep file that flies it")
          ->excludes(what_if);
  add_number(command, "--most-flights", options.most_flights, CLI::Range(1, 1'000'000),
             "Maximum number of flights for --minimal")
      ->needs(minimal);
  add_number(command, "-j,--jobs", options.flights.jobs, CLI::Range(0, 1024),
             "Worker processes; 0: one per allowed CPU");
  command.footer(change_list() + command.get_footer());
}

}  // namespace avoidbench
