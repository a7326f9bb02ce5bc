#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/map_record.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// The mean of a measure over the map's valid missions that have it; NaN where there are none.
double mission_mean(const MapRecord& map, double (*measure)(const MissionRecord&));

/// Names of the metrics of maps and of missions.
std::vector<std::string> map_measure_names();

/// The metric of this name of the trial's map with this seed; of a metric of missions the mean over
/// missions 0 to `mission_count` - 1.
double map_measure(const TrialSpec& trial, std::uint64_t map_seed, std::string_view name,
                   std::int64_t mission_count);

}  // namespace avoidbench
