#include "metrics/map_measure.hpp"

#include <cmath>

#include "base/check.hpp"
#include "metrics/metric_table.hpp"

namespace avoidbench {

double mission_mean(const MapRecord& map, double (*measure)(const MissionRecord&)) {
  double sum = 0.0, count = 0.0;
  for (const MissionRecord& mission : map.missions) {
    const double value = measure(mission);
    if (!mission.is_valid || std::isnan(value)) continue;
    sum += value;
    count += 1.0;
  }
  // Without any it is 0 / 0, NaN.
  return sum / count;
}

std::vector<std::string> map_measure_names() {
  std::vector<std::string> names;
  for (const MapMetricDef& metric : map_metric_table()) names.emplace_back(metric.name);
  for (const MissionMetricDef& metric : mission_metric_table()) names.emplace_back(metric.name);
  return names;
}

double map_measure(const TrialSpec& trial, std::uint64_t map_seed, std::string_view name,
                   std::int64_t mission_count) {
  const World world = make_world(trial.map, map_seed);
  const Scene scene(world);
  for (const MapMetricDef& metric : map_metric_table()) {
    // Measures of a map need no mission.
    if (metric.name == name) return metric.value(make_map_record(trial, scene, 0));
  }
  for (const MissionMetricDef& metric : mission_metric_table()) {
    if (metric.name != name) continue;
    return mission_mean(make_map_record(trial, scene, mission_count), metric.value);
  }
  // Names come from map_measure_names().
  AB_CHECK(false, name);
  return 0.0;
}

}  // namespace avoidbench
