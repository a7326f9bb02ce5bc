#pragma once

#include <string_view>

namespace avoidbench {

/// Whether values of this field of TrialSpec, named by its dotted path, make maps and missions of
/// their own: the one answer for all who count what a sweep asks for. It has to agree with
/// map_key() of the room sweep, which a test holds to it.
inline bool makes_maps(std::string_view path) {
  return path.starts_with("map.") || path == "map_seed" || path == "seed" ||
         path.starts_with("mission.") || path == "vehicle.body_size_m";
}

}  // namespace avoidbench
