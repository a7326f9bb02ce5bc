#pragma once

#include "control/reference.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// The state of a vehicle that is where `reference` is: position, velocity, and the attitude and
/// rates with which it would stay there in still air; its rotors turn alike, as fast as the thrust
/// for that takes. Tick from `state`.
VehicleState state_on(const Reference& reference, const VehicleModel& model,
                      const VehicleState& state);

}  // namespace avoidbench
