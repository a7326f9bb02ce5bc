#include "control/perfect_tracking.hpp"

#include <algorithm>
#include <cmath>

#include "control/position_controller.hpp"

namespace avoidbench {

VehicleState state_on(const Reference& reference, const VehicleModel& model,
                      const VehicleState& state) {
  const FlatState flat = flat_state(reference, model.drag_per_s, model.spec.gravity_mps2);
  VehicleState on = state;
  on.position_world = reference.position_world;
  on.velocity_world = reference.velocity_world;
  on.q_world_body = Eigen::Quaterniond(flat.R_world_body).normalized();
  on.rates_body = flat.rates_body_radps;
  // Thrust goes with the square of the speed; hovering speeds are those of g.
  const double share = std::max(flat.thrust_mps2, 0.0) / model.spec.gravity_mps2;
  on.rotor_speed_radps = model.hover_speed_radps * std::sqrt(share);
  return on;
}

}  // namespace avoidbench
