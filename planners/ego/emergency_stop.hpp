#pragma once

#include "planning/polynomial.hpp"
#include "settings.hpp"
#include "surroundings.hpp"

namespace ego {

/// Planned stops brake with this share of the vehicle's acceleration.
inline constexpr double kBraking = 0.9;

/// The quickest way to rest that touches nothing known: straight on where that is free, else to one
/// side, up or down while braking; where none is free, the one that touches last.
planning::Quintic emergency_stop(const Surroundings& surroundings, const Settings& settings,
                                 const planning::Motion& from);

}  // namespace ego
