#include "sensing/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "avoidbench/planner.h"
#include "base/check.hpp"
#include "base/math.hpp"
#include "base/random.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

std::uint32_t kind_number(const std::string& kind) {
  constexpr std::pair<std::string_view, std::uint32_t> kKinds[] = {{"person", AB_TRACK_PERSON},
                                                                   {"box", AB_TRACK_BOX},
                                                                   {"ball", AB_TRACK_BALL},
                                                                   {"pole", AB_TRACK_POLE}};
  for (const auto& [name, number] : kKinds) {
    if (kind == name) return number;
  }
  return AB_TRACK_OTHER;
}

/// Tracks of nothing are numbered like the others.
std::uint32_t id_of(std::uint64_t seed, std::string_view what, std::uint64_t number) {
  return static_cast<std::uint32_t>(stream_seed(stream_seed(seed, what), number) >> 33U);
}

Vector3d drawn_normals(RandomStream& draws) {
  const double x = draws.normal();
  const double y = draws.normal();
  const double z = draws.normal();
  return {x, y, z};
}

bool is_in_view(const TracksSpec& spec, const Pose& T_world_body, const Vector3d& place_world) {
  const Vector3d away = place_world - T_world_body.translation();
  if (away.norm() > spec.range_m) return false;
  if (spec.fov_deg >= 360.0) return true;
  const Vector3d forward = T_world_body.linear().col(0);
  const double across = forward.x() * away.y() - forward.y() * away.x();
  const double ahead = forward.x() * away.x() + forward.y() * away.y();
  return std::abs(math::atan2(across, ahead)) <= 0.5 * spec.fov_deg * math::kDegree;
}

/// Noise and misses of one track in one scan, by number: what else is in view changes nothing.
bool is_seen(const TracksSpec& spec, std::uint64_t scan_seed, Track& track) {
  RandomStream draws(stream_seed(scan_seed, std::uint64_t{track.id}));
  const bool is_missed = draws.uniform() < spec.miss_ratio;
  track.center_world += spec.position_noise_m * drawn_normals(draws);
  track.velocity_world += spec.velocity_noise_mps * drawn_normals(draws);
  return !is_missed;
}

/// Things that are not there: within range around the vehicle, as large and fast as people.
void add_false_tracks(const TracksSpec& spec, double time_s, const Pose& T_world_body,
                      std::uint64_t seed, std::vector<Track>& tracks) {
  const auto second = static_cast<std::uint64_t>(std::floor(time_s));
  const std::uint64_t second_seed = stream_seed(stream_seed(seed, "false tracks"), second);
  RandomStream draws(second_seed);
  const double whole = std::floor(spec.false_count);
  const int more = draws.uniform() < spec.false_count - whole ? 1 : 0;
  const int count = static_cast<int>(whole) + more;
  for (int i = 0; i < count; ++i) {
    Track track{.id = id_of(second_seed, "id", static_cast<std::uint64_t>(i)),
                .kind = AB_TRACK_OTHER,
                .time_s = time_s};
    const double bearing_rad = draws.uniform(0.0, math::kTau);
    // Evenly over the disc.
    const double distance_m = spec.range_m * std::sqrt(draws.uniform());
    const double heading_rad = draws.uniform(0.0, math::kTau);
    const double speed_mps = draws.uniform(0.0, 2.0);
    track.size_m = Vector3d::Constant(draws.uniform(0.3, 0.8));
    track.center_world = T_world_body.translation() +
                         distance_m * Vector3d(math::cos(bearing_rad), math::sin(bearing_rad), 0.0);
    track.velocity_world =
        speed_mps * Vector3d(math::cos(heading_rad), math::sin(heading_rad), 0.0);
    if (is_in_view(spec, T_world_body, track.center_world)) tracks.push_back(track);
  }
}

}  // namespace

std::vector<TrackedThing> tracked_things(const World& world, std::uint64_t seed) {
  std::vector<TrackedThing> things;
  for (std::uint32_t i = 0; i < world.motions.size(); ++i) {
    const Instance& instance = world.instances[world.motions[i].instance];
    Aabb box;
    for (const Eigen::Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
      box.extend(vertex.cast<double>());
    }
    if (box.isEmpty()) continue;
    const double scale = static_cast<double>(instance.T_world_prototype.linear().col(0).norm());
    things.push_back({.motion = i,
                      .id = id_of(seed, "track", i),
                      .kind = kind_number(world.obstacles[instance.obstacle].kind),
                      .center_prototype = box.center(),
                      .size_m = scale * box.sizes()});
  }
  return things;
}

std::vector<Track> tracks_at(const TracksSpec& spec, const World& world,
                             const std::vector<TrackedThing>& things, std::uint64_t seed,
                             const TracksAsked& asked) {
  const std::optional<Tick> period = period_ticks(spec.rate_hz);
  AB_CHECK(period.has_value(), spec.rate_hz);
  const Tick ready = asked.now - ticks(1e-3 * spec.delay_ms);
  if (ready < 0) return {};
  const Tick scan = ready / *period;
  const double time_s = seconds(scan * *period);
  const std::uint64_t scan_seed =
      stream_seed(stream_seed(seed, "scan"), static_cast<std::uint64_t>(scan));
  std::vector<Track> tracks;
  for (const TrackedThing& thing : things) {
    const Motion& motion = world.motions[thing.motion];
    const Instance& instance = world.instances[motion.instance];
    const double moved_s = asked.still_at_s.value_or(time_s);
    const Eigen::Affine3d T = moved(instance.T_world_prototype, motion, moved_s).cast<double>();
    Track track{.id = thing.id,
                .kind = thing.kind,
                .time_s = time_s,
                .center_world = T * thing.center_prototype,
                .velocity_world =
                    asked.still_at_s ? Vector3d::Zero() : state_at(motion, moved_s).velocity_world,
                .size_m = thing.size_m};
    if (!is_in_view(spec, asked.T_world_body, track.center_world)) continue;
    if (is_seen(spec, scan_seed, track)) tracks.push_back(track);
  }
  add_false_tracks(spec, time_s, asked.T_world_body, seed, tracks);
  return tracks;
}

}  // namespace avoidbench
