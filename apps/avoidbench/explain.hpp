#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command_options.hpp"
#include "database_choice.hpp"
#include "export/trial_list.hpp"
#include "stop_signals.hpp"
#include "sweep/allowance.hpp"
#include "what_if/fleet.hpp"

/// The parts of `avoidbench explain`.
namespace avoidbench {

/// What it was told.
struct ExplainOptions {
  std::string database;
  TrialChoice choice;
  OutputOptions output;
  ReplayFiles files;
  std::string png;
  int jobs = 0;
  double plan_timeout_s = 10.0;
  std::vector<std::string> what_if;     ///< names of changes
  std::optional<std::int64_t> control;  ///< successes a planner
  std::string minimal;                  ///< folder
  std::int64_t most_flights = 300;

  int job_count() const { return jobs > 0 ? jobs : allowed_cpus(); }
};

void add_what_if_options(CLI::App& command, ExplainOptions& options);

/// Tells the causes of failures, and stores them: of one trial with its numbers and a picture, of
/// all as a table.
void explain_causes(const ExplainOptions& options);

/// Flies trials again with one thing changed, stores what became of them and prints tables.
void explain_what_if(const ExplainOptions& options);

/// Writes the smallest set of obstacles with which a trial still fails, as a map and a sweep file.
void explain_minimal(const ExplainOptions& options);

/// Workers for trials of the database.
FleetOptions explain_fleet(const ExplainOptions& options, const Database& database,
                           const std::vector<std::string>& keys, const StopSignals& signals);

}  // namespace avoidbench
