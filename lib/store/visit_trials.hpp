#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

/// The paths of the axes of a sweep's stored spec, in its order: "map.poisson_radius_m".
std::vector<std::string> axis_paths(std::string_view sweep_spec_json);

/// A trial of a sweep, without its flight and spec.
struct VisitedTrial {
  std::string planner_key, map_key;
  std::int64_t mission_index = 0;
  Outcome outcome = Outcome::timed_out;
  std::string cause;            ///< of a failure, where it is told
  std::vector<double> metrics;  ///< in the order of Database::metrics(), NaN where there is none
  std::vector<std::string>
      settings;  ///< what its spec says at the paths, as JSON text; "" for none
};

/// Calls `visit` for each trial of a sweep, in any order. `paths` are dotted
/// ("sensor.fov_x_deg"). Each row is read once: for large databases.
void visit_trials(const Database& database, std::string_view sweep, std::int64_t revision,
                  std::span<const std::string> paths,
                  const std::function<void(VisitedTrial)>& visit);

}  // namespace avoidbench
