#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sweep/limit_rule.hpp"

namespace avoidbench {

/// A trial that could be flown.
struct LimitTrial {
  std::string key;
  std::string planner;    ///< label without the field
  std::string map;        ///< map_place()
  std::size_t level = 0;  ///< of the field
  std::int64_t mission_index = 0;
};

/// Which trials of a sweep with a LimitRule are flown. All follows from results: a search that was
/// stopped and begins anew asks for the same trials again.
class LimitSearch {
 public:
  /// `trials` are all that the sweep could fly; `rule` is kept by reference.
  LimitSearch(const LimitRule& rule, std::vector<LimitTrial> trials);

  /// The trials of the next round; empty when every planner's limit is known well enough, or has
  /// taken the most trials. `successes` by key: of all rounds before; a trial without one
  /// could not be flown.
  std::vector<std::size_t> next_round(const std::map<std::string, bool>& successes);

 private:
  /// Trials of a planner at a level, in the order in which they are flown: the first mission of
  /// each map, then the second.
  struct Supply {
    std::vector<std::size_t> trials;
    std::vector<bool> is_taken;
  };
  struct Planner {
    std::vector<Supply> levels;
    std::size_t taken = 0;  ///< of all levels
    std::vector<std::size_t> rounds;
    bool is_settled = false;
  };

  std::vector<LimitCell> cells_of(const Planner& planner,
                                  const std::map<std::string, bool>& successes) const;
  /// `falls` as in LimitCurve::estimate().
  std::vector<std::size_t> levels_wanted(Planner& planner, const std::vector<LimitCell>& cells,
                                         double falls) const;
  void take(Planner& planner, std::size_t level, std::vector<std::size_t>& round) const;

  const LimitRule& rule_;
  LimitCurve curve_;
  std::vector<LimitTrial> trials_;
  std::vector<std::size_t> map_of_;          ///< of the trials
  std::map<std::string, Planner> planners_;  ///< by label without the field
};

}  // namespace avoidbench
