#pragma once

#include <Eigen/Core>
#include <array>

#include "base/fields.hpp"
#include "geometry/pose.hpp"

namespace avoidbench {

/// What acts on the vehicle from outside: the air's velocity, which the rotors and the body feel
/// through drag, and a force at the centre of gravity.
struct Environment {
  Eigen::Vector3d wind_world_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_world_n = Eigen::Vector3d::Zero();
};

/// A constant wind and a constant force, the two ways in which RotorS models wind; they are
/// unrelated numbers.
struct WindSpec {
  std::array<double, 3> mean_world_mps{0.0, 0.0, 0.0};
  std::array<double, 3> force_world_n{0.0, 0.0, 0.0};
};

template <class Visitor>
void visit(Visitor& v, WindSpec& s) {
  v.field("mean_world_mps", s.mean_world_mps, Range{-30, 30}, "Velocity of the air, ENU.");
  v.field("force_world_n", s.force_world_n, Range{-100, 100},
          "Constant force on the vehicle at its centre of gravity, ENU.");
}

inline Environment environment(const WindSpec& wind) {
  return {to_eigen(wind.mean_world_mps), to_eigen(wind.force_world_n)};
}

}  // namespace avoidbench
