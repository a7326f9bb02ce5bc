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
void fill_latencies(std::vector<TrialSpec>& trials) {
  RecordedLatencies recorded;
  for (TrialSpec& trial : trials) {
    if (trial.latency.mode != LatencyMode::replay) continue;
    if (const auto latencies_s = recorded.of(trial)) {
      trial.latency_digest = latency_digest(*latencies_s);
    }
  }
}

/// `digests` are those of maps' and winds' files, by path.
void expand_axes(const SweepSpec& sweep, std::size_t axis, const json& spec,
                 std::map<std::string, std::string>& digests, std::vector<TrialSpec>& trials) {
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
  for (trial.mission_index = 0; trial.mission_index < sweep.trials; ++trial.mission_index) {
    for (const PlannerChoice& planner : sweep.planners) {
      trial.planner = planner;
      trials.push_back(trial);
    }
  }
}

}  // namespace

std::vector<TrialSpec> expand(const SweepSpec& sweep) {
  std::vector<TrialSpec> trials;
  std::size_t count = sweep.planners.size() * static_cast<std::size_t>(sweep.trials);
  for (const Axis& axis : sweep.axes) count *= axis.values.size();
  trials.reserve(count);
  std::map<std::string, std::string> digests;
  expand_axes(sweep, 0, spec_to_json(sweep.base), digests, trials);
  fill_latencies(trials);
  return trials;
}

}  // namespace avoidbench
