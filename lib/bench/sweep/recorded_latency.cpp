#include "sweep/recorded_latency.hpp"

#include <algorithm>
#include <cmath>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {
namespace {

/// The measured trial that `spec` replays.
TrialSpec replayed(TrialSpec spec) {
  spec.latency.mode = LatencyMode::measured;
  spec.latency_digest.clear();
  return spec;
}

/// Whether the database knows the mission and that nobody can fly it.
bool is_known_invalid(const Database& database, const TrialSpec& spec) {
  const std::optional<MapRow> map = database.read_map(map_key(spec));
  if (!map) return false;
  const std::vector<MissionRecord>& missions = map->record.missions;
  return std::any_of(missions.begin(), missions.end(), [&](const MissionRecord& mission) {
    return mission.index == spec.mission_index && !mission.is_valid;
  });
}

}  // namespace

std::optional<std::vector<double>> RecordedLatencies::of(const TrialSpec& spec) {
  const std::string& file = spec.latency.database;
  auto known = databases_.find(file);
  if (known == databases_.end()) {
    known = databases_.emplace(file, Database::open_for_reading(file)).first;
  }
  const std::optional<TrialRow> row = known->second.read_trial(trial_key(replayed(spec)));
  // By the key of the measured trial, not by numbers: only the same flight's times are taken.
  if (row) return recorded_latencies(replayed(spec), row->record);
  if (is_known_invalid(known->second, spec)) return std::nullopt;
  throw InputError(
      {.file = file,
       .message =
           "holds no flight of " + spec.planner.label + ", mission " +
           std::to_string(spec.mission_index) + " of map seed " + std::to_string(spec.map_seed) +
           ", with latency: {mode: measured, scale: " + nlohmann::json(spec.latency.scale).dump() +
           "} by the same planner's file: fly that first, with the same sweep"});
}

std::optional<std::vector<double>> recorded_latencies(const TrialSpec& spec,
                                                      const TrialRecord& record) {
  if (!is_measured(spec.latency)) return std::nullopt;
  std::vector<double> latencies_s;
  for (const PlanCall& call : record.plan_calls) {
    latencies_s.push_back(std::isnan(call.latency_s) ? 0.0 : call.latency_s);
  }
  return latencies_s;
}

std::string latency_digest(const std::vector<double>& latencies_s) {
  Digest digest;
  for (const double latency_s : latencies_s) digest.add(latency_s);
  return digest.hex();
}

TrialSpec without_unused_latency(TrialSpec spec) {
  const LatencySpec defaults;
  // A mode's keys hold what it uses: another `ms` in mode measured flies the same.
  if (is_measured(spec.latency)) {
    spec.latency.ms = defaults.ms;
  } else {
    spec.latency.scale = defaults.scale;
  }
  // Its digest stands for it.
  spec.latency.database.clear();
  if (spec.latency.mode != LatencyMode::replay) spec.latency_digest.clear();
  return spec;
}

bool measures_latency(const SweepSpec& sweep) {
  bool is_swept = false;
  // An axis wins over the base.
  for (const Axis& axis : sweep.axes) {
    if (axis.path != "latency.mode") continue;
    is_swept = true;
    for (const nlohmann::json& mode : axis.values) {
      if (mode == text(LatencyMode::measured)) return true;
    }
  }
  return !is_swept && sweep.base.latency.mode == LatencyMode::measured;
}

}  // namespace avoidbench
