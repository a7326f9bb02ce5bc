#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "replay/replay.hpp"

/// Stored trials made ready to be flown again in worker processes.
namespace avoidbench {

/// The planner that the trials of one choice are flown again with, and its filter.
struct ReplayPlanner {
  PlannerDescription description;
  bool is_kept = false;  ///< the copy that the run kept, of one of them
  std::optional<PlannerDescription> filter = {};
};

/// The planners of stored trials, each found and described once.
class ReplayPlanners {
 public:
  explicit ReplayPlanners(ReplayFiles files) : files_(std::move(files)) {}

  /// Throws InputError as planner_for() and describe_planner(), again for each trial of a planner
  /// that can't be had.
  const ReplayPlanner& of(const PlannerChoice& choice);
  const ReplayFiles& files() const { return files_; }

 private:
  ReplayFiles files_;
  std::map<std::string, ReplayPlanner> planners_;
};

/// The mission as it was stored: nothing is measured again.
MissionRecord mission_of(const StoredTrial& stored);

/// The job of flying a stored trial again with this planner, and parameters that it takes; `stored`
/// is that of with_files(). Why it may differ from the stored flight is added to `warnings`.
Job stored_job(StoredTrial stored, const ReplayPlanner& planner,
               std::vector<std::string>& warnings);

/// A job of stored_job() for a fleet, under a number of the caller's.
FleetJob fleet_job(std::size_t index, Job job);

/// A stored trial that is flown again as it was.
struct StoredFlight {
  StoredTrial stored;  ///< with the places of its files
  FleetJob job;
  std::vector<std::string> warnings;  ///< why it may differ from the stored flight
  bool is_with_kept_planner = false;
};

/// Throws InputError where its planner or a file can't be had.
StoredFlight stored_flight(StoredTrial stored, ReplayPlanners& planners);

/// That its map is another one now; "" where it is not, or where there is no answer.
std::string other_map_warning(const StoredTrial& stored, const JobEnd& end);

/// What it flew: the answer, or how far it came before its worker died.
TrialRecord record_of(const JobEnd& end, const PlannerChoice& planner);

/// The line of a stack, or a reason, in which a kept copy, whose name is its digest, has the name
/// that the library had as it was flown.
std::string under_flown_name(std::string text, const PlannerChoice& planner);

/// Does this job alone. Throws InputError where its worker was killed each time, or the map can't
/// be made. Without a result where it was stopped.
JobEnd fly_one(const FleetJob& job, const FleetOptions& options);

}  // namespace avoidbench
