#include "report/environment_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/check.hpp"
#include "base/json_path.hpp"
#include "maps/map_spec.hpp"
#include "metrics/map_measure.hpp"
#include "statistics/correlation.hpp"
#include "store/trial_fields.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kMapFields = "map.";

MapSummary summary_of(std::size_t index, const MapRecord& map) {
  MapSummary summary;
  summary.map = index;
  summary.mission_count = static_cast<std::int64_t>(map.missions.size());
  summary.invalid_mission_count =
      std::count_if(map.missions.begin(), map.missions.end(),
                    [](const auto& mission) { return !mission.is_valid; });
  summary.traversability_obstruction = mission_mean(
      map, [](const MissionRecord& m) { return m.difficulty.traversability_obstruction; });
  summary.view_occlusion =
      mission_mean(map, [](const MissionRecord& m) { return m.difficulty.view_occlusion; });
  summary.angle_over_length_1pm =
      mission_mean(map, [](const MissionRecord& m) { return m.difficulty.angle_over_length_1pm; });
  return summary;
}

/// Over the maps that have both values, which may be fewer for one measure than for another.
EnvironmentCorrelation correlation_of(std::string measure,
                                      const std::vector<double>& traversabilities,
                                      const std::vector<double>& values) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || std::isnan(traversabilities[i])) continue;
    x.push_back(traversabilities[i]);
    y.push_back(values[i]);
  }
  EnvironmentCorrelation result;
  result.measure = std::move(measure);
  result.map_count = static_cast<std::int64_t>(y.size());
  // No mean, no lowest: environment_summary() leaves it out.
  if (y.empty()) return result;
  result.mean = std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
  result.lowest = *std::min_element(y.begin(), y.end());
  result.highest = *std::max_element(y.begin(), y.end());
  result.pearson = pearson_correlation(x, y);
  result.spearman = spearman_correlation(x, y);
  result.pearson_interval = correlation_interval(result.pearson, y.size(), false);
  result.spearman_interval = correlation_interval(result.spearman, y.size(), true);
  return result;
}

}  // namespace

TableValue map_field(const MapRow& map, std::string_view field) {
  AB_CHECK(field.starts_with(kMapFields), field);
  // Without throwing: a spec that can't be read has no such field either.
  const nlohmann::json spec = nlohmann::json::parse(map.spec_json, nullptr, false);
  const nlohmann::json::json_pointer place = json_place(field.substr(kMapFields.size()));
  if (!spec.is_object() || !spec.contains(place)) return {};
  const nlohmann::json& value = spec.at(place);
  if (value.is_null()) return {};
  if (value.is_boolean()) return std::int64_t{value.get<bool>() ? 1 : 0};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  return value.dump();
}

EnvironmentSummary environment_summary(const SweepResult& result, const Trials& trials) {
  EnvironmentSummary summary;
  const SweepInfo sweep{.name = result.name, .spec_json = result.spec_json};
  summary.axes = axis_fields({&sweep, 1});
  std::erase_if(summary.axes,
                [](const std::string& field) { return !field.starts_with(kMapFields); });
  for (std::size_t i = 0; i < result.maps.size(); ++i) {
    summary.maps.push_back(summary_of(i, result.maps[i].record));
  }
  for (const MapCount& count : counts_by_map(trials)) {
    summary.maps[count.map].trial_count = count.trials;
    summary.maps[count.map].finished_count = count.finished;
  }
  const auto record = [&](const MapSummary& map) -> const MapRecord& {
    return result.maps[map.map].record;
  };
  // Maps without a measured traversability come last.
  const auto rank = [&](const MapSummary& map) {
    const double ratio = record(map).traversability_normalized_ratio;
    return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
  };
  // Equal ones stay in the order of the result, which is that of their keys.
  std::stable_sort(summary.maps.begin(), summary.maps.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });

  std::vector<double> traversabilities;
  for (const MapSummary& map : summary.maps) traversabilities.push_back(record(map).traversability);
  const auto add = [&](std::string measure, auto value_of) {
    std::vector<double> values;
    for (const MapSummary& map : summary.maps) values.push_back(value_of(map));
    EnvironmentCorrelation correlation =
        correlation_of(std::move(measure), traversabilities, values);
    // A measure that is the same on all maps correlates with nothing.
    if (correlation.map_count > 0 && correlation.lowest < correlation.highest) {
      summary.correlations.push_back(std::move(correlation));
    }
  };
  add("relative_gap_size", [&](const MapSummary& map) { return record(map).relative_gap_size; });
  add("obstacle_density_1pm2", [&](const MapSummary& map) {
    // Maps from files have no obstacles that are counted: their 0 is no density.
    const bool is_field = !is_from_file(result.maps[map.map].generator);
    return is_field ? record(map).obstacle_density_1pm2 : std::numeric_limits<double>::quiet_NaN();
  });
  add("free_volume_ratio", [&](const MapSummary& map) { return record(map).free_volume_ratio; });
  add("traversability_obstruction",
      [](const MapSummary& map) { return map.traversability_obstruction; });
  add("view_occlusion", [](const MapSummary& map) { return map.view_occlusion; });
  add("angle_over_length_1pm", [](const MapSummary& map) { return map.angle_over_length_1pm; });
  return summary;
}

}  // namespace avoidbench
