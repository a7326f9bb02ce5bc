#pragma once

#include <string>
#include <vector>

#include "page/flight_page.hpp"
#include "page/page.hpp"

namespace avoidbench {

/// Throws InputError where this program has no page built in, or the file can't be written. For
/// before any work.
void check_page(const std::string& file);

/// What made a page, with the command that asked for it.
PageOrigin page_origin();

/// Writes the page and says so on stderr.
void write_page(const nlohmann::ordered_json& data, const std::string& file);

/// The page of one flight that was flown again. Opens the database by itself: a child of a process
/// must not read by its parent's handle.
void write_flight_page(const std::filesystem::path& database, const StoredTrial& stored,
                       const World& world, const TrialRecord& flown, const SeenRecorder& seen,
                       const TrialListing& listing, const std::string& file);

/// Megabytes as an option says them, or what is usual for so many trials.
std::size_t page_bytes(double limit_mb, std::size_t trial_count);

/// The runs that flew a sweep, each once, the first one first.
std::vector<RunRow> runs_of(const Database& database, const SweepInfo& sweep);

}  // namespace avoidbench
