#include "trial/flown_world.hpp"

#include "base/number_text.hpp"
#include "base/spec_json.hpp"
#include "movers/movers.hpp"
#include "trial/noise_seed.hpp"

namespace avoidbench {

std::optional<World> world_with_movers(const TrialSpec& spec, const Scene& map,
                                       const Mission& mission) {
  if (!has_movers(spec.movers)) return std::nullopt;
  // The leg that is flown at a known time: a mission that returns has no line from start to goal.
  const bool has_waypoints = !mission.waypoints_world.empty();
  return with_movers(
      map, spec.movers,
      {.seed = noise_seed(spec, "movers"),
       .start_world = mission.start_world,
       .goal_world = has_waypoints ? mission.waypoints_world.front() : mission.goal_world,
       .speed_limit_mps = spec.vehicle.max_speed_mps,
       .time_limit_s = spec.mission.time_limit_s});
}

World flown_world(const TrialSpec& spec, const Mission& mission) {
  World map = make_world(spec.map, spec.map_seed);
  if (!has_movers(spec.movers)) return map;
  return *world_with_movers(spec, Scene(map), mission);
}

std::string movers_key(const TrialSpec& spec) {
  if (!has_movers(spec.movers)) return "";
  return spec_to_json(spec.movers).dump() + std::to_string(noise_seed(spec, "movers")) + ' ' +
         shortest(spec.vehicle.max_speed_mps) + ' ' + shortest(spec.mission.time_limit_s);
}

}  // namespace avoidbench
