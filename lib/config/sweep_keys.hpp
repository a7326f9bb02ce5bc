#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/field_tree.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {

/// Everything that a sweep file can say, in the order of its keys: the blocks and seeds as visit()
/// of TrialSpec gives them (`map` is called `maps`, and `map_seed` maps.seeds), and the keys that
/// are the sweep's own. Blocks for which a name may stand have the key `preset`, whose choices are
/// what is built in.
FieldTree sweep_tree();

/// Everything that a file of configs/vehicles or configs/sensors can say.
FieldTree vehicle_tree();
FieldTree sensor_tree();

/// A planner's parameter as a field.
FieldTree parameter_tree(const ParameterDef& parameter);

/// The path of a sweep file as one of TrialSpec: maps.seeds is map_seed, maps.x is map.x.
std::string trial_path(const std::string& path);

/// The unit that a name ends with, as people write it: "m/s" for max_speed_mps; "" for none.
std::string unit_of(std::string_view name);

}  // namespace avoidbench
