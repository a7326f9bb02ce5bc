#include <algorithm>
#include <map>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "base/spec_json.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

json::json_pointer pointer(std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return json::json_pointer("/" + path);
}

/// Fills the digests of the latencies that trials replay.
void fill_latencies(std::vector<PlannedTrial>& trials) {
  RecordedLatencies recorded;
  for (PlannedTrial& trial : trials) {
    if (trial.setting->latency.mode != LatencyMode::replay) continue;
    if (const auto latencies_s = recorded.of(trial.spec())) {
      trial.latency_digest = latency_digest(*latencies_s);
    }
  }
}

/// `digests` are those of maps' and winds' files, by path.
void expand_axes(const SweepSpec& sweep, std::size_t axis, const json& spec,
                 std::map<std::string, std::string>& digests, std::vector<PlannedTrial>& trials) {
  if (axis < sweep.axes.size()) {
    const json::json_pointer place = pointer(sweep.axes[axis].path);
    AB_CHECK(spec.contains(place), sweep.axes[axis].path);
    for (const json& value : sweep.axes[axis].values) {
      json changed = spec;
      changed[place] = value;
      expand_axes(sweep, axis + 1, changed, digests, trials);
    }
    return;
  }
  TrialSpec trial = spec_from_json<TrialSpec>(spec);
  const auto fill_digest = [&](const std::string& file, std::string& digest) {
    if (file.empty() || !digest.empty()) return;
    std::string& known = digests[file];
    if (known.empty()) known = file_digest(file);
    digest = known;
  };
  const FileOfMap map = file_of(trial.map);
  if (map.file != nullptr) fill_digest(*map.file, *map.digest);
  fill_digest(trial.wind.field.file, trial.wind.field.file_digest);
  // Shared by all missions: 100,000 whole specs took 318 MiB.
  std::vector<std::shared_ptr<const TrialSpec>> settings;  // one a planner
  for (const PlannerChoice& planner : sweep.planners) {
    trial.planner = planner;
    settings.push_back(std::make_shared<const TrialSpec>(trial));
  }
  for (std::int64_t mission = 0; mission < sweep.trials; ++mission) {
    for (const auto& setting : settings) {
      trials.push_back({.setting = setting, .mission_index = mission, .latency_digest = {}});
    }
  }
}

}  // namespace

TrialSpec PlannedTrial::spec() const {
  TrialSpec spec = *setting;
  spec.mission_index = mission_index;
  spec.latency_digest = latency_digest;
  return spec;
}

std::vector<PlannedTrial> expand(const SweepSpec& sweep) {
  std::vector<PlannedTrial> trials;
  std::size_t count = sweep.planners.size() * static_cast<std::size_t>(sweep.trials);
  for (const Axis& axis : sweep.axes) count *= axis.values.size();
  trials.reserve(count);
  std::map<std::string, std::string> digests;
  expand_axes(sweep, 0, spec_to_json(sweep.base), digests, trials);
  fill_latencies(trials);
  return trials;
}

}  // namespace avoidbench
