#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/math.hpp"
#include "base/spec_json.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "config/defaults.hpp"
#include "config/sweep_file.hpp"
#include "config/sweep_keys.hpp"
#include "explain.hpp"
#include "output.hpp"
#include "what_if/smallest_scene.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

constexpr const char* kSceneSweepFile = "sweep.yaml";

json coordinates(const Eigen::Vector3d& place) { return {place.x(), place.y(), place.z()}; }

json listed_mission(const Mission& mission) {
  const std::vector<Eigen::Vector3d> goals = goals_of(mission);
  json listed{{"start", coordinates(mission.start_world)}};
  if (goals.size() == 1) listed["goal"] = coordinates(goals.front());
  for (const Eigen::Vector3d& goal : goals) {
    if (goals.size() > 1) listed["goals"].push_back(coordinates(goal));
  }
  if (mission.start_yaw_rad != yaw_toward_goal_rad(mission.start_world, goals.front())) {
    listed["yaw_deg"] = mission.start_yaw_rad / math::kDegree;
  }
  return listed;
}

/// By its name where that leads to the file, else by the file.
json scene_plugin(const PluginChoice& plugin) {
  const std::filesystem::path file = plugin.file;
  const bool is_name = plugin.plugin == file.stem().string() && plugin.command.empty();
  json parameters = json::object();
  for (const ParameterChoice& parameter : plugin.parameters) {
    parameters[parameter.name] = parameter.is_text ? json(parameter.text) : json(parameter.number);
  }
  return {{"plugin", is_name ? plugin.plugin : std::filesystem::absolute(file).string()},
          {"label", plugin.label},
          {"parameters", parameters}};
}

json scene_planner(const PlannerChoice& planner) {
  json entry = scene_plugin(planner);
  if (planner.filter) entry["filter"] = scene_plugin(*planner.filter);
  if (planner.camera != kAllCameras) entry["camera"] = planner.camera;
  return entry;
}

/// The sweep of one trial.
std::string scene_sweep(const SmallestScene& scene, const std::string& key) {
  const TrialSpec& spec = scene.spec;
  json sweep = spec_to_json(spec);
  // The map, its seed and the planner are written below, as sweep files have them.
  for (const char* other : {"map", "map_seed"}) sweep.erase(other);
  for (const std::string_view filled_in : kFilledIn) sweep.erase(std::string(filled_in));
  sweep["sweep"] = "smallest_" + key.substr(0, 8);
  sweep["trials"] = scene.missions.size();
  sweep["maps"] = spec_to_json(spec)["map"];
  sweep["maps"]["file"] = kSceneMapFile;
  sweep["maps"]["seeds"] = {spec.map_seed};
  sweep["mission"]["list"] = json::array();
  for (const Mission& mission : scene.missions) {
    sweep["mission"]["list"].push_back(listed_mission(mission));
  }
  sweep["planners"] = {scene_planner(spec.planner)};
  sweep["latency"] = {{"mode", text(spec.latency.mode)}};
  if (spec.latency.mode == LatencyMode::fixed) sweep["latency"]["ms"] = spec.latency.ms;
  return "# The smallest set of obstacles with which trial " + key.substr(0, 12) +
         " still fails:\n#   avoidbench run sweep.yaml\n" + sweep_file_yaml(sweep);
}

/// Beside the map, where the sweep file then finds it.
void keep_wind_file(SmallestScene& scene, const std::filesystem::path& folder) {
  std::string& file = scene.spec.wind.field.file;
  if (file.empty()) return;
  const std::filesystem::path from = file;
  std::error_code error;
  std::filesystem::copy_file(from, folder / from.filename(),
                             std::filesystem::copy_options::overwrite_existing, error);
  if (error) refuse_file(file, "can't be copied: " + error.message());
  file = from.filename().string();
}

/// "2 trees and 1 wall".
std::string kinds_text(const std::vector<std::string>& kinds) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& kind : kinds) ++counts[kind];
  std::string words;
  for (const auto& [kind, count] : counts) {
    words += (words.empty() ? "" : ", ") + std::to_string(count) + " × " + kind;
  }
  return words;
}

}  // namespace

void explain_minimal(const ExplainOptions& options) {
  const Database database = open_checked(database_of(options.database));
  if (options.choice.trial.empty())
    throw InputError("--minimal: name the TRIAL, after the database");
  const TrialListing listing = the_trial(database.list_trials(), options.choice);
  const StoredTrial stored = possible_trial(database, listing.key);
  const std::filesystem::path folder = made_folder(options.minimal);
  const StopSignals& signals = watch_stop_signals();
  const SceneRequest request{
      .stored = stored,
      .files = files_beside(options.database, database, options.flights),
      .folder = folder,
      .most_flights = options.most_flights,
      .fleet = fleet_options(options.flights, options.flights.job_count(), &signals),
      .on_progress = [](std::int64_t flights, std::size_t obstacles) {
        std::cerr << counted(flights, "flight") << ", " << counted(obstacles, "obstacle")
                  << " left\n";
      }};
  SmallestScene scene = smallest_scene(request);
  if (scene.is_stopped) end_stopped(signals, "stopped: nothing was written");
  keep_wind_file(scene, folder);
  const std::filesystem::path sweep_file = folder / kSceneSweepFile;
  write_text(scene_sweep(scene, listing.key), sweep_file.string());
  read_sweep(sweep_file);  // what can't be flown is said now
  std::cout << "obstacles  " << scene.obstacles << " of " << scene.obstacles_before
            << (scene.kinds.empty() ? "" : ": " + kinds_text(scene.kinds)) << "\n"
            << "flight     " << text(scene.outcome) << ": " << visible_line(scene.reason) << "\n"
            << "flights    " << scene.flights << "\n";
  if (!scene.is_minimal) {
    std::cout << "not minimal: the limit of flights was reached (--most-flights)\n";
  }
  if (scene.missions.size() > 1) {
    std::cout << "mission    the last of " << scene.missions.size()
              << " equal ones: its number decides the noise\n";
  }
  std::cout << std::flush;
  std::cerr << "wrote " << (folder / kSceneMapFile).string() << " and " << sweep_file.string()
            << "; to fly it: avoidbench run " << sweep_file.string() << '\n';
}

}  // namespace avoidbench
