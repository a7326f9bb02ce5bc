#include "page/page.hpp"

#include <algorithm>
#include <utility>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "maps/map_spec.hpp"
#include "page/flight_choice.hpp"
#include "page/flight_filling.hpp"
#include "page/page_text.hpp"
#include "report/sweep_tables.hpp"
#include "sensing/sensor_spec.hpp"
#include "table/table_text.hpp"
#include "trial/flown_world.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

ordered_json camera_json(const RigCamera& camera) {
  return {{"pose", pose_json(T_body_camera(camera.mounting))},
          {"fov_x_deg", camera.kind.fov_x_deg},
          {"width", camera.kind.width_px},
          {"height", camera.kind.height_px},
          {"min_m", camera.kind.min_range_m},
          {"max_m", camera.kind.max_range_m}};
}

/// A trial of a page: the place of its sweep, and its own in there.
struct PageTrial {
  std::size_t sweep = 0, trial = 0;
};

/// All trials in the order in which their flights are put into a page: sweep after sweep.
std::vector<PageTrial> flights_in_order(const std::vector<PageSweep>& sweeps) {
  std::vector<PageTrial> order;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const SweepResult& result = sweeps[i].result;
    const std::vector<std::size_t> planners = page_planners(sweeps[i]).of_trials;
    const std::vector<std::size_t> maps = maps_of(result);
    std::vector<FlightCandidate> candidates;
    for (std::size_t k = 0; k < result.trials.size(); ++k) {
      const TrialSummary& trial = result.trials[k];
      candidates.push_back({.planner = planners[k],
                            .map = maps[k],
                            .mission = trial.mission_index,
                            .is_finished = trial.outcome == Outcome::reached_goal});
    }
    for (const std::size_t k : flight_order(candidates)) order.push_back({.sweep = i, .trial = k});
  }
  return order;
}

/// What a page's sweeps leave out, whatever their size.
void warn_of_pairs(const std::vector<PageSweep>& sweeps, std::vector<std::string>& warnings) {
  for (const PageSweep& sweep : sweeps) {
    for (const Table& table : sweep.section.tables) {
      if (!is_left_out(table)) continue;
      warnings.push_back("the " + counted(table.rows.size(), "pair") + " of planners of sweep " +
                         sweep.summary.name + " are not shown: a report has them in its table " +
                         table.name);
    }
  }
}

/// The planners of all sweeps in one table.
ordered_json sweeps_side_by_side(const std::vector<PageSweep>& sweeps) {
  std::vector<SweepSummary> summaries;
  for (const PageSweep& sweep : sweeps) summaries.push_back(sweep.summary);
  return table_json(side_by_side(summaries).tables.front());
}

/// Goals before the last, where there are any.
void add_waypoints(const Mission& mission, ordered_json& to) {
  for (const Eigen::Vector3d& place : mission.waypoints_world) {
    to["waypoints"].push_back(to_array(place));
  }
}

}  // namespace

ordered_json pose_json(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {{"position", to_array(pose.translation())}, {"q", {q.w(), q.x(), q.y(), q.z()}}};
}

std::size_t PageScenes::bytes_since(const Mark& mark) const {
  std::size_t bytes = 0;
  for (std::size_t i = mark.worlds; i < worlds.size(); ++i) bytes += size_in_page(worlds[i]);
  for (std::size_t i = mark.rigs; i < rigs.size(); ++i) bytes += size_in_page(rigs[i]);
  for (std::size_t i = mark.meshes; i < meshes.size(); ++i) bytes += size_in_page(meshes[i]);
  return bytes + (warnings.size() - mark.warnings) * kMostPageWarning;
}

void PageScenes::back_to(const Mark& mark) {
  worlds.erase(worlds.begin() + static_cast<std::ptrdiff_t>(mark.worlds), worlds.end());
  rigs.erase(rigs.begin() + static_cast<std::ptrdiff_t>(mark.rigs), rigs.end());
  meshes.cut(mark.meshes);
  warnings.resize(mark.warnings);
  std::erase_if(world_index_, [&](const auto& entry) {
    return entry.second.is_number() && entry.second >= mark.worlds;
  });
  std::erase_if(rig_index_, [&](const auto& entry) { return entry.second >= mark.rigs; });
}

std::size_t PageScenes::add_world(const World& world) {
  worlds.push_back(world_json(world, meshes));
  return worlds.size() - 1;
}

ordered_json PageScenes::world_of(const StoredTrial& stored, const ReplayFiles& files) {
  // Movers are each mission's own.
  const auto [entry, is_new] =
      world_index_.emplace(stored.world_digest + movers_key(stored.spec), nullptr);
  if (!is_new) return entry->second;
  try {
    const StoredTrial placed = with_files(stored, files);
    const World world = flown_world(placed.spec, stored.mission);
    if (triangle_count(world) > kMostPageTriangles) {
      throw InputError("it has more than " + counted(kMostPageTriangles, "triangle"));
    }
    if (world.digest != stored.world_digest) {
      warnings.push_back(
          "a map is not the one that was flown: this program makes a different one from its spec, "
          "or its file has changed");
    }
    entry->second = add_world(world);
  } catch (const InputError& error) {
    warnings.push_back(std::string("a map is not shown: ") + error.what());
  }
  return entry->second;
}

void PageScenes::place(const StoredTrial& stored, ordered_json world, ordered_json& flight) {
  flight["world"] = std::move(world);
  flight["rig"] = rig_of(stored.spec);
  flight["goal_radius"] = stored.spec.mission.goal_radius_m;
  flight["start"] = to_array(stored.mission.start_world);
  flight["goal"] = to_array(stored.mission.goal_world);
  add_waypoints(stored.mission, flight);
}

std::size_t PageScenes::rig_of(const TrialSpec& spec) {
  ordered_json cameras = ordered_json::array();
  for (const RigCamera& camera : rig_cameras(seen_sensor(spec)))
    cameras.push_back(camera_json(camera));
  const ordered_json rig = {{"body", spec.vehicle.body_size_m}, {"cameras", cameras}};
  const auto [entry, is_new] = rig_index_.emplace(rig.dump(), rigs.size());
  if (is_new) rigs.push_back(rig);
  return entry->second;
}

ordered_json page_start(std::string_view kind, const std::string& title, const PageOrigin& origin) {
  return {{"format", 1},
          {"kind", kind},
          {"title", title},
          {"program",
           {{"version", origin.version}, {"git", origin.git_hash}, {"compiler", origin.compiler}}},
          {"command", origin.command}};
}

void add_scenes(PageScenes scenes, ordered_json& page) {
  page["worlds"] = std::move(scenes.worlds);
  page["meshes"] = scenes.meshes.json();
  page["rigs"] = std::move(scenes.rigs);
  // A map of many flights is warned of once.
  std::vector<std::string>& warnings = scenes.warnings;
  std::sort(warnings.begin(), warnings.end());
  warnings.erase(std::unique(warnings.begin(), warnings.end()), warnings.end());
  for (std::string& warning : warnings) warning = cut_to_width(warning, kMostPageWarning);
  page["scene_warnings"] = std::move(warnings);
}

ordered_json sweeps_page(const std::vector<PageSweep>& sweeps,
                         std::span<const PageDatabase> databases, const PageOrigin& origin,
                         std::size_t limit_bytes) {
  std::string title;
  for (const PageSweep& sweep : sweeps) title += (title.empty() ? "" : ", ") + sweep.summary.name;
  ordered_json page = page_start("sweep", title, origin);
  page["sweeps"] = ordered_json::array();
  std::size_t trial_count = 0;
  for (const PageSweep& sweep : sweeps) {
    page["sweeps"].push_back(sweep_json(sweep));
    trial_count += sweep.result.trials.size();
  }
  if (sweeps.size() > 1) page["side_by_side"] = sweeps_side_by_side(sweeps);
  FlightFilling filling = filling_beside(page, limit_bytes, sweeps.size());
  warn_of_pairs(sweeps, filling.scenes.warnings);
  if (filling.is_full()) warn_of_size(trial_count, filling);
  const std::vector<PageTrial> order = flights_in_order(sweeps);
  std::vector<std::string> keys;
  for (const PageTrial& one : order) keys.push_back(sweeps[one.sweep].result.trials[one.trial].key);
  FlightReader flights(databases, std::move(keys), filling.room());
  std::size_t shown = 0;
  while (shown < order.size() && !filling.is_full()) {
    const PageTrial& one = order[shown];
    PackedFlight flight = flights.next();
    const ReplayFiles& files = databases[flight.database].files;
    const ordered_json marks = {{"sweep", one.sweep}, {"trial", one.trial}};
    if (!add_flight(std::move(flight), marks, files, filling)) break;
    ++shown;
  }
  add_filling(std::move(filling), order.size() - shown, page);
  return page;
}

ordered_json map_page(const World& world, const TrialSpec& trial, std::span<const Mission> missions,
                      const std::string& title, const PageOrigin& origin) {
  ordered_json page = page_start("map", title, origin);
  ordered_json listed = ordered_json::array();
  for (std::size_t i = 0; i < missions.size(); ++i) {
    listed.push_back({{"index", i},
                      {"start", to_array(missions[i].start_world)},
                      {"goal", to_array(missions[i].goal_world)}});
    add_waypoints(missions[i], listed.back());
  }
  page["missions"] = std::move(listed);
  page["goal_radius"] = trial.mission.goal_radius_m;
  page["digest"] = world.digest;
  page["flights"] = ordered_json::array();
  PageScenes scenes;
  scenes.add_world(world);
  scenes.rig_of(trial);
  add_scenes(std::move(scenes), page);
  return page;
}

}  // namespace avoidbench
