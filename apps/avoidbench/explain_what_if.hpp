#pragma once

#include "explain_options.hpp"
#include "stop_signals.hpp"
#include "what_if/fleet.hpp"

/// The parts of `avoidbench explain` that fly trials again.
namespace avoidbench {

void add_what_if_options(CLI::App& command, ExplainOptions& options);

/// Flies trials again with one thing changed, stores what became of them and prints tables.
void explain_what_if(const ExplainOptions& options);

/// Writes the smallest set of obstacles with which a trial still fails, as a map and a sweep file.
void explain_minimal(const ExplainOptions& options);

/// Workers for trials of the database; in the sandbox, unless one of these trials was flown
/// without.
FleetOptions explain_fleet(const ExplainOptions& options, const Database& database,
                           const std::vector<std::string>& keys, const StopSignals& signals);

/// Ends the program as a run that was told to stop does.
[[noreturn]] void end_stopped_flights(const StopSignals& signals);

}  // namespace avoidbench
