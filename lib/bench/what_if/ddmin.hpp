#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace avoidbench {

using IndexSet = std::vector<std::size_t>;

/// What the test of several sets found.
struct TestedSets {
  std::optional<std::size_t> first_failing;  ///< of the sets, in their order
  bool is_cut_short = false;                 ///< no more tests can be had; not all were tried
};
using TestSets = std::function<TestedSets(const std::vector<IndexSet>&)>;

struct SmallestSet {
  IndexSet elements;
  bool is_minimal = false;  ///< without any one of them it does not fail: all were tried
};

/// A subset of `all`, which fails, that still fails, and does not without any one of its elements:
/// delta debugging's ddmin (Zeller and Hildebrandt 2002), with its parts and their complements in
/// the order of `all`. The same for whoever tests, if tests are. It need not be the smallest there
/// is: that would take all subsets.
SmallestSet smallest_failing(IndexSet all, const TestSets& test);

}  // namespace avoidbench
