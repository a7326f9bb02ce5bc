#pragma once

#include <string>
#include <vector>

#include "config/flights_file.hpp"
#include "store/database.hpp"

/// Real flights as trials: the same tables, the same metrics by the same code.
namespace avoidbench {

/// A flight, ready to be stored.
struct ImportedFlight {
  TrialRow row;
  double reference_length_m = 0.0;
  double residual_m = 0.0;  ///< of its positions to the smoothed path, RMS per axis
  double rate_hz = 0.0;     ///< of its poses, on the mean
  bool has_attitude = true;
  TrialSpec spec = {};
};

struct ImportedFlights {
  SweepRow sweep;
  MapRow map;
  std::vector<PlannerRow> planners;
  std::vector<ImportedFlight> flights;  ///< mission k is flight k
  std::vector<TwinMission> missions;    ///< one a flight
  double alignment_residual_m = 0.0;
  std::vector<std::string> warnings;
};

/// Reads every log, makes the map and judges every flight. The metrics that a log says nothing of
/// are NaN. Throws InputError with all problems of all flights, each at its place: nothing is
/// imported by halves.
ImportedFlights import_flights(const FlightsFile& file);

/// Stores what the database lacks of them under `run`, a transaction a flight; how many were new.
/// `beside`, if not "", is a sweep of the database to which they are added too, so that reports and
/// pages show both. Throws OptionError where there is none of this name.
std::size_t store_flights(const ImportedFlights& imported, const RunRow& run,
                          const std::string& beside, Database& database);

/// Metrics that have no value for what the logs do not say, in the order of the table.
std::vector<std::string> lacking_metrics(const ImportedFlights& imported);

}  // namespace avoidbench
