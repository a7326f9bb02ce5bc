#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "base/ticks.hpp"
#include "wind/environment.hpp"
#include "wind/kicks.hpp"
#include "wind/turbulence.hpp"
#include "wind/wind_field.hpp"
#include "wind/wind_spec.hpp"

namespace avoidbench {

/// Wind and disturbances between one physics step and the next. Plain data; copy it to branch. Only
/// the turbulence has a past; all else is a function of time and place.
struct Wind {
  WindSpec spec;
  Environment steady;  ///< the constant part
  bool is_steady = true;

  WindField field;
  std::uint64_t gust_seed = 0;
  Tick force_from = 0, force_until = 0;
  std::vector<Kick> kicks;
  std::size_t first_kick = 0;  ///< the first that is not over

  bool is_turbulent = false;
  Eigen::Vector3d sigma_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_world = Eigen::Vector3d::UnitX();  ///< the turbulence's first axis
  DrydenFilter dryden;
  DrydenState turbulence;
  RandomStream turbulence_random{0};
  Tick turbulence_period = 0, turbulence_tick = 0;

  Tick tick = 0;  ///< of the last call
};

/// The wind of one trial, whose random parts follow from `seed` and the spec's own; kicks are drawn
/// until `until_s`. Throws InputError where the spec contradicts itself or its file is no wind
/// field.
Wind make_wind(const WindSpec& spec, std::uint64_t seed, double until_s);

/// What acts on the vehicle at this tick and place, held over the step that begins there. The tick
/// may not be before that of an earlier call. What is random is a function of time alone, so that
/// it is the same whatever a planner does.
Environment environment_at(Wind& wind, Tick tick, const Eigen::Vector3d& position_world);

/// The next tick after `now` at which a force begins or ends; physics steps end there, so that
/// impulses are exact. The largest tick there is where there is none.
Tick next_force_change(const Wind& wind, Tick now);

}  // namespace avoidbench
