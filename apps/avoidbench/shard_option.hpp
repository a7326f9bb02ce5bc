#pragma once

#include <string>

#include "sweep/schedule.hpp"

namespace avoidbench {

/// The shard that "2/3", "auto" or "auto/3" names. auto: the task of a Slurm array, a PBS array
/// (from 1) or a Kubernetes indexed job (from 0), by their environment; only Slurm says how many
/// there are. Throws InputError.
Shard shard_from(const std::string& text);

}  // namespace avoidbench
