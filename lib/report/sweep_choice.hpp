#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

/// The revisions of sweeps that `wanted` means, in each database those with finished trials: "" the
/// latest revision of every sweep, NAME the latest of that name, NAME@2 its revision 2. Throws
/// InputError where no database has a finished trial of it. Sweeps that are wanted and have none go
/// to `unflown`, a line each.
std::vector<std::vector<SweepInfo>> chosen_sweeps(std::span<const Database> databases,
                                                  std::string_view wanted,
                                                  std::vector<std::string>* unflown = nullptr);

}  // namespace avoidbench
