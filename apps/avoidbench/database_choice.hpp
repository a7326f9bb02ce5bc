#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands.hpp"
#include "fleet/fleet.hpp"
#include "replay/replay.hpp"
#include "stop_signals.hpp"
#include "store/database.hpp"
#include "sweep/allowance.hpp"

namespace avoidbench {

/// The database itself, or that of a sweep by its file or name: results/NAME.db.
std::filesystem::path database_of(const std::string& given);

/// The results/*.db that was written to last; says on stderr that `purpose` takes it. Throws
/// InputError where there is none.
std::filesystem::path newest_database(const std::string& purpose);

/// Opens a database for reading after checking the digests of all its trials' rows.
Database open_checked(const std::filesystem::path& path);

/// The databases, opened so, or the newest one where none is given.
std::vector<Database> opened(const std::vector<std::string>& files, const std::string& purpose);

/// How stored trials are flown again, and with which files.
struct FlightOptions {
  ReplayFiles files;
  std::string sweep;  ///< file of the user's own, whose planners may be started
  int jobs = 0;       ///< 0: one per allowed CPU
  double plan_timeout_s = 10.0;
  bool no_sandbox = false;

  int job_count() const { return jobs > 0 ? jobs : allowed_cpus(); }
};

/// --library, --sweep-file, --map-file, --wind-file, --plan-timeout, --no-sandbox: what to fly
/// stored trials with, where it is to be others than those that are found.
void add_replay_options(CLI::App& command, FlightOptions& options);

/// The files, with the places where others are looked for: here, and beside the database, as it was
/// given and where it is; and with the planners of the sweep file that was given.
ReplayFiles files_beside(const std::string& given, const Database& database,
                         const FlightOptions& options);

/// How so many workers fly stored trials again: in the sandbox unless the user says otherwise,
/// whatever the database says of the run that flew them. `signals` stop them; null: none does.
FleetOptions fleet_options(const FlightOptions& options, int jobs, const StopSignals* signals);

/// The stored trial, ready to be flown. Throws InputError as read_stored_trial() does, and where
/// its spec contradicts itself as no sweep file may.
StoredTrial possible_trial(const Database& database, const std::string& key);

}  // namespace avoidbench
