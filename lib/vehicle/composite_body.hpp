#pragma once

#include <Eigen/Core>
#include <span>

namespace avoidbench {

/// One rigid part: its mass, where its centre of gravity is, and its moments about that along the
/// common axes.
struct BodyPart {
  double mass_kg = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d inertia_kgm2 = Eigen::Vector3d::Zero();
};

/// The one rigid body that `parts` make: mass, common centre of gravity, moments about it (parallel
/// axes). Products of inertia are left out; they cancel where the parts are symmetric.
BodyPart composite_body(std::span<const BodyPart> parts);

/// A freely spinning rotor with these moments as a part: about its axis it carries none of the
/// body's turning, across it the mean of its two moments.
BodyPart spinning_rotor(double mass_kg, const Eigen::Vector3d& position_m,
                        const Eigen::Vector3d& rotor_inertia_kgm2);

}  // namespace avoidbench
