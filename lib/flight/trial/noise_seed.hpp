#pragma once

#include <cstdint>
#include <string_view>

#include "base/random.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// The seed of `what` in this trial: the same for every planner.
inline std::uint64_t noise_seed(const TrialSpec& spec, std::string_view what) {
  const std::uint64_t map_stream = stream_seed(stream_seed(spec.seed, what), spec.map_seed);
  return stream_seed(map_stream, static_cast<std::uint64_t>(spec.mission_index));
}

}  // namespace avoidbench
