#pragma once

#include <functional>
#include <string>
#include <vector>

#include "store/rows.hpp"
#include "suite/suite_spec.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// The digests of maps, in the order of their seeds: of their worlds, and of their missions with
/// the lengths of their reference paths. A mission that can't be flown counts as such.
FrozenMaps frozen_maps(const std::vector<MapRecord>& maps_by_seed);

/// Those of the maps of a sweep that was flown. Throws InputError where one of the seeds is not
/// there.
FrozenMaps flown_maps(const SweepResult& result, const SweepSeeds& seeds);

/// The maps of a sweep of one planner, made for it and measured with so many missions each, in the
/// order of their seeds; without spec.
std::vector<MapRow> measured_maps(const SweepSpec& sweep, std::int64_t mission_count);

/// The digests of these, with the sweep's missions.
FrozenMaps made_maps(const SweepSpec& sweep);

/// Why maps are not those that the suite froze, "" where they are, or where the suite froze none
/// (sealed).
std::string maps_problem(const SuiteSweep& sweep, Split split, const FrozenMaps& found);

}  // namespace avoidbench
