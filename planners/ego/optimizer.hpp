#pragma once

#include <optional>

#include "planning/bspline.hpp"
#include "settings.hpp"
#include "surroundings.hpp"

namespace ego {

/// The curve pushed out of the obstacles it runs through, its ends kept: anchors where it is
/// blocked, L-BFGS, new anchors for what it is pushed into ("rebound"). Nothing where its first two
/// thirds can't be freed.
std::optional<planning::Bspline> rebounded(Surroundings& surroundings, const Settings& settings,
                                           planning::Bspline curve);

/// A curve near `slower` that is smooth and keeps the limits better, its ends kept.
planning::Bspline refined(const Settings& settings, const planning::Bspline& slower);

/// Two thirds of a trajectory's time: what is checked for obstacles when it is made.
inline double checked_s(const planning::Bspline& curve) { return curve.duration_s() * 2.0 / 3.0; }

/// When the curve is first blocked within `checked_s`.
std::optional<double> first_blocked_s(const Surroundings& surroundings, const Settings& settings,
                                      const planning::Bspline& curve);

}  // namespace ego
