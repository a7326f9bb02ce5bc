#include "page/flight_choice.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace avoidbench {
namespace {

enum class Rank { failure, first_success, companion, rest };

}  // namespace

std::vector<std::size_t> flight_order(std::span<const FlightCandidate> candidates) {
  std::vector<Rank> ranks(candidates.size(), Rank::rest);
  std::set<std::pair<std::size_t, std::size_t>> has_success;  // planner, map
  std::set<std::pair<std::size_t, std::int64_t>> shown;       // map, mission
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const FlightCandidate& one = candidates[i];
    if (!one.is_finished) {
      ranks[i] = Rank::failure;
    } else if (has_success.emplace(one.planner, one.map).second) {
      ranks[i] = Rank::first_success;
    }
    if (ranks[i] != Rank::rest) shown.emplace(one.map, one.mission);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool is_beside = shown.contains({candidates[i].map, candidates[i].mission});
    if (ranks[i] == Rank::rest && is_beside) ranks[i] = Rank::companion;
  }
  // How many of its rank, planner and map come before it.
  std::map<std::tuple<Rank, std::size_t, std::size_t>, std::size_t> counts;
  std::vector<std::size_t> turn(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    turn[i] = counts[{ranks[i], candidates[i].planner, candidates[i].map}]++;
  }
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(ranks[a], turn[a]) < std::pair(ranks[b], turn[b]);
  });
  return order;
}

std::size_t usual_page_bytes(std::size_t trial_count) {
  return std::clamp<std::size_t>(3000 * trial_count, 3'000'000, 15'000'000);
}

}  // namespace avoidbench
