#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "store/database.hpp"
#include "trial/run_trial.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A trial of a database with all that it was flown from.
struct StoredTrial {
  TrialRow row;
  TrialSpec spec;
  Mission mission;
};

/// Reads the trial of this key. Throws InputError where there is none, or where another version of
/// the program stored it in a form that this one can't fly.
StoredTrial read_stored_trial(const Database& database, const std::string& key);

/// A stored trial made ready to be flown again in this process. Stays at its address.
class Replay {
 public:
  /// Loads the planner from where it was, or from where its name is found now; or, where given,
  /// from `planner_file`. Parameters that the library no longer declares are left out. Throws
  /// InputError where map or planner can't be had.
  explicit Replay(const StoredTrial& stored, const std::string& planner_file = "");
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  const World& world() const { return world_; }
  const Scene& scene() const { return scene_; }
  std::uint32_t planner_needs() const { return library_.description().needs; }

  /// Why the flight may differ from the stored one: another file of the planner, other parameters,
  /// another version of the program.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Flies it, with drawings wanted. `log` gets what the planner logged before its first and after
  /// its last call.
  TrialRecord fly(const TrialObserver& observer, std::vector<std::string>& log) const;

 private:
  void load_parameters();

  const StoredTrial& stored_;
  World world_;
  Scene scene_;
  std::vector<std::string> warnings_;
  PlannerLibrary library_;
  std::vector<ParameterValue> values_;
};

/// Where two records of one trial differ in what must not: outcome, end, reason, samples (bit for
/// bit), status and kind of each plan call; a line each. Empty where they are equal.
std::vector<std::string> differences(const TrialRecord& stored, const TrialRecord& flown);

}  // namespace avoidbench
