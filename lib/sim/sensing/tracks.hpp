#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/fields.hpp"
#include "base/ticks.hpp"
#include "geometry/pose.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// How a planner that declares tracks sees things that move: by default as they are; see
/// docs/movers.md.
struct TracksSpec {
  double rate_hz = 20.0;
  double range_m = 15.0;
  double fov_deg = 360.0;
  double delay_ms = 0.0;
  double position_noise_m = 0.0;
  double velocity_noise_mps = 0.0;
  double miss_ratio = 0.0;
  double false_count = 0.0;
};

template <class Visitor, ConstOr<TracksSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("rate_hz", s.rate_hz, Range{0.5, 1000}, "Scans per second.");
  v.field("range_m", s.range_m, Range{0.5, 1000},
          "Movers are tracked whose middle is within this distance; nothing hides them.");
  v.field("fov_deg", s.fov_deg, Range{1, 360},
          "Horizontal field of view around the vehicle's heading; 360: all round.");
  v.field("delay_ms", s.delay_ms, Range{0, 10000},
          "From a scan to when the planner may have its tracks.");
  v.field("position_noise_m", s.position_noise_m, Range{0, 10},
          "Standard deviation of a middle, each axis, each scan.");
  v.field("velocity_noise_mps", s.velocity_noise_mps, Range{0, 10},
          "Standard deviation of a velocity, each axis, each scan.");
  v.field("miss_ratio", s.miss_ratio, Range{0, 1}, "Share of the tracks of a scan left out.");
  v.field("false_count", s.false_count, Range{0, 100},
          "Mean number of tracks of nothing; each lasts for a second.");
}

/// One thing that moves, at the time of a scan.
struct Track {
  std::uint32_t id = 0;    ///< the same in all scans
  std::uint32_t kind = 0;  ///< AB_TRACK_…
  double time_s = 0.0;
  Eigen::Vector3d center_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of its box in its own frame, z up
};

/// What of a moving instance never changes.
struct TrackedThing {
  std::uint32_t motion = 0;  ///< index into World::motions
  std::uint32_t id = 0, kind = 0;
  Eigen::Vector3d center_prototype = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

/// All that moves in a world, for one trial: ids are drawn from its seed, so that they tell
/// nothing.
std::vector<TrackedThing> tracked_things(const World& world, std::uint64_t seed);

/// The newest scan that a planner may have at `now`; nothing before the first. `T_world_body` is
/// the vehicle's true pose at `now`, by which range and field of view are judged; what things do at
/// the scan's time is their motions' alone, so that no scan needs a tick of its own. Where
/// `still_at_s` is given they stand where they are then.
struct TracksAsked {
  Tick now = 0;
  Pose T_world_body = Pose::Identity();
  std::optional<double> still_at_s = {};
};
std::vector<Track> tracks_at(const TracksSpec& spec, const World& world,
                             const std::vector<TrackedThing>& things, std::uint64_t seed,
                             const TracksAsked& asked);

}  // namespace avoidbench
