#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

class Statement;

/// The outcome in a column of the present row. Throws InputError for one that there is not.
Outcome outcome_of(const Statement& row, int column);

/// The tables that a field's expression may name: trials t, planners p, maps m, missions i, runs r.
inline constexpr std::string_view kTrialTables =
    " FROM sweep_trials s JOIN trials t USING (trial_key) JOIN planners p USING (planner_key) "
    "JOIN maps m ON m.map_key = t.map_key JOIN runs r USING (run_id) JOIN missions i ON "
    "i.map_key = t.map_key AND i.mission_index = t.mission_index";

/// `, t.a, t.b` for the metrics a and b.
std::string metric_columns(const Database& db);
/// Their values in the present row, from this column on.
std::vector<double> metrics_of(const Database& db, const Statement& row, int first_column);

/// SQL for each field, a comma before each. A field is
/// - a column of the view trial_table or a metric: `planner`, `traversability`, `outcome`;
/// - any value of the trial's spec by its path: `map.poisson_radius_m`, `wind.mean_world_mps.0`,
///   `planner.horizon_m` for a planner's parameter; `sensor` and `vehicle` mean their names.
/// Throws InputError for any other name.
std::string field_columns(const Database& db, const std::vector<std::string>& fields);

/// A field's path as SQLite writes it: `$."sensor"."cameras"[0]."fov_x_deg"`.
std::string sql_json_path(std::string_view field);

/// The seed of the map, which has a column of its own wherever axes have one.
inline constexpr std::string_view kSeedField = "map_seed";

/// What these sweeps vary, as fields, in order, each once: the paths of their axes, and the
/// parameters to which they give a planner several values. Paths that no program of ours writes are
/// left out, and those beyond 200.
std::vector<std::string> axis_fields(std::span<const SweepInfo> sweeps);

/// `, EXPRESSION AS "PATH"` for each of these fields but the map's seed.
std::string axis_columns(const Database& db, const std::vector<std::string>& axes);

/// What of `fields` a sweep varies, with the values, as words: "poisson_radius_m 3.5, ms 40".
/// Without the map's seed and planners' parameters.
std::string setting_text(const std::vector<std::string>& fields,
                         const std::vector<TableValue>& values,
                         const std::vector<std::string>& axes);

/// Throws InputError, with the nearest path that there is, when no trial of `result` has field
/// number `field`: the path was misspelled.
void refuse_empty_field(const Database& db, const SweepResult& result, std::size_t field);
/// The same of trials that were listed with a field called `name`.
void refuse_empty_field(const Database& db, const std::vector<TrialListing>& trials,
                        std::size_t field, const std::string& name);

}  // namespace avoidbench
