#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "store/database.hpp"
#include "store/trial_table.hpp"
#include "trial/run_trial.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A trial of a database with all that it was flown from.
struct StoredTrial {
  TrialRow row;
  TrialSpec spec;  ///< without the planner's file, and with the mere name of a map's and a wind's
  Mission mission;
  std::string world_digest;
  double reference_length_m = 0.0;  ///< of the mission's shortest path
};

/// Where to look for files, which a database does not name.
struct ReplayFiles {
  /// Name or file of a library; "": as the sweep named it, if it is the same.
  std::string planner = {};
  std::string map = {};   ///< of a map from a file; "": its name in `folders` and in maps/
  std::string wind = {};  ///< of a wind field; "": its name in `folders` and in configs/wind/
  std::vector<std::filesystem::path> folders{"."};  ///< the sweep's, the database's, …
  std::filesystem::path database = {};  ///< beside which copies are kept (base/kept_files.hpp)
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

/// The library to fly with, not loaded: what the user names, in any case; what the database names,
/// only if it is the file that the trial was flown with. Throws InputError.
PlannerSource library_for(const PlannerChoice& choice, const ReplayFiles& files);

/// The stored values of the parameters that the library declares, and presets of others; what does
/// not fit is warned of.
std::vector<ParameterValue> usable_values(const PlannerChoice& choice,
                                          const PlannerDescription& planner,
                                          std::vector<std::string>& warnings);

/// That this library is another one than the stored trial's.
std::string other_library_warning(const PlannerDescription& planner);

/// A stored trial made ready to be flown again in this process. Stays at its address.
class Replay {
 public:
  /// Loads map and planner; where their files are gone or are others now, the copies that the run
  /// kept. Parameters that the library no longer declares are left out. Throws
  /// InputError where map or planner can't be had, and where the planner that the database names is
  /// another file than the stored trial's: code is not run on a database's word alone.
  explicit Replay(StoredTrial stored, const ReplayFiles& files = {});
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  const StoredTrial& stored() const { return stored_; }
  const World& world() const { return world_; }

  /// Why the flight may differ from the stored one: another file of the planner, other parameters,
  /// another version of the program.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The kept copy that the planner is loaded from; empty where its own file is still the one that
  /// was flown, or another one is named.
  const std::filesystem::path& kept_planner_file() const { return kept_planner_; }

  /// Flies it, with drawings wanted; measured latencies are those of the stored flight. `log` gets
  /// what the planner logged before its first and after its last call.
  TrialRecord fly(const TrialObserver& observer, std::vector<std::string>& log) const;

 private:
  StoredTrial stored_;
  World world_;
  Scene scene_;
  std::vector<std::string> warnings_;
  std::filesystem::path kept_planner_;
  PlannerLibrary library_;
  std::vector<ParameterValue> values_;
};

/// Where two records of one trial differ in what must not: outcome, end, reason, samples (bit for
/// bit), status and kind of each plan call; a line each. Empty where they are equal.
std::vector<std::string> differences(const TrialRecord& stored, const TrialRecord& flown);

}  // namespace avoidbench
