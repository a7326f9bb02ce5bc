#include "vehicle/composite_body.hpp"

namespace avoidbench {

BodyPart composite_body(std::span<const BodyPart> parts) {
  BodyPart body;
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();
  for (const BodyPart& part : parts) {
    body.mass_kg += part.mass_kg;
    first_moment += part.mass_kg * part.position_m;
  }
  body.position_m = first_moment / body.mass_kg;
  for (const BodyPart& part : parts) {
    const Eigen::Vector3d r = part.position_m - body.position_m;
    const Eigen::Vector3d squares = r.cwiseProduct(r);
    body.inertia_kgm2 +=
        part.inertia_kgm2 + part.mass_kg * Eigen::Vector3d(squares.y() + squares.z(),
                                                           squares.x() + squares.z(),
                                                           squares.x() + squares.y());
  }
  return body;
}

BodyPart spinning_rotor(double mass_kg, const Eigen::Vector3d& position_m,
                        const Eigen::Vector3d& rotor_inertia_kgm2) {
  const double across = 0.5 * (rotor_inertia_kgm2.x() + rotor_inertia_kgm2.y());
  return {mass_kg, position_m, {across, across, 0.0}};
}

}  // namespace avoidbench
