#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/clearance_grid.hpp"
#include "metrics/difficulty.hpp"
#include "trial/mission.hpp"

namespace avoidbench {

/// Cells of the grid that a map is measured on.
inline constexpr double kMapCell_m = 0.2;

/// A mission with its reference path.
struct MissionRecord {
  std::int64_t index = 0;
  Mission mission;
  double reference_length_m = 0.0;         ///< d_min; NaN where invalid
  std::vector<double> leg_lengths_m = {};  ///< that it is the sum of; empty where there is one goal
  MissionDifficulty difficulty;
  bool is_valid = true;  ///< false: no free start or goal, or a goal can't be reached; never flown
  std::string invalid_reason;
};

/// A map as this body flies it: its environment metrics and missions.
struct MapRecord {
  std::string
      key;  ///< digest of spec, map seed, sweep seed, mission rules, body and result version
  std::string world_digest;
  std::int64_t obstacle_count = 0, triangle_count = 0;
  double traversability = 0.0;
  double traversability_normalized_ratio = 0.0;
  double relative_gap_size = 0.0;  ///< NaN where obstacles are not a Poisson-disc field
  double obstacle_density_1pm2 = 0.0;
  double free_volume_ratio = 0.0;
  std::vector<MissionRecord> missions;
};

/// Measures the scene's map for the body and mission rules of `spec`, and lays out missions 0 …
/// mission_count − 1 with their reference paths: those of `listed`, or generated ones where that is
/// empty. The key stays empty: sweep/ makes it.
MapRecord make_map_record(const TrialSpec& spec, const Scene& scene, std::int64_t mission_count,
                          const std::vector<Mission>& listed = {});

/// Mission `index` of a map, measured as in its record; `legs_world`, if given, becomes its
/// reference path to each goal, empty where it has none. `grid` is of the scene, with the world's
/// bounds and cells of kMapCell_m; what it has found out before changes nothing.
MissionRecord make_mission_record(const TrialSpec& spec, const Scene& scene, ClearanceGrid& grid,
                                  std::int64_t index, const std::vector<Mission>& listed = {},
                                  std::vector<std::vector<Eigen::Vector3d>>* legs_world = nullptr);

/// Why listed missions can't be flown, a text each, "" where one can: by the rules that generated
/// ones are made by.
std::vector<std::string> mission_problems(const TrialSpec& spec, const Scene& scene,
                                          const std::vector<Mission>& listed);

}  // namespace avoidbench
