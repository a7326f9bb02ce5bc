#pragma once

#include "movers/mover_spec.hpp"
#include "render/scene.hpp"

namespace avoidbench {

/// The flight that movers are made for.
struct MoverCourse {
  std::uint64_t seed = 0;
  Eigen::Vector3d start_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_world = Eigen::Vector3d::Zero();  ///< of several, the first
  double speed_limit_mps = 1.0;  ///< of the vehicle that crossing movers are timed to meet
  double time_limit_s = 60.0;    ///< until then they move
};

/// How many there are on this map.
std::int64_t mover_count(const MoversSpec& spec, const World& map);

/// The map with its movers: instances, obstacles and motions after its own, a prototype a kind. A
/// pure function of its arguments; each mover has a stream of its own, so that a larger number
/// leaves the first ones as they are. The digest stays the map's. Throws InputError where the
/// flight box has no place for one that far from the start.
World with_movers(const Scene& map, const MoversSpec& spec, const MoverCourse& course);

}  // namespace avoidbench
