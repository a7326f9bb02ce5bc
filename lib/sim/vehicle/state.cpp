#include "vehicle/state.hpp"

#include "geometry/pose.hpp"
#include "vehicle/model.hpp"

namespace avoidbench {

VehicleState hovering_at(const VehicleSpec& vehicle, const Eigen::Vector3d& position_world,
                         double yaw_rad) {
  VehicleState state;
  state.position_world = position_world;
  state.q_world_body = yaw_rotation(yaw_rad);
  // The rotors turn already: else each flight would begin with a fall.
  state.rotor_speed_radps = make_model(vehicle).hover_speed_radps;
  return state;
}

}  // namespace avoidbench
