#pragma once

#include "vehicle/dynamics.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"
#include "vehicle/vehicle_spec.hpp"

namespace avoidbench {

/// The hummingbird in whose terms the closed forms are stated: rotors in the plane of the centre of
/// gravity, bare inertia, g = 9.8, rolling moment as RotorS has it, no reaction torque.
inline VehicleSpec flat_hummingbird() {
  VehicleSpec spec = hummingbird_rotors_spec();
  spec.inertia_kgm2 = {0.007, 0.007, 0.012};
  for (RotorSpec& rotor : spec.rotors) rotor.position_body_m[2] = 0.0;
  return spec;
}

inline VehicleSpec without_drag(VehicleSpec spec) {
  spec.rotor_drag_coefficient_kg = 0.0;
  spec.rolling_moment_coefficient_kgm = 0.0;
  return spec;
}

/// A body that hardly turns: for closed forms at a fixed attitude.
inline VehicleSpec with_fixed_attitude(VehicleSpec spec) {
  spec.inertia_kgm2 = {1e15, 1e15, 1e15};
  return spec;
}

inline RotorVector all_rotors(const VehicleModel& model, double value) {
  return RotorVector::Constant(model.rotor_count, value);
}

inline VehicleState still(const VehicleModel& model, double rotor_speed_radps) {
  VehicleState state;
  state.rotor_speed_radps = all_rotors(model, rotor_speed_radps);
  return state;
}

/// Rotors kept at their speeds for so many 1 ms steps.
inline VehicleState coast(const VehicleModel& model, VehicleState state,
                          const Environment& environment, int steps) {
  const RotorVector command = state.rotor_speed_radps;
  for (int i = 0; i < steps; ++i) {
    state = step(model, state, command, environment, kTicksPerMillisecond);
  }
  return state;
}

}  // namespace avoidbench
