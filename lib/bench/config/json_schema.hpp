#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// JSON Schemas (draft 2020-12) of the files, for editors: made from the specs' visit(), so that
/// they say what the reader reads. What a schema can't express (contradictions between fields,
/// files and planners that are not there) only `config check` tells.
///
/// A sweep file. `planners` are those whose names and parameters it knows; others are let through.
/// `is_part`: a file that sweeps include, which need not be whole.
nlohmann::ordered_json sweep_schema(const std::vector<PlannerDescription>& planners,
                                    bool is_part = false);

/// A file of real flights: `avoidbench import`. `planners` as those of sweep_schema().
nlohmann::ordered_json flights_schema(const std::vector<PlannerDescription>& planners);

/// A file of configs/vehicles or configs/sensors.
nlohmann::ordered_json vehicle_schema();
nlohmann::ordered_json sensor_schema();

}  // namespace avoidbench
