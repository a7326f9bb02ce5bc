#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace avoidbench {

/// A trial whose flight may be put into a page.
struct FlightCandidate {
  std::size_t planner = 0, map = 0;
  std::int64_t mission = 0;
  bool is_finished = false;
};

/// In which order flights are put into a page until it is full: all failures, one success a map and
/// planner, the other planners' flights of the missions that are then there, the rest. Of each of
/// these first one a map and planner, then the second ones, and so on, so that a full page has
/// something of everything. Indices into `candidates`.
std::vector<std::size_t> flight_order(std::span<const FlightCandidate> candidates);

/// How large a page with so many trials may get, bytes: 3 MB for each thousand, at least 3 MB and
/// at most 15 MB.
std::size_t usual_page_bytes(std::size_t trial_count);

}  // namespace avoidbench
