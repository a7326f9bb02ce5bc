#pragma once

#include <nlohmann/json.hpp>

#include "compare/compare.hpp"
#include "page/flight_reading.hpp"
#include "page/page.hpp"

namespace avoidbench {

/// One side of a comparison. Without a database, of a committed table, there are no flights.
struct ComparedSide {
  const TrialTable* table = nullptr;
  PageDatabase database = {};
};

/// The data of a page of a comparison of these two: what changed, every pair of trials with both
/// outcomes, and the flights of both sides of as many pairs as fit into `limit_bytes`: first those
/// that were lost, won, or failed in another way, then those that failed in the same way, then the
/// others. What is not a flight stays; where it alone takes more, a warning says so.
nlohmann::ordered_json comparison_page(const Comparison& comparison, const ComparedSide& base,
                                       const ComparedSide& now, const PageOrigin& origin,
                                       std::size_t limit_bytes);

}  // namespace avoidbench
