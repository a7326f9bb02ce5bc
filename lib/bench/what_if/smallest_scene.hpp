#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "replay/replay.hpp"

/// The smallest set of obstacles with which a flight still does not reach its goal.
namespace avoidbench {

/// A trial whose map is to be made smaller.
struct SceneRequest {
  StoredTrial stored;
  ReplayFiles files;
  std::filesystem::path folder;  ///< gets the map, and while flights go on those that are tried
  std::int64_t most_flights = 300;
  FleetOptions fleet;
  /// As it goes on: flights so far, and how many obstacles the smallest set has that fails.
  std::function<void(std::int64_t flights, std::size_t obstacles)> on_progress = {};
};

/// What is left of it.
struct SmallestScene {
  TrialSpec spec;  ///< the trial on the map as a file; its missions are `missions`
  /// The trial's mission, as many times as its index needs: noise follows from the index.
  std::vector<Mission> missions;
  std::size_t obstacles_before = 0, obstacles = 0;
  std::vector<std::string> kinds;  ///< of those that are left: "tree", …
  std::int64_t flights = 0;        ///< that it took
  bool is_minimal = false;         ///< it is cured without any one of them: all were tried
  bool is_stopped = false;         ///< before the end, by a signal
  Outcome outcome = Outcome::timed_out;
  std::string reason;
};

/// The name of the map's file in SceneRequest::folder.
inline constexpr const char* kSceneMapFile = "map.glb";

/// Flies the trial on maps of ever fewer of its obstacles; ground, walls and ceiling stay. A flight
/// fails if it does not reach the goal, whichever way. Each map is flown as it is exported, a mesh
/// in a file, so that whoever flies the file sees the same; what moves stands where it stood when
/// the flight ended. The result does not depend on the number of workers. Throws InputError where
/// the stored trial reached its goal, has measured latencies, or reaches it on the file of the
/// whole map.
SmallestScene smallest_scene(const SceneRequest& request);

}  // namespace avoidbench
