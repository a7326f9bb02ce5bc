#include <algorithm>
#include <cmath>

#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// In words, where a fit says nothing in numbers.
std::string fit_text(const DifficultyResponse& response) {
  if (response.is_separated) return "all or nothing";
  if (std::isnan(response.slope)) return "none";
  return response.slope > 0.0 ? "easier maps, more success" : "no rise";
}

Table difficulty_table(const SweepSummary& summary) {
  Table table{.name = "difficulty",
              .title = "Success against normalised traversability",
              .columns = {planner_column()},
              .rows = {}};
  table.columns.push_back({.name = "map_count", .header = "maps", .unit = "", .doc = ""});
  table.columns.push_back(
      {.name = "success_spearman",
       .header = "ρ",
       .unit = "",
       .doc = "success_spearman: rank correlation of the maps' success rates with their "
              "normalised traversability, with a 95 % interval; – if all maps have one rate"});
  append_bounds(table.columns, "success_spearman");
  table.columns.push_back(
      {.name = "midpoint_ratio",
       .header = "P_τ at 50 %",
       .unit = "",
       .doc = "midpoint_ratio: normalised traversability at which half of the trials would succeed "
              "(logistic fit), with a 95 % interval (Fieller); lower is better"});
  append_bounds(table.columns, "midpoint_ratio");
  table.columns.push_back({.name = "logistic_slope",
                           .header = "slope",
                           .unit = "",
                           .doc = "logistic_slope: log odds of success per unit of P_τ"});
  table.columns.push_back(machine_column("logistic_intercept"));
  table.columns.push_back({.name = "fit", .header = "fit", .unit = "", .doc = ""});
  for (const DifficultyResponse& response : summary.difficulty) {
    std::vector<Cell> row;
    append(row, summary.planners[response.planner]);
    append(row, response.map_count);
    append(row, response.spearman);
    append(row, response.spearman_interval);
    append(row, response.midpoint);
    append(row, response.midpoint_interval);
    append(row, response.slope);
    append(row, response.intercept);
    append(row, fit_text(response));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table flight_time_table(const SweepSummary& summary) {
  Table table{.name = "flight_time",
              .title = "Time to the goal, failures counted as never",
              .columns = {planner_column()},
              .rows = {}};
  table.columns.push_back({.name = "time_to_goal_25pct_s",
                           .header = "25 %",
                           .unit = "s",
                           .doc = "by when this share of all trials has reached the goal "
                                  "(Kaplan–Meier), the median with a 95 % interval; inf: never"});
  table.columns.push_back(
      {.name = "time_to_goal_50pct_s", .header = "50 %", .unit = "s", .doc = ""});
  append_bounds(table.columns, "time_to_goal_50pct_s", "s");
  table.columns.push_back(
      {.name = "time_to_goal_75pct_s", .header = "75 %", .unit = "s", .doc = ""});
  for (const FlightTimes& times : summary.flight_times) {
    std::vector<Cell> row;
    append(row, summary.planners[times.planner]);
    append(row, times.quartiles_s[0]);
    append(row, times.quartiles_s[1]);
    append(row, times.median_interval_s);
    append(row, times.quartiles_s[2]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table curve_table(const SweepSummary& summary) {
  Table table{.name = "flight_time_curve",
              .title = "Share that has reached the goal, over time",
              .columns = {planner_column()},
              .rows = {},
              .is_for_people = false};
  table.columns.push_back(
      {.name = "time_s", .header = "time", .unit = "s", .doc = "", .place = Place::key});
  table.columns.push_back({.name = "arrived_ratio", .header = "arrived", .unit = "", .doc = ""});
  append_bounds(table.columns, "arrived_ratio");
  for (const FlightTimes& times : summary.flight_times) {
    for (const SurvivalPoint& point : times.curve) {
      std::vector<Cell> row;
      append(row, summary.planners[times.planner]);
      append(row, point.time_s);
      append(row, 1.0 - point.survival);
      append(row, Interval{1.0 - point.interval.upper, 1.0 - point.interval.lower});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

void append_response_tables(std::vector<Table>& tables, const SweepSummary& summary) {
  if (!summary.difficulty.empty()) tables.push_back(difficulty_table(summary));
  tables.push_back(flight_time_table(summary));
  tables.push_back(curve_table(summary));
}

}  // namespace avoidbench
