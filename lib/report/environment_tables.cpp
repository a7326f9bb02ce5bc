#include <nlohmann/json.hpp>

#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// A number of the map's spec, NaN where it has none of this name.
double spec_number(const MapRow& map, const char* name) {
  const nlohmann::json spec = nlohmann::json::parse(map.spec_json, nullptr, false);
  if (!spec.is_object() || !spec.contains(name) || !spec[name].is_number()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return spec[name].get<double>();
}

Table map_table(const SweepSummary& summary) {
  Table table{.name = "maps",
              .title = "Maps, hard ones first",
              .columns = {},
              .rows = {},
              .is_for_people = false};
  std::vector<Column>& columns = table.columns;
  columns.push_back({.name = "map", .header = "map", .unit = "", .doc = "", .place = Place::key});
  columns.push_back({.name = "map_seed", .header = "seed", .unit = "", .doc = ""});
  columns.push_back({.name = "poisson_radius_m", .header = "radius", .unit = "m", .doc = ""});
  columns.push_back({.name = "obstacle_count", .header = "obstacles", .unit = "", .doc = ""});
  columns.push_back(
      {.name = "traversability",
       .header = "TRAV",
       .unit = "",
       .doc = "traversability: mean free flight distance, in diagonals of the vehicle"});
  columns.push_back({.name = "traversability_normalized_ratio",
                     .header = "P_τ",
                     .unit = "",
                     .doc = "the same as a share of that of an empty map"});
  columns.push_back(
      {.name = "relative_gap_size",
       .header = "RGS",
       .unit = "",
       .doc = "relative_gap_size: gap between obstacles, in diagonals of the vehicle"});
  columns.push_back(
      {.name = "obstacle_density_1pm2", .header = "density", .unit = "1/m²", .doc = ""});
  columns.push_back({.name = "traversability_obstruction",
                     .header = "TO",
                     .unit = "",
                     .doc = "means of the missions' traversability obstruction, view occlusion and "
                            "angle over length (FlightBench)"});
  columns.push_back({.name = "view_occlusion", .header = "VO", .unit = "", .doc = ""});
  columns.push_back({.name = "angle_over_length_1pm", .header = "AOL", .unit = "1/m", .doc = ""});
  columns.push_back({.name = "mission_count", .header = "missions", .unit = "", .doc = ""});
  columns.push_back(machine_column("invalid_mission_count"));
  columns.push_back({.name = "trial_count", .header = "trials", .unit = "", .doc = ""});
  columns.push_back({.name = "finished_count", .header = "finished", .unit = "", .doc = ""});
  for (const MapSummary& map : summary.environment.maps) {
    const MapRow& of_map = summary.maps[map.map];
    std::vector<Cell> row;
    append(row, of_map.generator + " " + of_map.record.key.substr(0, 6));
    row.push_back({.value = of_map.map_seed});
    append(row, spec_number(of_map, "poisson_radius_m"));
    append(row, of_map.record.obstacle_count);
    append(row, of_map.record.traversability);
    append(row, of_map.record.traversability_normalized_ratio);
    append(row, of_map.record.relative_gap_size);
    append(row, of_map.record.obstacle_density_1pm2);
    append(row, map.traversability_obstruction);
    append(row, map.view_occlusion);
    append(row, map.angle_over_length_1pm);
    append(row, map.mission_count);
    append(row, map.invalid_mission_count);
    append(row, map.trial_count);
    append(row, map.finished_count);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table correlation_table(const SweepSummary& summary) {
  Table table{.name = "environment",
              .title = "How measures of maps correlate with their traversability",
              .columns = {},
              .rows = {},
              .is_for_people = false};
  table.columns.push_back(
      {.name = "measure", .header = "measure", .unit = "", .doc = "", .place = Place::key});
  table.columns.push_back({.name = "map_count", .header = "maps", .unit = "", .doc = ""});
  for (const char* name : {"mean", "lowest", "highest"}) {
    table.columns.push_back({.name = name,
                             .header = name,
                             .unit = "",
                             .doc = "",
                             .place = Place::value,
                             .decimals = 3});
  }
  table.columns.push_back({.name = "pearson",
                           .header = "Pearson r",
                           .unit = "",
                           .doc = "correlations over maps, with 95 % intervals (Fisher's z)"});
  append_bounds(table.columns, "pearson");
  table.columns.push_back({.name = "spearman", .header = "Spearman ρ", .unit = "", .doc = ""});
  append_bounds(table.columns, "spearman");
  for (const EnvironmentCorrelation& correlation : summary.environment.correlations) {
    std::vector<Cell> row;
    append(row, correlation.measure);
    append(row, correlation.map_count);
    append(row, correlation.mean);
    append(row, correlation.lowest);
    append(row, correlation.highest);
    append(row, correlation.pearson);
    append(row, correlation.pearson_interval);
    append(row, correlation.spearman);
    append(row, correlation.spearman_interval);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void append_environment_tables(std::vector<Table>& tables, const SweepSummary& summary) {
  tables.push_back(map_table(summary));
  if (!summary.environment.correlations.empty()) tables.push_back(correlation_table(summary));
}

}  // namespace avoidbench
