#pragma once

#include <string>
#include <vector>

#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A contradiction between fields that are each within their ranges.
struct Contradiction {
  std::string path;  ///< dotted, of TrialSpec: the field to look at first
  std::string message;
};

/// What makes this trial impossible: rates that are not whole ticks, ranges that are empty, flights
/// above the ceiling, a vehicle that can't fly.
std::vector<Contradiction> contradictions(const TrialSpec& spec);

}  // namespace avoidbench
