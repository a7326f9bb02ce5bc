#pragma once

#include <array>
#include <cstddef>

#include "avoidbench/planner.hpp"

namespace planning {

/// The parameter of planners that have a second set of defaults, that of their authors.
inline constexpr ab_parameter kPreset = avoidbench::choice_parameter(
    "preset", "avoidbench", "avoidbench|published",
    "published: each parameter that is given no value takes its authors' figure.");

/// That second set.
template <std::size_t count>
constexpr ab_profile published(const std::array<ab_named_number, count>& numbers) {
  return avoidbench::profile(kPreset.name, "published", numbers);
}

}  // namespace planning
