/* Moving objects, for planners that declare AB_INPUT_TRACKS: where a track is at another time, and
 * how far a place is from it then. A part of planner.hpp, which includes it. Header-only, C++17.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_TRACKS_HPP
#define AVOIDBENCH_TRACKS_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "avoidbench/canvas.hpp"
#include "avoidbench/planner.h"

namespace avoidbench {

/// The middle of the track's box at `time_s` (seconds since the start of the trial, as
/// ab_observation.time_s), in the world, metres, if it keeps the scan's velocity. Also for times
/// before the scan.
inline Vec3 track_center_at(const ab_track& track, double time_s) {
  Vec3 center{};
  for (std::size_t k = 0; k < 3; ++k) {
    center[k] = track.center_world_m[k] + (time_s - track.time_s) * track.velocity_world_mps[k];
  }
  return center;
}

/// The radius in metres of the upright cylinder around the track's box for any heading, which a
/// track does not contain: half of the longer side for round objects (person, ball, pole), half of
/// the diagonal for others.
inline double track_radius_m(const ab_track& track) {
  const double a = 0.5 * track.size_m[0], b = 0.5 * track.size_m[1];
  const bool is_round =
      track.kind == AB_TRACK_PERSON || track.kind == AB_TRACK_BALL || track.kind == AB_TRACK_POLE;
  return is_round ? std::max(a, b) : std::sqrt(a * a + b * b);
}

/// How far a place in the world is from the track's surface at `time_s`, metres; negative inside.
/// The surface is a ball's, or else that of an upright cylinder of track_radius_m(), so the
/// distance to the object itself is never less, as long as it keeps its velocity.
inline double distance_to_track_m(const ab_track& track, const Vec3& place_world_m, double time_s) {
  const Vec3 center = track_center_at(track, time_s);
  const double x = place_world_m[0] - center[0], y = place_world_m[1] - center[1];
  const double z = place_world_m[2] - center[2];
  const double radius_m = track_radius_m(track);
  if (track.kind == AB_TRACK_BALL) return std::sqrt(x * x + y * y + z * z) - radius_m;
  const double beside_m = std::sqrt(x * x + y * y) - radius_m;
  const double above_m = std::abs(z) - 0.5 * track.size_m[2];
  const double beside = std::max(beside_m, 0.0), above = std::max(above_m, 0.0);
  return std::sqrt(beside * beside + above * above) + std::min(std::max(beside_m, above_m), 0.0);
}

}  // namespace avoidbench

#endif
