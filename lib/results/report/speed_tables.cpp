#include "report/speed_tables.hpp"

#include <cmath>

#include "base/number_text.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

void append_estimate(Row& row, const Estimate& estimate, bool is_best = false) {
  append(row, best_cell(estimate.value, is_best));
  append(row, estimate.interval);
}

Row speed_row(const SweepSummary& summary, const PlannerSpeeds& speeds) {
  Row row = make_row(summary.planners[speeds.planner], speeds.trial_count);
  append_estimate(row, speeds.v90, speeds.is_best);
  append_estimate(row, speeds.v50);
  append_estimate(row, speeds.mean);
  append(row, make_row(speeds.crash_count, speeds.flown_km));
  append_estimate(row, speeds.crashes_per_km);
  return row;
}

}  // namespace

Table speed_table(const SweepSummary& summary) {
  Table table = make_table(
      "speed", "Speed at which missions are completed",
      {planner_column(),
       {.name = "trial_count", .header = "trials"},
       {.name = "v90_mps",
        .header = "v90",
        .unit = "m/s",
        .doc = "v90_mps: the goal velocity (shortest path over flight time, 0 for a failure) that "
               "nine missions of ten reach, with a 95 % interval for maps like these; 0 where "
               "more than one mission of ten failed; – for fewer than 29 missions",
        .has_interval = true,
        .brief = "goal velocity that nine missions of ten reach [95 % interval]"},
       {.name = "v50_mps",
        .header = "v50",
        .unit = "m/s",
        .doc = "v50_mps: the same for half of the missions",
        .has_interval = true,
        .brief = "the same for half of them"},
       {.name = "v_mean_mps",
        .header = "v mean",
        .unit = "m/s",
        .doc = "v_mean_mps: mean goal velocity of all missions, failures as 0",
        .has_interval = true,
        .brief = "goal velocity, failures as 0"},
       machine_column("crash_count"),
       machine_column("flown_km", "km"),
       {.name = "crashes_per_km",
        .header = "crashes",
        .unit = "1/km",
        .doc =
            "crashes_per_km: collisions per flown kilometre, with an exact 95 % Poisson interval "
            "(as if flights were independent)",
        .has_interval = true,
        .brief = "per flown km"}});
  for (const PlannerSpeeds& speeds : summary.speeds) {
    table.rows.push_back(speed_row(summary, speeds));
  }
  return table;
}

Table speed_curve_table(const SweepSummary& summary) {
  Table table =
      make_table("speed_curve", "Share of missions completed with at least a goal velocity, S(v)",
                 {planner_column(),
                  {.name = "goal_velocity_mps", .header = "v", .unit = "m/s", .place = Place::key},
                  {.name = "reached_share", .header = "S", .has_interval = true}});
  for (const PlannerSpeeds& speeds : summary.speeds) {
    for (const SpeedStep& step : speeds.curve) {
      table.rows.push_back(
          make_row(summary.planners[speeds.planner], step.speed_mps, step.share, step.interval));
    }
  }
  return table;
}

std::vector<std::string> speed_warnings(const SweepSummary& summary) {
  std::vector<std::string> few, failing, warnings;
  for (std::size_t i = 0; i < summary.speeds.size(); ++i) {
    const Estimate& v90 = summary.speeds[i].v90;
    const std::string& label = summary.planners[summary.speeds[i].planner];
    if (std::isnan(v90.value)) few.push_back(label);
    if (v90.value == 0.0) {
      failing.push_back(label + " (" + fixed_digits(100.0 * summary.overall[i].success_rate, 1) +
                        " %)");
    }
  }
  if (!few.empty()) {
    warnings.push_back("no v90 of " + joined(few, ", ") + ": it needs at least " +
                       std::to_string(least_trials_for(kReachedShare)) + " missions");
  }
  if (!failing.empty()) {
    warnings.push_back("v90 is 0 for " + joined(failing, ", ") +
                       ": fewer than nine missions of ten were completed");
  }
  std::vector<std::string> best;
  for (const BestSetting& setting : summary.best_settings) {
    best.push_back(summary.planners[summary.speeds[setting.best].planner] + " is the best of " +
                   std::to_string(setting.setting_count) + " settings");
  }
  if (!best.empty()) {
    warnings.push_back(joined(best) +
                       ": choosing makes its v90 too high; choose the setting on other maps");
  }
  return warnings;
}

}  // namespace avoidbench
