#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A contradiction between fields that are each within their ranges.
struct Contradiction {
  std::string path;  ///< dotted, of TrialSpec: the field to look at first
  std::string message;
};

/// All rates of a trial with their paths.
std::vector<std::pair<std::string, double*>> rates_hz(TrialSpec& spec);

/// The rate nearest to `rate_hz` whose period is a whole number of ticks; itself where it is one.
double nearest_rate_hz(double rate_hz);

/// What makes this trial impossible: ranges that are empty, matchers that can't be, flights above
/// the ceiling, gusts that overlap, a vehicle that can't fly.
std::vector<Contradiction> contradictions(const TrialSpec& spec);

}  // namespace avoidbench
