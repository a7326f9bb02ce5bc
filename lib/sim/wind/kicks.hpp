#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/ticks.hpp"
#include "wind/wind_spec.hpp"

namespace avoidbench {

/// A constant force and torque from `from` to before `until`.
struct Kick {
  Tick from = 0, until = 0;
  Eigen::Vector3d force_world_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_body_nm = Eigen::Vector3d::Zero();
};

/// The kicks that begin before `until_s`, in order: a Poisson process of rate_per_min, so that
/// they may overlap. Directions of force and torque are uniform on the sphere and independent.
/// Times are rounded to ticks.
std::vector<Kick> make_kicks(const KickSpec& kicks, std::uint64_t seed, double until_s);

}  // namespace avoidbench
