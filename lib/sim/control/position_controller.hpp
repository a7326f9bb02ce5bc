#pragma once

#include <Eigen/Core>

#include "control/reference.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// The attitude (columns: body axes in the world), rates and thrust with which the vehicle follows
/// a reference exactly in still air.
struct FlatState {
  Eigen::Matrix3d R_world_body;
  Eigen::Vector3d rates_body_radps;
  double thrust_mps2 = 0.0;
};

/// The flat outputs' inverse under drag linear in velocity, v' = -g e_z + c z_B - R D Rᵀ v, with
/// `drag_per_s` the diagonal of D: Faessler, Franchi and Scaramuzza, "Differential Flatness of
/// Quadrotor Dynamics Subject to Rotor Drag", RA-L 2018. Where the thrust vanishes or points along
/// the heading's side the rates are zero.
FlatState flat_state(const Reference& reference, const Eigen::Vector3d& drag_per_s,
                     double gravity_mps2);

/// The demanded acceleration, gravity's part included, with its vertical part at least
/// `min_vertical` and its tilt within `max_tilt_rad`; a tilt is lowered by its horizontal part.
Eigen::Vector3d tilt_limited(const Eigen::Vector3d& demand, double min_vertical,
                             double max_tilt_rad);

/// Body rates and thrust that bring the vehicle to the reference: the position controller of
/// rpg_quadrotor_control. Proportional-derivative on limited errors plus the reference's
/// acceleration and drag give the demanded acceleration; its direction and the yaw give an
/// attitude, proportional to whose error (a quaternion's vector part) rates are added to the
/// reference's. Unlike there, horizontal errors are limited by their length, not axis by axis, so
/// that turning the world turns the flight; the demanded tilt is limited, keeping the vertical
/// part; rates and thrust are the vehicle's.
RateTarget position_control(const VehicleModel& model, const VehicleState& state,
                            const Reference& reference);

}  // namespace avoidbench
