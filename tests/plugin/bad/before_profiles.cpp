#include <cstddef>

#include "honest.hpp"

/// Not bad: a table as it was before there were profiles. What lies behind it is no business of
/// the host.
BAD_PLANNER(table.struct_size = offsetof(ab_planner, profile_count); table.profile_count = 77;
            table.profiles = reinterpret_cast<const ab_profile* const*>(8);
            table.least_fov_x_rad = 77.0)
