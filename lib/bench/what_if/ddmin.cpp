#include "what_if/ddmin.hpp"

#include <algorithm>

namespace avoidbench {
namespace {

/// The set cut into `count` parts of about one size.
std::vector<IndexSet> parts_of(const IndexSet& all, std::size_t count) {
  std::vector<IndexSet> parts;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](std::size_t part) {
      return all.begin() + static_cast<std::ptrdiff_t>(part * all.size() / count);
    };
    parts.emplace_back(at(i), at(i + 1));
  }
  return parts;
}

/// All but each part.
std::vector<IndexSet> complements_of(const std::vector<IndexSet>& parts) {
  std::vector<IndexSet> complements;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    IndexSet rest;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (k != i) rest.insert(rest.end(), parts[k].begin(), parts[k].end());
    }
    complements.push_back(std::move(rest));
  }
  return complements;
}

}  // namespace

SmallestSet smallest_failing(IndexSet all, const TestSets& test) {
  if (all.empty()) return {.elements = {}, .is_minimal = true};
  const TestedSets of_none = test({IndexSet{}});
  if (of_none.first_failing) return {.elements = {}, .is_minimal = true};
  if (of_none.is_cut_short) return {.elements = std::move(all), .is_minimal = false};
  std::size_t count = 2;
  while (all.size() > 1) {
    count = std::min(count, all.size());
    const std::vector<IndexSet> parts = parts_of(all, count);
    // Of two parts each is the other's complement.
    std::vector<IndexSet> tried = parts;
    if (count > 2) {
      const std::vector<IndexSet> rests = complements_of(parts);
      tried.insert(tried.end(), rests.begin(), rests.end());
    }
    const TestedSets found = test(tried);
    if (found.first_failing) {
      const bool is_part = *found.first_failing < parts.size();
      all = tried[*found.first_failing];
      count = is_part ? 2 : std::max<std::size_t>(count - 1, 2);
    } else if (found.is_cut_short) {
      return {.elements = std::move(all), .is_minimal = false};
    } else if (count == all.size()) {
      break;
    } else {
      count = 2 * count;
    }
  }
  return {.elements = std::move(all), .is_minimal = true};
}

}  // namespace avoidbench
