#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace avoidbench::fuzz {

/// Makes a small real database: two planners, maps and missions, eight trials with specs that can
/// be flown again, trajectories, plan calls and events.
void write_sample_database(const std::filesystem::path& file);

/// Reads the file as some commands do: 0 `report`; 1 `compare` and `export`; 2 `replay`, `verify`
/// and what digests check; 3 `merge` and `run`; 4 `report --page` and `explain`. Each may throw
/// InputError, which is passed over; nothing else may happen.
inline constexpr int kCommandCount = 5;
void read_as_command_does(int command, const std::filesystem::path& file);

/// A folder in memory for this process's files, where the system has one.
std::filesystem::path scratch_folder();

void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace avoidbench::fuzz
