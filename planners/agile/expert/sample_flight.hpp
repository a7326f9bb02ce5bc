#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "network.hpp"
#include "sample_files.hpp"
#include "trial/flight.hpp"

namespace agile {

/// How the flights go that samples are taken from.
struct SamplingSpec {
  std::uint64_t seed = 1;
  double least_speed_mps = 1.5, most_speed_mps = 6.5;  ///< of a flight, drawn evenly
  double start_yaw_rad = 0.5;     ///< a flight begins up to this far from the goal's direction
  double disturbed_ratio = 0.04;  ///< of the expert's plans: those that begin to lead astray
  bool labels = true;             ///< no: only fly by a network, no samples
};

struct SampledFlight {
  std::vector<Sample> samples;
  avoidbench::Outcome outcome = avoidbench::Outcome::timed_out;
};

/// Flies one trial as the plugin does, but by the expert or, where there is one, by `network`; each
/// image becomes a sample with the expert's ways. The expert is led astray now and then, so that
/// samples also show how to get out of trouble. Depends on its arguments alone.
SampledFlight sample_flight(const avoidbench::TrialSpec& spec, const avoidbench::Scene& scene,
                            const avoidbench::Mission& mission, const ClearanceField& field,
                            const SamplingSpec& sampling, Network* network);

}  // namespace agile
