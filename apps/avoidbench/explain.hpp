#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command_options.hpp"
#include "database_choice.hpp"
#include "export/trial_list.hpp"

/// The parts of `avoidbench explain`.
namespace avoidbench {

/// What it was told.
struct ExplainOptions {
  std::string database;
  TrialChoice choice;
  OutputOptions output;
  FlightOptions flights;
  std::string png;
  std::vector<std::string> what_if;     ///< names of changes
  std::optional<std::int64_t> control;  ///< successes a planner
  std::string minimal;                  ///< folder
  std::int64_t most_flights = 300;
};

void add_what_if_options(CLI::App& command, ExplainOptions& options);

/// Tells the causes of failures, and stores them: of one trial with its numbers and a picture, of
/// all as a table.
void explain_causes(const ExplainOptions& options);

/// Flies trials again with one thing changed, stores what became of them and prints tables.
void explain_what_if(const ExplainOptions& options);

/// Writes the smallest set of obstacles with which a trial still fails, as a map and a sweep file.
void explain_minimal(const ExplainOptions& options);

}  // namespace avoidbench
