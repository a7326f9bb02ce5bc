#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "suite/suite_spec.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// A planner as it enters a suite: one setting for all cells.
struct SuitePlanner {
  YamlNode entry;  ///< as of a sweep's `planners`: {plugin, label, parameters, camera, …}
  std::string licence, source;  ///< SPDX name; where to get the planner
  std::string tuned_on;         ///< what it was tuned or trained on
};

/// Of a file with the keys `planner`, an entry of a sweep's `planners`, and `licence`, `source` and
/// `tuned_on`, all of which may be left out except the first. Paths are relative to the file. A
/// planner.yaml of a result is one: what it says beside these is passed over. Throws InputError.
SuitePlanner read_suite_planner(const std::filesystem::path& file);

/// Of a planner's name or file, with parameters as NAME=VALUE. `label` "": the name. Throws
/// InputError where a parameter is no such text.
SuitePlanner suite_planner(const std::string& plugin, const std::string& label,
                           const std::vector<std::string>& parameters);

/// A sweep of the suite with this planner, ready to be flown; its name is the frozen one. Throws
/// InputError where the file is not the frozen one, or the planner can't fly it.
SweepSpec suite_sweep(const SuiteTrack& chosen, const SuiteSweep& sweep, const SweepSeeds& seeds,
                      const SuitePlanner& planner);

/// YAML on one line that reads back to the same node: {plugin: ego, parameters: {max_speed_mps:
/// 3}}.
std::string flow_text(const YamlNode& node);

}  // namespace avoidbench
