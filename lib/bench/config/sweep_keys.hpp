#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/field_tree.hpp"
#include "plugin/planner_library.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// Listed missions begin and end within this distance of the map's origin along each axis.
inline constexpr double kFarthestPlace_m = 1e5;

/// Fields of a TrialSpec that the program fills in: no sweep file says them.
inline constexpr std::string_view kFilledIn[] = {"mission_index", "planner", "latency_digest",
                                                 "missions_digest", "recording"};

/// Everything that a sweep file can say: the fields of SweepSpec as visit() gives them (`map` is
/// called `maps`, and `map_seed` maps.seeds), and the keys that are no plain fields. Blocks for
/// which a name may stand have the key `preset`.
const FieldTree& sweep_tree();

/// Everything that a file of configs/vehicles or configs/sensors can say.
const FieldTree& vehicle_tree();
const FieldTree& sensor_tree();

/// The sweep whose keys have the values in `keys`, as preset_json(sweep_tree()) has the defaults.
SweepSpec sweep_from(nlohmann::json keys);

/// A planner's parameter as a field.
FieldTree parameter_tree(const ParameterDef& parameter);

/// The path of a sweep file as one of TrialSpec: maps.seeds is map_seed, maps.x is map.x.
std::string trial_path(const std::string& path);

/// The path of TrialSpec, or one of several spellings, as a sweep file has it.
std::string sweep_path(const std::string& path);

/// The unit that a name ends with, as people write it: "m/s" for max_speed_mps; "" for none.
std::string unit_of(std::string_view name);

}  // namespace avoidbench
