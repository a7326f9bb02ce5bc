#pragma once

#include <optional>
#include <string>

#include "trial/mission.hpp"

namespace avoidbench {

/// The trial's map with the movers of its mission; nothing where it has none: then its world is the
/// map's.
std::optional<World> world_with_movers(const TrialSpec& spec, const Scene& map,
                                       const Mission& mission);

/// The world that a trial is flown in, its map made again: for those who look at flights.
World flown_world(const TrialSpec& spec, const Mission& mission);

/// What its movers follow from, beside the map and its missions, as text; "" where there are none.
std::string movers_key(const TrialSpec& spec);

}  // namespace avoidbench
