#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugin/planner_library.hpp"
#include "store/database.hpp"
#include "store/trial_table.hpp"
#include "trial/mission.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A trial of a database with all that it was flown from.
struct StoredTrial {
  TrialRow row;
  TrialSpec spec;  ///< without the planner's file, and with the mere name of a map's and a wind's
  Mission mission;
  std::string world_digest;
  double reference_length_m = 0.0;         ///< of the mission's shortest path
  std::vector<double> leg_lengths_m = {};  ///< see MissionRecord
};

/// Where to look for files, which a database does not name.
struct ReplayFiles {
  /// Name or file of a library; "": as the sweep named it, if it is the same.
  std::string planner = {};
  std::string map = {};   ///< of a map from a file; "": its name in `folders` and in maps/
  std::string wind = {};  ///< of a wind field; "": its name in `folders` and in configs/wind/
  std::vector<std::filesystem::path> folders{"."};  ///< the sweep's, the database's, …
  std::filesystem::path database = {};  ///< beside which copies are kept (base/kept_files.hpp)
  std::vector<PlannerChoice> own_planners = {};  ///< of a sweep file that the user gave
};

/// Reads the trial of this key. Throws InputError where there is none, or where another version of
/// the program stored it in a form that this one can't fly.
StoredTrial read_stored_trial(const Database& database, const std::string& key);

/// Reads one trial after the other; the map that several are flown on once.
class StoredTrialReader {
 public:
  /// The database must outlive the reader and serve the same thread.
  explicit StoredTrialReader(const Database& database) : database_(&database), trials_(database) {}

  /// As read_stored_trial().
  StoredTrial read(const std::string& key);

 private:
  const MapRow* map(const std::string& key);  ///< null if none

  const Database* database_;
  TrialReader trials_;
  std::map<std::string, std::optional<MapRow>> maps_;
};

/// The trial with the places of the files of its map and its wind. Throws InputError where one is
/// not found.
StoredTrial with_files(StoredTrial stored, const ReplayFiles& files);

/// The planner to fly with, not loaded, and whether it is the copy that the run kept.
struct FoundPlanner {
  PlannerSource source;
  bool is_kept = false;
};

/// What the user names, in any case; else the file that the database names, only if it is the one
/// that the trial was flown with. A command that the database names is never started: its words can
/// say anything, whatever file they begin with. It has to be in one of the user's own sweeps.
/// Throws InputError that says what else can be done.
FoundPlanner planner_for(const PlannerChoice& choice, const ReplayFiles& files);
/// The same where the user names no planner; of its filter in any case.
FoundPlanner plugin_for(const PluginChoice& choice, const ReplayFiles& files);

/// The stored values of the parameters that the library declares, and presets of others; what does
/// not fit is warned of.
std::vector<ParameterValue> usable_values(const PluginChoice& choice,
                                          const PlannerDescription& planner,
                                          std::vector<std::string>& warnings);

/// That this library is another one than the stored trial's.
std::string other_library_warning(const PlannerDescription& planner);

/// Where two records of one trial differ in what must not: outcome, end, reason, samples (bit for
/// bit), status and kind of each plan call, collisions; a line each. Empty where they are equal.
std::vector<std::string> differences(const TrialRecord& stored, const TrialRecord& flown);

}  // namespace avoidbench
