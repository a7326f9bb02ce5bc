#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/input_error.hpp"
#include "statistics/stop_rule.hpp"
#include "sweep/limit_rule.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// One swept field: every value is tried with every value of the other axes.
struct Axis {
  std::string
      path;  ///< dotted, of TrialSpec: "map.poisson_radius_m", "map_seed", "wind.mean_world_mps"
  std::vector<nlohmann::json> values;  ///< at least one, checked against the field's type and range
};

/// A mission that the sweep lists itself.
struct ListedMission {
  std::string map;  ///< of which it is, see map_names(); "": of every map
  Mission mission;
  InputProblem place;  ///< where it stands, without a message
};

/// A sweep: base × axes × missions × planners.
struct SweepSpec {
  std::string name;
  TrialSpec base;  ///< base.planner is not used
  std::vector<Axis> axes;
  std::int64_t trials = 10;             ///< missions per map; the same ones for every planner
  std::vector<ListedMission> missions;  ///< the first `trials` of a map are flown; empty: made
  std::vector<PlannerChoice> planners;  ///< resolved and checked; labels are unique
  StopRule until;                       ///< when a planner has flown enough
  LimitRule limit;                      ///< what `avoidbench limit` looks for
  std::vector<std::string> warnings;    ///< for people: what was read otherwise than written
};

/// The fields that a file says plainly, those of the base on the same level; config/sweep_keys.cpp
/// has the other keys.
template <class Visitor, ConstOr<SweepSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("sweep", s.name, "Name of the result set: A-Z a-z 0-9 _ . -");
  v.field("trials", s.trials, Range{1, 1e6}, "Missions per map, the same for every planner.");
  visit(v, s.base);
}

/// One trial of a sweep: a setting and a mission of it. Sweeps of many trials hold few settings, so
/// that one takes a hundred bytes instead of a whole spec.
struct PlannedTrial {
  std::shared_ptr<const TrialSpec> setting;  ///< everything but the mission; never null
  std::int64_t mission_index = 0;
  std::string latency_digest;  ///< of the times that a replay takes

  const std::string& planner_label() const { return setting->planner.label; }
  TrialSpec spec() const;
};

/// Version of everything that results follow from: part of every key. Raised with each change
/// announced as "Results change" in CHANGELOG.md.
inline constexpr int kResultVersion = 1;

/// The sweep's trials, in order of axes (first slowest), mission index, planner. Fills the
/// file_digest of maps and winds from files that lack it, the latency_digest of trials that replay
/// and the missions_digest where missions are listed, and settles the vehicle (capability.hpp);
/// throws InputError where such a file can't be read or lacks what is replayed.
std::vector<PlannedTrial> expand(const SweepSpec& sweep);

/// A trial's key, 64 hexadecimal digits: digest of its canonical spec (with the digests of
/// the planner, of the map's and the wind's file and of replayed latencies, without paths) and
/// kResultVersion.
std::string trial_key(const TrialSpec& spec);

/// The key of the map as this trial flies it (map, its seed, the sweep's seed, mission rules, body,
/// kResultVersion).
std::string map_key(const TrialSpec& spec);

}  // namespace avoidbench
