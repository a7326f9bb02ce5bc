#include "vehicle/allocation.hpp"

#include <Eigen/LU>
#include <cmath>

namespace avoidbench {

Eigen::Matrix4Xd allocation_matrix(const VehicleSpec& vehicle) {
  Eigen::Matrix4Xd allocation(4, static_cast<Eigen::Index>(vehicle.rotors.size()));
  for (Eigen::Index i = 0; i < allocation.cols(); ++i) {
    const RotorSpec& rotor = vehicle.rotors[static_cast<std::size_t>(i)];
    // r × F of a thrust F along z: (y F, −x F); and the drag torque, against the spin.
    allocation.col(i) << 1.0, rotor.position_body_m[1], -rotor.position_body_m[0],
        -static_cast<double>(rotor.spin) * vehicle.moment_coefficient_m;
  }
  return allocation;
}

std::optional<Eigen::MatrixX4d> pseudo_inverse(const Eigen::Matrix4Xd& allocation) {
  // Rows are brought to length one first: thrust and torques have different units.
  Eigen::Vector4d scale;
  Eigen::Matrix4Xd rows = allocation;
  for (Eigen::Index row = 0; row < 4; ++row) {
    const double length = allocation.row(row).norm();
    if (!(length > 0.0)) return std::nullopt;
    scale[row] = 1.0 / length;
    rows.row(row) *= scale[row];
  }
  const Eigen::Matrix4d gram = rows * rows.transpose();
  // Of a matrix whose rows have length one, so that it is a pure number.
  constexpr double kSingular = 1e-9;
  if (!(gram.determinant() > kSingular)) return std::nullopt;
  const Eigen::Matrix4d inverse = gram.inverse();
  return Eigen::MatrixX4d(rows.transpose() * inverse * scale.asDiagonal());
}

}  // namespace avoidbench
