#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "trial/trial_record.hpp"

namespace avoidbench {

/// Steps that a flight's numbers are rounded to in a page.
inline constexpr double kPageTimeStep_s = 0.001, kPagePositionStep_m = 0.01,
                        kPageSpeedStep_mps = 0.01, kPageClearanceStep_m = 0.01;
inline constexpr double kPageQuaternionSteps = 2047.0;  ///< of 1: 12 bits with the sign
inline constexpr double kPageSamples_hz = 20.0;         ///< of flights of a sweep's page

/// The samples that are shown: the first, the last, and between them so many per second at most.
std::vector<std::size_t> kept_samples(std::span<const Sample> samples, double rate_hz);

/// A flight for a page: samples rounded and packed, touches, and when the planner's answers changed
/// their kind. Of each piece between two samples that are kept, the least clearance is told, so
/// that the page shows how near it came.
nlohmann::ordered_json flight_json(const TrialRecord& record, double rate_hz);

}  // namespace avoidbench
