#include <cmath>

#include "report/sweep_tables.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// In words, where a fit says nothing in numbers.
std::string fit_text(const DifficultyResponse& response) {
  if (response.is_separated) return "all or nothing";
  if (std::isnan(response.slope)) return "none";
  return response.slope > 0.0 ? "easier maps, more success" : "no rise";
}

}  // namespace

Table difficulty_table(const SweepSummary& summary) {
  Table table = make_table(
      "difficulty", "Success against normalised traversability",
      {planner_column(),
       {.name = "map_count", .header = "maps"},
       {.name = "success_spearman",
        .header = "ρ",
        .doc = "success_spearman: rank correlation of the maps' success rates with their "
               "normalised traversability, with a 95 % interval; – if all maps have one rate",
        .has_interval = true},
       {.name = "midpoint_ratio",
        .header = "P_τ at 50 %",
        .doc = "midpoint_ratio: normalised traversability at which half of the trials would "
               "succeed (logistic fit), with a 95 % interval (Fieller); lower is better",
        .has_interval = true},
       {.name = "logistic_slope",
        .header = "slope",
        .doc = "logistic_slope: log odds of success per unit of P_τ"},
       machine_column("logistic_intercept"),
       {.name = "fit"}});
  for (const DifficultyResponse& r : summary.difficulty) {
    table.rows.push_back(make_row(summary.planners[r.planner], r.map_count, r.spearman,
                                  r.spearman_interval, r.midpoint, r.midpoint_interval, r.slope,
                                  r.intercept, fit_text(r)));
  }
  return table;
}

Table flight_time_table(const SweepSummary& summary) {
  Table table = make_table(
      "flight_time", "Time to the goal, failures counted as never",
      {planner_column(),
       {.name = "time_to_goal_25pct_s",
        .header = "25 %",
        .unit = "s",
        .doc = "by when this share of all trials has reached the goal (Kaplan–Meier), the median "
               "with a 95 % interval; inf: never"},
       {.name = "time_to_goal_50pct_s", .header = "50 %", .unit = "s", .has_interval = true},
       {.name = "time_to_goal_75pct_s", .header = "75 %", .unit = "s"}});
  for (const FlightTimes& times : summary.flight_times) {
    table.rows.push_back(make_row(summary.planners[times.planner], times.quartiles_s[0],
                                  times.quartiles_s[1], times.median_interval_s,
                                  times.quartiles_s[2]));
  }
  return table;
}

Table flight_time_curve_table(const SweepSummary& summary) {
  Table table = make_table("flight_time_curve", "Share that has reached the goal, over time",
                           {planner_column(),
                            {.name = "time_s", .header = "time", .unit = "s", .place = Place::key},
                            {.name = "arrived_ratio", .header = "arrived", .has_interval = true}});
  table.is_for_people = false;
  for (const FlightTimes& times : summary.flight_times) {
    for (const SurvivalPoint& point : times.curve) {
      table.rows.push_back(make_row(summary.planners[times.planner], point.time_s,
                                    // From "not yet" to "arrived", which turns the interval's ends
                                    // around.
                                    1.0 - point.survival, 1.0 - point.interval.upper,
                                    1.0 - point.interval.lower));
    }
  }
  return table;
}

}  // namespace avoidbench
