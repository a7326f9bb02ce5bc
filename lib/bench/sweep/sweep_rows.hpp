#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "store/rows.hpp"
#include "sweep/sweep_spec.hpp"

/// A sweep's specs as the database keeps them: canonical, without this machine's paths.
namespace avoidbench {

/// Of a map's or a wind's file only the name is kept; its file_digest says which it is.
void forget_folder(nlohmann::json& block);

/// The same for all blocks of a TrialSpec.
void forget_folders(nlohmann::json& trial);

/// All that determines a trial: TrialRow::spec_json.
std::string trial_json(const TrialSpec& spec);

/// The resolved sweep; `trials` are all of it, of which replayed latencies are noted as a digest.
std::string sweep_json(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials);

/// Throws InputError where the planner's library can't be loaded.
PlannerRow planner_row(const PlannerChoice& choice);

}  // namespace avoidbench
