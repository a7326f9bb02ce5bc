#pragma once

#include "plugin/planner_instance.hpp"
#include "render/scene.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// What a planner that sees the world may ask of a trial's map (AB_WORLD_EXTENSION). The scene must
/// outlive it; one thread at a time.
PlannerWorld known_world(const TrialSpec& spec, const Scene& scene, const Mission& mission);

}  // namespace avoidbench
