#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/number_text.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// Numbers of a stored sample, in the order that schema.sql names.
inline constexpr std::size_t kSampleDoubles = 22;
inline constexpr std::size_t kSampleBytes = kSampleDoubles * sizeof(double);

/// Samples as stored: kSampleDoubles little-endian doubles each.
std::vector<std::byte> sample_bytes(std::span<const Sample> samples);
/// Reverse of sample_bytes(); bytes after the last whole sample are passed over.
std::vector<Sample> samples_from_bytes(std::span<const std::byte> bytes);

/// The bytes of sample_bytes() packed for storage: see schema.sql.
std::vector<std::byte> packed_samples(std::span<const std::byte> bytes);
/// Reverse of packed_samples() for so many samples; empty where `packed` is damaged.
std::vector<std::byte> unpacked_samples(std::span<const std::byte> packed, std::size_t count);

/// Calls as stored: a JSON array of [time_s, cpu_time_s, wall_time_s, status, command_kind] and,
/// where it is not NaN, latency_s; numbers with the fewest digits that read back to the same bits.
std::string plan_calls_json(std::span<const PlanCall> calls);
/// Reverse of plan_calls_json(). Throws nlohmann::json::exception for any other text.
std::vector<PlanCall> plan_calls_from_json(std::string_view json);

/// SHA-256 of what does not differ from run to run: time, status and command kind of each call.
std::string plan_calls_digest(std::span<const PlanCall> calls);

/// SHA-256 of all of a flight that does not differ from run to run: equal flights, equal digests.
std::string record_digest(const TrialRecord& record);

}  // namespace avoidbench
