#include "what_if/ddmin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace avoidbench {
namespace {

IndexSet first_numbers(std::size_t count) {
  IndexSet all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

bool has_all(const IndexSet& set, const IndexSet& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](std::size_t one) {
    return std::find(set.begin(), set.end(), one) != set.end();
  });
}

/// Fails where a set has all of `needed`.
TestSets failing_with(const IndexSet& needed, std::size_t& tests, std::size_t most = 100000) {
  return [&needed, &tests, most](const std::vector<IndexSet>& sets) {
    TestedSets found;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      found.is_cut_short = ++tests > most;
      if (found.is_cut_short) return found;
      if (!has_all(sets[i], needed)) continue;
      found.first_failing = i;
      return found;
    }
    return found;
  };
}

TEST(Ddmin, FindsWhatIsNeededAndNoMore) {
  for (const IndexSet& needed :
       {IndexSet{}, IndexSet{7}, IndexSet{3, 60}, IndexSet{0, 31, 32, 63}, first_numbers(64)}) {
    std::size_t tests = 0;
    SmallestSet found = smallest_failing(first_numbers(64), failing_with(needed, tests));
    std::sort(found.elements.begin(), found.elements.end());
    EXPECT_EQ(found.elements, needed);
    EXPECT_TRUE(found.is_minimal);
    EXPECT_LT(tests, 64U * 64U);
  }
}

TEST(Ddmin, OneElementAndNone) {
  std::size_t tests = 0;
  EXPECT_EQ(smallest_failing({5}, failing_with({5}, tests)).elements, IndexSet{5});
  EXPECT_TRUE(smallest_failing({}, failing_with({}, tests)).elements.empty());
}

TEST(Ddmin, SaysThatItWasCutShort) {
  std::size_t tests = 0;
  const SmallestSet found = smallest_failing(first_numbers(64), failing_with({3, 60}, tests, 12));
  EXPECT_FALSE(found.is_minimal);
  EXPECT_TRUE(has_all(found.elements, {3, 60}));
}

/// Two ways to fail: without any one element of what is found it must not fail any more.
TEST(Ddmin, IsMinimalWhereSeveralSetsFail) {
  const auto fails = [](const IndexSet& set) {
    return has_all(set, {2, 9, 40}) || has_all(set, {11, 12});
  };
  const SmallestSet found =
      smallest_failing(first_numbers(50), [&](const std::vector<IndexSet>& sets) {
        TestedSets tested;
        const auto at = std::find_if(sets.begin(), sets.end(), fails);
        if (at != sets.end()) tested.first_failing = static_cast<std::size_t>(at - sets.begin());
        return tested;
      });
  EXPECT_TRUE(fails(found.elements));
  for (const std::size_t left_out : found.elements) {
    IndexSet less = found.elements;
    std::erase(less, left_out);
    EXPECT_FALSE(fails(less)) << "without " << left_out;
  }
}

}  // namespace
}  // namespace avoidbench
