#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "page/flight_reading.hpp"
#include "page/sweep_data.hpp"
#include "page/world_data.hpp"
#include "replay/replay.hpp"
#include "trial/mission.hpp"

namespace avoidbench {

inline constexpr std::size_t kMostPageWarning = 300;  ///< characters

/// What made a page: it says so on itself.
struct PageOrigin {
  std::string version, git_hash, compiler, command;
};

/// What several flights of a page share: maps, their meshes, and rigs (a body with its cameras),
/// each once. Maps that can't be made are left out, with a line in `warnings`.
class PageScenes {
 public:
  /// Index of the map of the trial, null where it can't be had. `files` say where maps from files
  /// are looked for.
  nlohmann::ordered_json world_of(const StoredTrial& stored, const ReplayFiles& files);
  std::size_t add_world(const World& world);
  std::size_t rig_of(const TrialSpec& spec);
  /// Gives the flight its map, by index, its rig, and its mission.
  void place(const StoredTrial& stored, nlohmann::ordered_json world,
             nlohmann::ordered_json& flight);

  /// How many of each there are: a place to go back to.
  struct Mark {
    std::size_t worlds = 0, rigs = 0, meshes = 0, warnings = 0;
  };
  Mark mark() const { return {worlds.size(), rigs.size(), meshes.size(), warnings.size()}; }
  /// How much room what came since then takes in a page, bytes.
  std::size_t bytes_since(const Mark& mark) const;
  void back_to(const Mark& mark);  ///< takes it out again

  nlohmann::ordered_json worlds = nlohmann::ordered_json::array();
  nlohmann::ordered_json rigs = nlohmann::ordered_json::array();
  MeshStore meshes;
  std::vector<std::string> warnings;

 private:
  std::map<std::string, nlohmann::ordered_json> world_index_;  ///< by its digest and movers
  std::map<std::string, std::size_t> rig_index_;
};

/// The data of a page of sweeps, which takes up to `limit_bytes`: flights that have no room are
/// left out. Tables and numbers of trials stay; where they alone take more, a warning says so.
/// Reasons of failures are cut at 300 characters, and no table of more than kMostShownPairs pairs
/// is there.
nlohmann::ordered_json sweeps_page(const std::vector<PageSweep>& sweeps,
                                   std::span<const PageDatabase> databases,
                                   const PageOrigin& origin, std::size_t limit_bytes);

/// The data of a page of one map with some of its missions.
nlohmann::ordered_json map_page(const World& world, const TrialSpec& trial,
                                std::span<const Mission> missions, const std::string& title,
                                const PageOrigin& origin);

nlohmann::ordered_json pose_json(const Eigen::Isometry3d& pose);

/// What every page begins with.
nlohmann::ordered_json page_start(std::string_view kind, const std::string& title,
                                  const PageOrigin& origin);
/// Puts the scenes' maps, meshes, rigs and warnings into a page.
void add_scenes(PageScenes scenes, nlohmann::ordered_json& page);

}  // namespace avoidbench
