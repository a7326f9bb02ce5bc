#include "sweep/listed_missions.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "base/json_path.hpp"
#include "base/spec_json.hpp"
#include "metrics/map_record.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/sweep_spec.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

/// Fills the digests of the latencies that trials replay.
void fill_latencies(std::vector<PlannedTrial>& trials) {
  RecordedLatencies recorded;
  for (PlannedTrial& trial : trials) {
    if (trial.setting->latency.mode != LatencyMode::replay) continue;
    if (const auto latencies_s = recorded.of(trial.spec())) {
      trial.latency_digest = latency_digest(*latencies_s);
    }
  }
}

/// `digests` are those of maps' and winds' files, by path.
/// The last axis runs fastest, planners within a mission: trials of one map adjoin, and all
/// planners fly its first mission before the second.
void expand_axes(const SweepSpec& sweep, std::size_t axis, const json& spec,
                 std::map<std::string, std::string>& digests, std::vector<PlannedTrial>& trials) {
  if (axis < sweep.axes.size()) {
    const json::json_pointer place = json_place(sweep.axes[axis].path);
    AB_CHECK(spec.contains(place), sweep.axes[axis].path);
    for (const json& value : sweep.axes[axis].values) {
      json changed = spec;
      changed[place] = value;
      expand_axes(sweep, axis + 1, changed, digests, trials);
    }
    return;
  }
  TrialSpec trial = spec_from_json<TrialSpec>(spec);
  // The one place where a flight's vehicle is made: all that read a trial's fields see what flies.
  trial.vehicle = settled(trial.vehicle);
  const auto fill_digest = [&](const std::string& file, std::string& digest) {
    // Each file is read once, however many trials use it.
    if (file.empty() || !digest.empty()) return;
    std::string& known = digests[file];
    if (known.empty()) known = file_digest(file);
    digest = known;
  };
  const FileOfMap map = file_of(trial.map);
  if (map.file != nullptr) fill_digest(*map.file, *map.digest);
  fill_digest(trial.wind.field.file, trial.wind.field.file_digest);
  trial.missions_digest = missions_digest(missions_of(sweep.missions, trial));
  // Shared by all missions: 100,000 whole specs took 318 MiB.
  std::vector<std::shared_ptr<const TrialSpec>> settings;  // one a planner
  for (const PlannerChoice& planner : sweep.planners) {
    trial.planner = planner;
    settings.push_back(std::make_shared<const TrialSpec>(trial));
  }
  const std::int64_t count = mission_count(sweep, trial);
  for (std::int64_t mission = 0; mission < count; ++mission) {
    for (const auto& setting : settings) {
      trials.push_back({.setting = setting, .mission_index = mission, .latency_digest = {}});
    }
  }
}

bool is_for(const ListedMission& mission, const std::vector<std::string>& names) {
  return mission.map.empty() || std::find(names.begin(), names.end(), mission.map) != names.end();
}

Mission flown_mission(const ListedMission& listed, const TrialSpec& trial) {
  return trial.mission.return_to_start ? with_return(listed.mission) : listed.mission;
}

/// Adds the missions of this trial's map that can't be flown.
void add_problems(const SweepSpec& sweep, const TrialSpec& trial,
                  std::vector<InputProblem>& problems) {
  const std::vector<std::string> names = map_names(trial);
  std::vector<const ListedMission*> listed;
  std::vector<Mission> missions;
  for (const ListedMission& one : sweep.missions) {
    if (!is_for(one, names)) continue;
    listed.push_back(&one);
    missions.push_back(flown_mission(one, trial));
  }
  // Only as many as are flown.
  missions.resize(static_cast<std::size_t>(mission_count(sweep, trial)));
  const World world = make_world(trial.map, trial.map_seed);
  const std::vector<std::string> found = mission_problems(trial, Scene(world), missions);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    InputProblem problem = listed[i]->place;
    problem.message = found[i] + " (map " + names.front() + ")";
    problems.push_back(std::move(problem));
  }
}

/// Whether the database has these missions of the map and all can be flown.
bool has_missions(const Database& database, const std::string& map_key, std::size_t count) {
  const std::optional<MapRow> map = database.read_map(map_key);
  if (!map || map->record.missions.size() < count) return false;
  const std::vector<MissionRecord>& missions = map->record.missions;
  return std::all_of(missions.begin(), missions.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const MissionRecord& mission) { return mission.is_valid; });
}

}  // namespace

TrialSpec PlannedTrial::spec() const {
  TrialSpec spec = *setting;
  spec.mission_index = mission_index;
  spec.latency_digest = latency_digest;
  return spec;
}

std::vector<PlannedTrial> expand(const SweepSpec& sweep) {
  std::vector<PlannedTrial> trials;
  // Exact without listed missions, else an estimate for the reservation.
  std::size_t count = sweep.planners.size() * static_cast<std::size_t>(sweep.trials);
  for (const Axis& axis : sweep.axes) count *= axis.values.size();
  trials.reserve(count);
  std::map<std::string, std::string> digests;
  expand_axes(sweep, 0, spec_to_json(sweep.base), digests, trials);
  fill_latencies(trials);
  return trials;
}

std::vector<std::string> map_names(const TrialSpec& trial) {
  MapSpec map = trial.map;
  const FileOfMap file = file_of(map);
  // A made map is named by its seed, one from a file by its name with or without ending.
  if (file.file == nullptr) return {std::to_string(trial.map_seed)};
  const std::filesystem::path path = *file.file;
  return {path.filename().string(), path.stem().string()};
}

std::vector<Mission> missions_of(const std::vector<ListedMission>& listed, const TrialSpec& trial) {
  std::vector<Mission> missions;
  if (listed.empty()) return missions;
  const std::vector<std::string> names = map_names(trial);
  for (const ListedMission& one : listed) {
    if (is_for(one, names)) missions.push_back(flown_mission(one, trial));
  }
  return missions;
}

std::int64_t mission_count(const SweepSpec& sweep, const TrialSpec& trial) {
  if (sweep.missions.empty()) return sweep.trials;
  return std::min(sweep.trials,
                  static_cast<std::int64_t>(missions_of(sweep.missions, trial).size()));
}

std::string missions_digest(const std::vector<Mission>& listed) {
  if (listed.empty()) return "";
  Digest digest;
  for (const Mission& mission : listed) {
    for (const Eigen::Vector3d& place : {mission.start_world, mission.goal_world}) {
      for (const double coordinate_m : place) digest.add(coordinate_m);
    }
    digest.add(mission.start_yaw_rad);
    for (const Eigen::Vector3d& place : mission.waypoints_world) {
      for (const double coordinate_m : place) digest.add(coordinate_m);
    }
  }
  return digest.hex();
}

void check_listed_missions(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials,
                           const Database* known) {
  if (sweep.missions.empty()) return;
  KeyMaker keys;
  std::set<std::string> seen_maps;
  std::vector<InputProblem> problems;
  for (const PlannedTrial& trial : trials) {
    // Each map once, and only those whose missions the database has not found good already.
    const std::string key = keys.map_key(trial);
    if (!seen_maps.insert(key).second) continue;
    const auto count = static_cast<std::size_t>(mission_count(sweep, *trial.setting));
    if (known != nullptr && has_missions(*known, key, count)) continue;
    add_problems(sweep, *trial.setting, problems);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace avoidbench
