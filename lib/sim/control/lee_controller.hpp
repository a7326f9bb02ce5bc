#pragma once

#include <Eigen/Core>

#include "control/reference.hpp"
#include "vehicle/model.hpp"
#include "vehicle/state.hpp"

namespace avoidbench {

/// What a controller asks the mixer for.
struct ThrustAndTorque {
  double thrust_n = 0.0;
  Eigen::Vector3d torque_body_nm = Eigen::Vector3d::Zero();
};

/// Thrust and torque of the geometric tracking controller of Lee, Leok and McClamroch (CDC 2010)
/// with the gains of lee_controller, as in RotorS:
///
///     F = m a_ref + m g e_z - k_x (p - p_ref) - k_v (v - v_ref),   thrust = F · R e_z,
///     τ = -k_R e_R - k_Ω e_Ω + Ω × J Ω,
///     e_R = ½ (R_dᵀ R - Rᵀ R_d)^∨,   e_Ω = Ω - Rᵀ R_d Ω_d,
///
/// R_d having its z along F and its x as near as may be to the heading. Ω_d are the reference's
/// rates in still air (flat_state()); the paper's terms with the derivative of Ω_d are left out.
/// Without feed_forward Ω_d is the yaw rate alone and Ω × J Ω is left out, as in RotorS. Unlike
/// there, F's tilt is limited as the vehicle's and its vertical part kept above 1 m/s² times m.
ThrustAndTorque lee_control(const VehicleModel& model, const VehicleState& state,
                            const Reference& reference);

}  // namespace avoidbench
