#pragma once

#include <string>
#include <vector>

#include "explain/causes.hpp"
#include "replay/stored_flight.hpp"
#include "worker/worker.hpp"

namespace avoidbench {

/// Why a stored trial failed, and why that may be less than could be known.
struct ExplainedTrial {
  CauseFound explanation;
  std::vector<std::string> warnings;
};

/// The lookout that tells a flight's cause, and its name for run_worker().
inline constexpr const char* kCauseLookout = "cause";
Lookout cause_lookout(const Job& job, const World& world);

/// A failed trial whose cause a worker tells.
struct CauseJob {
  FleetJob job;
  StoredTrial stored;
  std::vector<std::string> notes;  ///< why it may fly otherwise
  bool is_incomplete = false;      ///< it should be flown again, and can't be
};

/// From the flight flown again, where that is needed. Throws InputError where its planner or a file
/// can't be had. The trial did not reach the goal.
CauseJob cause_job(StoredTrial stored, ReplayPlanners& planners);

/// From what is stored of it and the map; flies nothing. Throws InputError as cause_job().
CauseJob cause_job_without_flight(StoredTrial stored, const ReplayFiles& files);

/// What came of it. Throws InputError where the map can't be had.
ExplainedTrial explanation_of(const CauseJob& job, const JobEnd& end);

}  // namespace avoidbench
