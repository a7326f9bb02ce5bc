#pragma once

#include <cstdint>
#include <string>

namespace avoidbench {

/// One of `count` parts of a sweep that are flown apart, from 1.
struct Shard {
  std::int64_t index = 1, count = 1;
};

/// The shard that "2/3", "auto" or "auto/3" names. auto: the task of a Slurm array, a PBS array
/// (from 1) or a Kubernetes indexed job (from 0), by their environment; only Slurm says how many
/// there are. Throws InputError.
Shard shard_from(const std::string& text);

/// "2/3"; "" where it is all of it.
std::string text(const Shard& shard);

}  // namespace avoidbench
