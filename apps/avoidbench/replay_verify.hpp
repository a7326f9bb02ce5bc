#pragma once

#include <vector>

#include "export/trial_list.hpp"
#include "fleet/fleet.hpp"
#include "replay/stored_flight.hpp"
#include "stop_signals.hpp"
#include "store/database.hpp"

namespace avoidbench {

/// Exit code of `replay` where a flight differs from the stored one.
inline constexpr int kExitDiffers = 1;

/// Whether a worker's death was the end, which is not compared in bulk.
bool is_of_worker(Outcome outcome);

/// What is verified: a share of these trials, by their keys.
struct VerifyChoice {
  const Database& database;
  std::vector<TrialListing> trials;
  double share = 1.0;
};

/// Flies stored trials again and prints where they differ from what is stored. Throws
/// CLI::RuntimeError where one does, or could not be flown.
void verify_trials(const VerifyChoice& choice, ReplayPlanners& planners,
                   const FleetOptions& options, const StopSignals& signals);

}  // namespace avoidbench
