#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "maps/map_spec.hpp"
#include "report/sweep_tables.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A number of the map's spec, NaN where it has none of this name.
double spec_number(const MapRow& map, const char* name) {
  // Without throwing: a spec that can't be read has no such number either.
  const nlohmann::json spec = nlohmann::json::parse(map.spec_json, nullptr, false);
  if (!spec.is_object() || !spec.contains(name) || !spec[name].is_number()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return spec[name].get<double>();
}

/// Takes out the column if it has no value: it means nothing for these maps.
void drop_if_empty(Table& table, std::string_view name) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const Column& one) { return one.name == name; });
  const auto at = column - table.columns.begin();
  const bool is_empty = std::all_of(table.rows.begin(), table.rows.end(), [&](const Row& row) {
    // make_row() makes no value of NaN.
    return std::holds_alternative<std::monostate>(row[static_cast<std::size_t>(at)].value);
  });
  if (!is_empty || table.rows.empty()) return;
  table.columns.erase(column);
  for (Row& row : table.rows) row.erase(row.begin() + at);
}

}  // namespace

Table map_table(const SweepSummary& summary) {
  Table table = make_table(
      "maps", "Maps, hard ones first",
      {{.name = "map", .place = Place::key},
       {.name = "map_seed", .header = "seed"},
       {.name = "poisson_radius_m", .header = "radius", .unit = "m"},
       {.name = "obstacle_count", .header = "obstacles"},
       {.name = "traversability",
        .header = "TRAV",
        .doc = "traversability: mean free flight distance, in diagonals of the vehicle"},
       {.name = "traversability_normalized_ratio",
        .header = "P_τ",
        .doc = "the same as a share of that of an empty map"},
       {.name = "relative_gap_size",
        .header = "RGS",
        .doc = "relative_gap_size: gap between obstacles, in diagonals of the vehicle"},
       {.name = "obstacle_density_1pm2", .header = "density", .unit = "1/m²"},
       {.name = "traversability_obstruction",
        .header = "TO",
        .doc = "means of the missions' traversability obstruction, view occlusion and angle over "
               "length (FlightBench)"},
       {.name = "view_occlusion", .header = "VO"},
       {.name = "angle_over_length_1pm", .header = "AOL", .unit = "1/m"},
       {.name = "mission_count", .header = "missions"},
       machine_column("invalid_mission_count"),
       {.name = "trial_count", .header = "trials"},
       {.name = "finished_count", .header = "finished"}});
  // Only in formats for programs, unless it is asked for by name.
  table.is_for_people = false;
  for (const MapSummary& map : summary.environment.maps) {
    const MapRow& row = summary.maps[map.map];
    const MapRecord& record = row.record;
    const bool is_field = !is_from_file(row.generator);
    const Cell count{.value = is_field ? TableValue(record.obstacle_count) : TableValue()};
    table.rows.push_back(
        // Several generators' maps may have one seed.
        make_row(row.generator + " " + record.key.substr(0, 6), row.map_seed,
                 spec_number(row, "poisson_radius_m"), count, record.traversability,
                 record.traversability_normalized_ratio, record.relative_gap_size,
                 is_field ? record.obstacle_density_1pm2 : kNone, map.traversability_obstruction,
                 map.view_occlusion, map.angle_over_length_1pm, map.mission_count,
                 map.invalid_mission_count, map.trial_count, map.finished_count));
  }
  // Maps of other generators than the original's have no such number.
  for (const char* name :
       {"poisson_radius_m", "obstacle_count", "relative_gap_size", "obstacle_density_1pm2"}) {
    drop_if_empty(table, name);
  }
  return table;
}

Table correlation_table(const SweepSummary& summary) {
  Table table =
      make_table("environment", "How measures of maps correlate with their traversability",
                 {{.name = "measure", .place = Place::key},
                  {.name = "map_count", .header = "maps"},
                  {.name = "mean", .decimals = 3},
                  {.name = "lowest", .decimals = 3},
                  {.name = "highest", .decimals = 3},
                  {.name = "pearson",
                   .header = "Pearson r",
                   .doc = "correlations over maps, with 95 % intervals (Fisher's z)",
                   .has_interval = true},
                  {.name = "spearman", .header = "Spearman ρ", .has_interval = true}});
  table.is_for_people = false;
  for (const EnvironmentCorrelation& c : summary.environment.correlations) {
    table.rows.push_back(make_row(c.measure, c.map_count, c.mean, c.lowest, c.highest, c.pearson,
                                  c.pearson_interval, c.spearman, c.spearman_interval));
  }
  return table;
}

}  // namespace avoidbench
