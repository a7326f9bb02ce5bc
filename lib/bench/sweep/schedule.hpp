#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "metrics/map_record.hpp"
#include "sweep/shard.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {

/// The trials of this part: whole groups of a planner on a map, dealt in the order of their
/// digests, or single trials where there are too few groups. The same for whoever asks, whatever is
/// flown.
std::vector<PlannedTrial> trials_of(const Shard& shard, std::vector<PlannedTrial> trials);

/// The trials of one planner on one map that are still to be flown: what one worker process flies,
/// since a process flies one planner only.
struct TrialGroup {
  std::string planner_label;
  std::vector<std::size_t> waiting;  ///< not handed out yet, the next one last
};

/// One map of a sweep and its trials that are still to be flown.
struct MapPlan {
  std::string key;
  TrialSpec spec;  ///< of one of its trials: map, seeds, rules and body are the same in all
  std::optional<MapRecord> record;  ///< once measured
  bool is_requested = false;        ///< a worker is measuring it
  std::vector<TrialGroup> groups;   ///< one per planner, in the sweep's order
};

/// Trials of this map that are not handed out yet.
std::size_t waiting_count(const MapPlan& map);

/// Those of this planner; the group is made where there is none.
TrialGroup& group_of(MapPlan& map, const std::string& planner_label);

/// What there is to do, and what of it is done. Plain data; the functions below change it.
/// Invariant: a trial is in one `waiting` list, handed out, or settled; next_assignment() takes it
/// out. Trials of a map without a record are never handed out.
struct Schedule {
  std::vector<PlannedTrial> trials;
  std::vector<std::string> keys;    ///< of the trials
  std::vector<std::size_t> map_of;  ///< the trials' maps
  std::vector<MapPlan> maps;
  std::size_t done_before = 0;  ///< finished in the database when the run began
};

Schedule make_schedule(std::vector<PlannedTrial> trials,
                       const std::set<std::string>& finished_keys);

/// Adds a trial by a number of the caller's, on a map that need not be measured: what is stored
/// waits so to be flown again. To be called for trials from the last to the first.
void add_waiting(Schedule& schedule, std::size_t trial, const std::string& map_key,
                 const std::string& planner_label);

/// One job: measure `map`, or fly `trial` on it.
struct Assignment {
  std::size_t map = 0;
  std::optional<std::size_t> trial;
};

/// The next job for a worker with this in memory: a trial of its planner on its map, else one of
/// another planner there, else a map that nobody has measured, else a trial of the largest group;
/// nothing when all that is left waits for other workers.
std::optional<Assignment> next_assignment(Schedule& schedule, const Memory& memory);

/// The planner whose trials a worker that has measured this map gets first; "" where none is left.
std::string first_planner(const Schedule& schedule, std::size_t map);

}  // namespace avoidbench
