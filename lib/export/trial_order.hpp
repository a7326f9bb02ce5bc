#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "store/rows.hpp"

namespace avoidbench {

/// Which trials of many are listed or exported, and in which order.
struct TrialOrder {
  std::string field = {};            ///< a metric or another field of trials; "": as they are
  std::optional<std::size_t> limit;  ///< at most so many, the first ones
};

/// The places of `values` in order: of a metric the worst first (where more is better the least),
/// of other fields the least first; what has no value last; of equals as they are.
std::vector<std::size_t> worst_first(const std::vector<TableValue>& values, Better better);

/// Of a metric what is better; Better::more for other fields, so that the least comes first.
Better better_of(const std::string& field, const std::vector<MetricRow>& metrics);

}  // namespace avoidbench
