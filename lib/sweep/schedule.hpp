#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "metrics/map_record.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// One map of a sweep and its trials that are still to be flown.
struct MapPlan {
  std::string key;
  TrialSpec spec;  ///< of one of its trials: map, seeds, rules and body are the same in all
  std::optional<MapRecord> record;   ///< once measured
  bool is_requested = false;         ///< a worker is measuring it
  std::vector<std::size_t> waiting;  ///< trials not handed out yet, the next one last
};

/// What there is to do, and what of it is done. Plain data; the functions below change it.
struct Schedule {
  std::vector<TrialSpec> trials;
  std::vector<std::string> keys;    ///< of the trials
  std::vector<std::size_t> map_of;  ///< the trials' maps
  std::vector<MapPlan> maps;
  std::size_t done_before = 0;  ///< finished in the database when the run began
};

Schedule make_schedule(std::vector<TrialSpec> trials, const std::set<std::string>& finished_keys);

/// One job: measure `map`, or fly `trial` on it.
struct Assignment {
  std::size_t map = 0;
  std::optional<std::size_t> trial;
};

/// The next job for a worker that last had `preferred_map` in memory: a trial there, else a map
/// that nobody has measured, else a trial of the map with most of them waiting; nothing when all
/// that is left waits for other workers.
std::optional<Assignment> next_assignment(Schedule& schedule,
                                          std::optional<std::size_t> preferred_map);

}  // namespace avoidbench
