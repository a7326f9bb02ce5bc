#include "compare/trial_table.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/json_path.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

constexpr std::string_view kOfMap = "map.";

/// Enough to tell worlds and flights apart; 0 for a row without a digest.
std::uint64_t first_64_bits(const std::string& digest) {
  std::uint64_t bits = 0;
  if (digest.size() >= 16) std::from_chars(digest.data(), digest.data() + 16, bits, 16);
  return bits;
}

/// The same only in the same world, between the same places, to the last bit.
std::uint64_t mission_digest(const MapRecord& map, const Mission& mission) {
  Digest digest;
  digest.add(map.world_digest);
  for (const Eigen::Vector3d* place : {&mission.start_world, &mission.goal_world}) {
    digest.add(place->x()).add(place->y()).add(place->z());
  }
  digest.add(mission.start_yaw_rad);
  for (const Eigen::Vector3d& place : mission.waypoints_world) {
    digest.add(place.x()).add(place.y()).add(place.z());
  }
  return first_64_bits(digest.hex());
}

/// What a map's spec says at a path of a trial's spec: "map.poisson_radius_m".
std::string map_value(const json& spec, std::string_view path) {
  const json::json_pointer place = json_place(path.substr(kOfMap.size()));
  return spec.contains(place) ? spec[place].dump() : "";
}

void append_setting(std::string& setting, const std::string& path, const std::string& value) {
  const std::string name = path.starts_with(kOfMap) ? path.substr(kOfMap.size()) : path;
  setting += (setting.empty() ? "" : " ") + name + "=" + value;
}

/// What comparisons need of a map.
struct MapOfTable {
  std::string generator, setting;
  std::uint64_t map_seed = 0, digest = 0;
  std::map<std::int64_t, std::uint64_t> missions;
};

/// What trials need to know of their map: its part of their setting, and its missions' digests.
MapOfTable map_of(const Database& database, const std::string& key,
                  const std::vector<std::string>& axes) {
  const std::optional<MapRow> row = database.read_map(key);
  AB_CHECK(row.has_value(), key);
  MapOfTable map;
  map.generator = row->generator;
  map.map_seed = row->map_seed;
  map.digest = first_64_bits(row->record.world_digest);
  // Without throwing: a spec that can't be read has no values.
  const json spec = json::parse(row->spec_json, nullptr, false);
  for (const std::string& path : axes) {
    if (path.starts_with(kOfMap)) append_setting(map.setting, path, map_value(spec, path));
  }
  for (const MissionRecord& mission : row->record.missions) {
    map.missions[mission.index] = mission_digest(row->record, mission.mission);
  }
  return map;
}

/// The table is in order: twins adjoin.
void check_identities(const TrialTable& table) {
  const auto twin = std::adjacent_find(
      table.trials.begin(), table.trials.end(),
      [](const TableTrial& a, const TableTrial& b) { return a.identity == b.identity; });
  if (twin == table.trials.end()) return;
  refuse_file(table.source, "sweep " + table.sweep + " has two trials of " +
                                twin->identity.planner + " on " + place_text(twin->identity) +
                                ": planners of different files share the label");
}

}  // namespace

std::string place_text(const TrialIdentity& identity) {
  std::string text = identity.generator + " " + std::to_string(identity.map_seed);
  if (!identity.setting.empty()) text += ", " + identity.setting;
  return text + ", mission " + std::to_string(identity.mission_index);
}

TrialTable table_of_sweep(const Database& database, const SweepInfo& sweep,
                          std::vector<std::string> axes) {
  std::erase(axes, "map_seed");  // an element of its own
  std::sort(axes.begin(), axes.end());
  axes.erase(std::unique(axes.begin(), axes.end()), axes.end());

  TrialTable table{.source = database.path().string(),
                   .sweep = sweep.name,
                   .axes = axes,
                   .metrics = database.metrics()};
  if (sweep.revision > 1) table.sweep += "@" + std::to_string(sweep.revision);
  std::map<std::string, std::string> labels;
  for (const PlannerRow& planner : database.read_planners()) {
    labels[planner_key(planner)] = planner.label;
  }
  std::map<std::string, MapOfTable> maps;
  // A map's settings are in its own row, once for all its trials.
  std::vector<std::string> paths = axes;  // of a trial's own settings
  std::erase_if(paths, [](const std::string& path) { return path.starts_with(kOfMap); });
  table.trials.reserve(static_cast<std::size_t>(sweep.trial_count));
  visit_trials(database, sweep.name, sweep.revision, paths, [&](VisitedTrial trial) {
    // Each map is read once, when its first trial comes.
    auto found = maps.find(trial.map_key);
    if (found == maps.end()) {
      found = maps.emplace(trial.map_key, map_of(database, trial.map_key, axes)).first;
    }
    const MapOfTable& map = found->second;
    TableTrial& row = table.trials.emplace_back();
    row.identity = {.planner = labels.at(trial.planner_key),
                    .generator = map.generator,
                    .map_seed = map.map_seed,
                    .setting = map.setting,
                    .mission_index = trial.mission_index};
    for (std::size_t i = 0; i < paths.size(); ++i) {
      append_setting(row.identity.setting, paths[i], trial.settings[i]);
    }
    row.map = map.digest;
    row.mission = map.missions.at(trial.mission_index);
    row.outcome = trial.outcome;
    row.flight = first_64_bits(trial.flight_digest);
    row.cause = std::move(trial.cause);
    row.key = std::move(trial.key);
    row.metrics = std::move(trial.metrics);
  });
  // The order that pairing relies on; the database's is that of flying.
  std::sort(table.trials.begin(), table.trials.end(),
            [](const TableTrial& a, const TableTrial& b) { return a.identity < b.identity; });
  check_identities(table);
  return table;
}

}  // namespace avoidbench
