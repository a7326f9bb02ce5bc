#include "suite/suite_maps.hpp"

#include <algorithm>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/poll.hpp"
#include "trial/map_scene.hpp"

namespace avoidbench {
namespace {

void add_mission(Digest& digest, const MissionRecord& mission) {
  digest.add(static_cast<std::uint64_t>(mission.index)).add(mission.is_valid ? 1.0 : 0.0);
  if (!mission.is_valid) return;
  for (const Eigen::Vector3d& place : {mission.mission.start_world, mission.mission.goal_world}) {
    for (const double coordinate_m : place) digest.add(coordinate_m);
  }
  digest.add(mission.mission.start_yaw_rad).add(mission.reference_length_m);
  for (const Eigen::Vector3d& place : mission.mission.waypoints_world) {
    for (const double coordinate_m : place) digest.add(coordinate_m);
  }
}

}  // namespace

FrozenMaps frozen_maps(const std::vector<MapRecord>& maps_by_seed) {
  Digest worlds, missions;
  for (const MapRecord& map : maps_by_seed) {
    worlds.add(map.world_digest);
    for (const MissionRecord& mission : map.missions) add_mission(missions, mission);
  }
  return {.maps_sha256 = worlds.hex(), .missions_sha256 = missions.hex()};
}

FrozenMaps flown_maps(const SweepResult& result, const SweepSeeds& seeds) {
  std::vector<MapRecord> maps;
  for (const std::uint64_t seed : seeds.map_seeds) {
    const auto row = std::find_if(result.maps.begin(), result.maps.end(),
                                  [&](const MapRow& map) { return map.map_seed == seed; });
    if (row == result.maps.end()) {
      throw InputError(result.name + ": no trial was flown on map " + std::to_string(seed));
    }
    maps.push_back(row->record);
  }
  return frozen_maps(maps);
}

std::vector<MapRow> measured_maps(const SweepSpec& sweep, std::int64_t mission_count) {
  std::vector<MapRow> maps;
  const TrialSpec* last = nullptr;
  // One planner: a setting a map.
  const std::vector<PlannedTrial> trials = expand(sweep);
  for (const PlannedTrial& trial : trials) {
    if (trial.setting.get() == last) continue;
    last = trial.setting.get();
    poll_caller();
    const MapScene map(*trial.setting);
    maps.push_back({.record = make_map_record(*trial.setting, map.scene, mission_count),
                    .generator = std::string(kind(trial.setting->map)),
                    .spec_json = {},
                    .map_seed = trial.setting->map_seed});
  }
  return maps;
}

FrozenMaps made_maps(const SweepSpec& sweep) {
  std::vector<MapRecord> records;
  for (MapRow& map : measured_maps(sweep, sweep.trials)) records.push_back(std::move(map.record));
  return frozen_maps(records);
}

std::string maps_problem(const SuiteSweep& sweep, Split split, const FrozenMaps& found) {
  if (split == Split::sealed) return "";
  const FrozenMaps& frozen = split == Split::dev ? sweep.dev : sweep.open;
  std::string problem;
  const auto compare = [&](const char* what, const std::string& is, const std::string& was) {
    if (is == was) return;
    problem += (problem.empty() ? "" : "; ") + std::string(what) + " have SHA-256 " + is +
               ", expected " + was;
  };
  compare("maps", found.maps_sha256, frozen.maps_sha256);
  compare("missions", found.missions_sha256, frozen.missions_sha256);
  return problem.empty() ? "" : sweep.name + ", " + std::string(text(split)) + ": " + problem;
}

}  // namespace avoidbench
