#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "sweep/sweep_spec.hpp"

/// Missions that a sweep lists instead of having them made.
namespace avoidbench {

/// What the column `map` of a mission may call the map of this trial: its file's name with and
/// without ending, or its seed where it comes from no file.
std::vector<std::string> map_names(const TrialSpec& trial);

/// Those of the listed missions that are of this trial's map, in their order; empty where missions
/// are made.
std::vector<Mission> missions_of(const std::vector<ListedMission>& listed, const TrialSpec& trial);

/// How many missions the map of this trial has.
std::int64_t mission_count(const SweepSpec& sweep, const TrialSpec& trial);

/// TrialSpec::missions_digest of these; "" for none.
std::string missions_digest(const std::vector<Mission>& listed);

/// Throws InputError with all listed missions of these trials that can't be flown, each at its
/// place, by the rules that missions are made by. Makes each map once, those aside that `known`, if
/// given, has measured.
void check_listed_missions(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials,
                           const Database* known = nullptr);

}  // namespace avoidbench
