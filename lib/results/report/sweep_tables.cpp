#include "report/sweep_tables.hpp"

#include <algorithm>
#include <cmath>

#include "base/json_path.hpp"
#include "base/math.hpp"
#include "base/words.hpp"
#include "explain/causes.hpp"
#include "maps/map_spec.hpp"
#include "report/speed_tables.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// A metric's name without unit.
std::string bare_name(const MetricRow& metric) {
  // Longer suffixes first where one ends with another: _ms and _mps before _s, _1pm before _m.
  for (const std::string_view suffix :
       {"_pct", "_ratio", "_mps", "_ms", "_1pm", "_m", "_s", "_j"}) {
    if (metric.name.ends_with(suffix))
      return metric.name.substr(0, metric.name.size() - suffix.size());
  }
  return metric.name;
}

/// Short headers of the usual metrics; others stand with their name without unit.
std::string short_header(const MetricRow& metric) {
  constexpr std::pair<std::string_view, std::string_view> kShort[] = {
      {"path_optimality_pct", "PO"},        {"energy_optimality", "EO"},
      {"average_goal_velocity_mps", "AGV"}, {"mission_progress_pct", "MP"},
      {"processing_time_ms", "PT"},         {"processing_wall_time_ms", "WT"}};
  for (const auto& [name, header] : kShort) {
    if (metric.name == name) return std::string(header);
  }
  return bare_name(metric);
}

/// "path optimality"; nothing where that is the header.
std::string metric_brief(const MetricRow& metric) {
  std::string name = bare_name(metric);
  if (name == short_header(metric)) return "";
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string metric_doc(const MetricRow& metric) {
  std::string doc = metric.name + ": " + metric.doc;
  if (doc.ends_with('.')) doc.pop_back();
  doc += metric.population == Population::finished ? "; mean of finished trials"
                                                   : "; mean of all trials";
  if (metric.better != Better::neither)
    doc += ", " + std::string(text(metric.better)) + " is better";
  if (metric.is_measured) doc += "; differs from run to run";
  return doc;
}

/// `keys`, then the columns of a summary.
std::vector<Column> summary_columns(std::vector<Column> keys, std::span<const MetricRow> metrics) {
  // Columns come as summary_cells() gives the cells.
  keys.insert(keys.end(),
              {{.name = "trial_count", .header = "trials"},
               machine_column("finished_count"),
               {.name = "success_rate",
                .header = "SR",
                .doc = "success_rate: finished of all trials, with a 95 % interval: Wilson's, from "
                       "five maps on widened by the differences between maps",
                .has_interval = true,
                .brief = "success rate [95 % interval]"}});
  for (const MetricRow& metric : metrics) {
    keys.push_back({.name = metric.name,
                    .header = short_header(metric),
                    .unit = metric.unit,
                    .doc = metric_doc(metric),
                    .has_interval = true,
                    .brief = metric_brief(metric)});
    keys.push_back(machine_column(metric.name + "_std", metric.unit));
    keys.push_back(machine_column(metric.name + "_count"));
  }
  return keys;
}

Row summary_cells(const PlannerSummary& planner) {
  Row row = make_row(planner.trial_count, planner.finished_count);
  append(row, best_cell(planner.success_rate, planner.is_best_rate));
  append(row, planner.success_interval);
  for (const MetricMean& mean : planner.means) {
    append(row, best_cell(mean.mean, mean.is_best));
    append(row, make_row(mean.interval, mean.standard_deviation, mean.count));
  }
  return row;
}

Table planner_table(const SweepSummary& summary) {
  Table table = make_table(
      "planners", "Planners",
      summary_columns({planner_column(), machine_column("planner_version")}, summary.metrics));
  for (const PlannerSummary& planner : summary.overall) {
    table.rows.push_back(make_row(summary.planners[planner.planner],
                                  summary.planner_versions[planner.planner],
                                  summary_cells(planner)));
  }
  return table;
}

/// A table of groups or sweeps: the means' intervals are left to machines, since there are few maps
/// in a group, and many columns.
Table make_group_table(const std::string& name, const std::string& title,
                       const std::vector<Column>& keys, std::span<const MetricRow> metrics) {
  Table table = make_table(name, title, summary_columns(keys, metrics));
  for (Column& column : table.columns) {
    if (column.place == Place::bound && !column.name.starts_with("success_rate")) {
      column.place = Place::machine;
    }
  }
  return table;
}

Table group_table(const SweepSummary& summary) {
  Table table = make_group_table(
      "groups", "By traversability, hard maps first",
      {{.name = "traversability_group",
        .header = "P_τ",
        .doc = "normalised traversability of the maps, in groups of equal map count; 1 is free",
        .place = Place::key,
        .brief = "traversability (1: free)"},
       machine_column("map_count"),
       machine_column("lowest_traversability_normalized_ratio"),
       machine_column("highest_traversability_normalized_ratio"),
       planner_column()},
      summary.metrics);
  for (const MapGroup& group : summary.groups) {
    for (const PlannerSummary& planner : group.planners) {
      table.rows.push_back(make_row(range_text(group.lowest_ratio, group.highest_ratio),
                                    group.map_count, group.lowest_ratio, group.highest_ratio,
                                    summary.planners[planner.planner], summary_cells(planner)));
    }
  }
  return table;
}

Table grouped_table(const SweepSummary& summary) {
  std::string title;
  std::vector<Column> keys;
  for (const GroupColumn& column : summary.group_columns) {
    title += (title.empty() ? "By " : ", ") + column.field;
    keys.push_back({.name = column.field, .header = last_part(column.field), .place = Place::key});
  }
  keys.push_back({.name = "map_count", .header = "maps"});
  Table table = make_group_table("grouped", title, keys, summary.metrics);
  for (const GroupRow& group : summary.group_rows) {
    Row row;
    for (const TableValue& key : group.keys) append(row, Cell{.value = key});
    append(row, group.map_count);
    append(row, summary_cells(group.summary));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table outcome_table(const SweepSummary& summary) {
  constexpr std::string_view kHeaders[] = {"goal",    "collided", "left",    "time out",
                                           "gave up", "error",    "crashed", "hung"};
  // In order of Outcome.
  static_assert(std::size(kHeaders) == kOutcomeCount);
  Table table = make_table("outcomes", "Outcomes", {planner_column()});
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    table.columns.push_back({.name = std::string(EnumText<Outcome>::entries[i].second) + "_count",
                             .header = std::string(kHeaders[i])});
  }
  for (const PlannerSummary& planner : summary.overall) {
    Row row = make_row(summary.planners[planner.planner]);
    for (const std::int64_t count : planner.outcome_counts) append(row, count);
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The factor as papers give it stands beside the smoothed one, since it is undefined at 0 and 1.
Table pair_table(const SweepSummary& summary) {
  Table table = make_table(
      "pairs", "Pairs of planners",
      {planner_column(),
       {.name = "other_planner", .header = "against", .place = Place::key},
       {.name = "contrast_factor",
        .header = "CF",
        .doc =
            "contrast factor: failures per metre of the first planner over those of the other, 1 "
            "is equal; – if undefined (a success rate is 0 or 1)",
        .brief = "failures per metre against the other's"},
       {.name = "contrast_factor_smoothed",
        .header = "CF smoothed",
        .doc = "the same of Jeffreys-smoothed rates, with a 95 % interval by bootstrap over maps",
        .has_interval = true},
       {.name = "fisher_p",
        .header = "p",
        .doc = "that the two success rates are equal (Fisher's exact test, two-sided)",
        .decimals = 3,
        .brief = "of equal success rates"},
       {.name = "map_p",
        .header = "p maps",
        .doc = "that they are equal on maps like these (Wilcoxon's signed-rank test of the maps' "
               "rates); from six maps on",
        .decimals = 3,
        .brief = "the same on other maps like these"},
       {.name = "v90_difference_mps",
        .header = "Δ v90",
        .unit = "m/s",
        .doc = "v90_difference_mps: v90 of the first planner less that of the other, with a 95 % "
               "interval by bootstrap over maps, the same for both",
        .has_interval = true,
        .brief = "its difference [95 % interval]"}});
  for (const Contrast& c : summary.contrasts) {
    table.rows.push_back(make_row(summary.planners[c.planner_1], summary.planners[c.planner_2],
                                  c.factor, c.smoothed_factor, c.smoothed_interval, c.fisher_p,
                                  c.map_p, c.v90.difference_mps, c.v90.interval));
  }
  return table;
}

/// In words, where a fit says nothing in numbers.
std::string fit_text(const DifficultyResponse& response) {
  if (response.is_separated) return "all or nothing";
  if (std::isnan(response.slope)) return "none";
  return response.slope > 0.0 ? "easier maps, more success" : "no rise";
}

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

/// What the sweep varies of its maps, then what was measured of them.
std::vector<Column> map_columns(const std::vector<std::string>& axes) {
  std::vector<Column> columns{{.name = "map", .place = Place::key},
                              {.name = "map_seed", .header = "seed"}};
  for (const std::string& axis : axes) {
    columns.push_back({.name = axis, .header = short_name(axis, axes)});
  }
  columns.insert(
      columns.end(),
      {{.name = "obstacle_count", .header = "obstacles"},
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
  return columns;
}

Table map_table(const SweepSummary& summary) {
  const std::vector<std::string>& axes = summary.environment.axes;
  Table table = make_table("maps", "Maps, hard ones first", map_columns(axes));
  for (const MapSummary& map : summary.environment.maps) {
    const MapRow& row = summary.maps[map.map];
    const MapRecord& record = row.record;
    const bool is_field = !is_from_file(row.generator);
    const Cell count{.value = is_field ? TableValue(record.obstacle_count) : TableValue()};
    // Several generators' maps may have one seed.
    Row cells = make_row(row.generator + " " + record.key.substr(0, 6), row.map_seed);
    for (const std::string& axis : axes) append(cells, Cell{.value = map_field(row, axis)});
    append(cells,
           make_row(count, record.traversability, record.traversability_normalized_ratio,
                    record.relative_gap_size, is_field ? record.obstacle_density_1pm2 : math::kNaN,
                    map.traversability_obstruction, map.view_occlusion, map.angle_over_length_1pm,
                    map.mission_count, map.invalid_mission_count, map.trial_count,
                    map.finished_count));
    table.rows.push_back(std::move(cells));
  }
  // Maps of other generators than the original's have no such number.
  for (const char* name : {"obstacle_count", "relative_gap_size", "obstacle_density_1pm2"}) {
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
  for (const EnvironmentCorrelation& c : summary.environment.correlations) {
    table.rows.push_back(make_row(c.measure, c.map_count, c.mean, c.lowest, c.highest, c.pearson,
                                  c.pearson_interval, c.spearman, c.spearman_interval));
  }
  return table;
}

std::string title_of(const SweepSummary& summary) {
  std::string title = "Sweep " + summary.name;
  // What is swept makes another map, or planner, at each level.
  const bool has_limits = summary.limits.rule.is_set();
  const auto map_count =
      has_limits ? static_cast<std::size_t>(summary.limits.map_count) : summary.maps.size();
  const std::size_t planner_count =
      has_limits ? summary.limits.planners.size() : summary.planners.size();
  if (summary.latest_revision > 1) {
    title += " (revision " + std::to_string(summary.revision) + " of " +
             std::to_string(summary.latest_revision) + ")";
  }
  title += ": " + counted(summary.trial_count, "trial") + " of " +
           counted(planner_count, "planner") + " on " + counted(map_count, "map") + ", " +
           counted(summary.mission_count, "mission") + " (" +
           std::to_string(summary.invalid_mission_count) + " invalid: not flown, not counted)";
  for (std::size_t i = 0; i < summary.conditions.size(); ++i) {
    title += (i == 0 ? ", where " : " and ") + summary.conditions[i];
  }
  return title;
}

/// Whether the groups by traversability are more than single maps.
bool has_real_groups(const SweepSummary& summary) {
  return std::all_of(summary.groups.begin(), summary.groups.end(),
                     [](const MapGroup& group) { return group.map_count > 1; });
}

/// A table of sweeps, and when people see it who have not asked for it by name.
struct TableKind {
  std::string_view name;
  enum { always, in_full, never } shown;
  Table (*make)(const SweepSummary& summary);
};

constexpr TableKind kTables[] = {
    {"limit_speeds", TableKind::always,
     [](const SweepSummary& summary) { return limit_speed_table(summary.limits); }},
    {"limits", TableKind::always,
     [](const SweepSummary& summary) { return limit_table(summary.limits); }},
    {"limit_pairs", TableKind::always,
     [](const SweepSummary& summary) { return limit_pair_table(summary.limits); }},
    {"limit_curve", TableKind::never,
     [](const SweepSummary& summary) { return limit_curve_table(summary.limits); }},
    {"speed", TableKind::always, speed_table},
    {"speed_curve", TableKind::never, speed_curve_table},
    {"planners", TableKind::always, planner_table},
    {"groups", TableKind::always, group_table},
    {"grouped", TableKind::always, grouped_table},
    {"outcomes", TableKind::always, outcome_table},
    {"causes", TableKind::always,
     [](const SweepSummary& summary) { return causes_table(summary.causes, summary.planners); }},
    {"pairs", TableKind::always, pair_table},
    {"difficulty", TableKind::in_full, difficulty_table},
    {"flight_time", TableKind::in_full, flight_time_table},
    {"flight_time_curve", TableKind::never, flight_time_curve_table},
    {"maps", TableKind::never, map_table},
    {"environment", TableKind::in_full, correlation_table}};

/// Whether people see it at this detail.
bool is_shown(const TableKind& kind, const SweepSummary& summary, Detail detail) {
  if (kind.name == "groups") {
    // Where others were asked for, they stand in its place.
    if (!summary.group_columns.empty()) return false;
    return detail == Detail::all || has_real_groups(summary);
  }
  return kind.shown == TableKind::always ||
         (kind.shown == TableKind::in_full && detail == Detail::all);
}

/// Of a table that was asked for and has no rows.
std::string why_without(const TableKind& kind, const SweepSummary& summary) {
  const std::string head = "no table " + std::string(kind.name) + ": ";
  const bool is_of_limits = kind.name.starts_with("limit");
  if (is_of_limits && !summary.limits.rule.is_set()) {
    return head + "the sweep does not search for a limit";
  }
  if (!is_of_limits && summary.limits.rule.is_set()) {
    return head +
           "in a search for a limit, each planner's trials are at different values, so rates and "
           "means over all of them mean nothing";
  }
  if (kind.name == "causes") return head + "no failure of it has been explained";
  if (kind.name == "pairs") return head + "the sweep has one planner";
  return head + "the sweep has no rows for it";
}

bool has_stars(const Table& table) {
  return std::any_of(table.rows.begin(), table.rows.end(), [](const Row& row) {
    return std::any_of(row.begin(), row.end(), [](const Cell& cell) { return cell.is_best; });
  });
}

}  // namespace

bool is_left_out(const Table& table) {
  return table.name.ends_with("pairs") && table.rows.size() > kMostShownPairs;
}

Table causes_table(std::span<const CauseCount> counts, std::span<const std::string> planners) {
  Table table = make_table("causes", "Causes of failures",
                           {planner_column(),
                            {.name = "cause", .place = Place::key},
                            {.name = "failure_count", .header = "failures"},
                            machine_column("planner_failure_count"),
                            {.name = "share_pct",
                             .header = "share",
                             .unit = "%",
                             .doc = "of the planner's failures",
                             .decimals = 0}});
  for (const CauseCount& count : counts) {
    table.rows.push_back(make_row(
        planners[count.planner], count.cause.empty() ? "(not explained)" : count.cause, count.count,
        count.failure_count,
        100.0 * static_cast<double>(count.count) / static_cast<double>(count.failure_count)));
  }
  return table;
}

std::vector<std::pair<std::string, std::string>> cause_notes(std::span<const CauseCount> counts) {
  std::vector<std::pair<std::string, std::string>> notes;
  for (const CauseDef& def : cause_table()) {
    const std::string_view name = text(def.cause);
    const bool occurs = std::any_of(counts.begin(), counts.end(),
                                    [&](const CauseCount& count) { return count.cause == name; });
    if (occurs) notes.emplace_back(name, def.doc);
  }
  return notes;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const TableKind& kind : kTables) names.emplace_back(kind.name);
  return names;
}

Section sweep_section(const SweepSummary& summary, std::span<const std::string> tables,
                      Detail detail) {
  const bool is_brief = detail == Detail::brief && tables.empty();
  Section section{.name = summary.name,
                  .title = title_of(summary),
                  .warnings = summary.warnings,
                  .is_brief = is_brief};
  bool shows_stars = false, shows_causes = false;
  for (const TableKind& kind : kTables) {
    const bool is_wanted = contains(tables, kind.name);
    if (!tables.empty() && !is_wanted) continue;
    Table table = kind.make(summary);
    // Not all sweeps have groups or pairs. A curve is there though nobody has arrived.
    if (table.rows.empty() && kind.name != "flight_time_curve") {
      if (is_wanted) section.warnings.push_back(why_without(kind, summary));
      continue;
    }
    // Formats for programs have them all, and is_for_people decides what a person sees.
    const bool is_usual = is_shown(kind, summary, detail);
    table.is_for_people = is_wanted || (is_usual && !is_left_out(table));
    if (is_usual && !table.is_for_people) {
      section.notes.emplace_back(
          kind.name, counted(table.rows.size(), "pair") +
                         " of planners, not shown: ask for this table by name, or choose among "
                         "the planners; csv and json have all of them");
    }
    shows_stars = shows_stars || (table.is_for_people && has_stars(table));
    shows_causes = shows_causes || (table.is_for_people && kind.name == "causes");
    section.tables.push_back(std::move(table));
  }
  if (shows_stars) {
    section.notes.emplace_back(
        "*", is_brief
                 ? "significantly best"
                 : "best, and significantly so against every other planner (p < 0.05, "
                   "Bonferroni): rates by Fisher's exact test and Wilcoxon's of the maps' rates, "
                   "means by Wilcoxon's signed-rank test on the missions that both have");
  }
  if (shows_causes) {
    for (auto& note : cause_notes(summary.causes)) section.notes.push_back(std::move(note));
  }
  std::vector<std::string> versions;  // "ego 1.0", "mine 0.2"
  const bool has_limits = summary.limits.rule.is_set();
  for (std::size_t i = 0; i < summary.planners.size() && !has_limits; ++i) {
    const std::string& version = summary.planner_versions[i];  // none of what flew for real
    versions.push_back(summary.planners[i] + (version.empty() ? "" : " " + version) +
                       (summary.sees_tracks[i] ? " (sees tracks)" : ""));
  }
  // Without the levels that a swept parameter makes of them.
  for (const PlannerLimit& planner : summary.limits.planners) {
    versions.push_back(planner.planner + " " + planner.version);
  }
  section.notes.emplace_back("planners", joined(versions));
  return section;
}

Section side_by_side(std::span<const SweepSummary> summaries, Detail detail) {
  Table table = make_group_table(
      "sweeps", "Planners in every sweep",
      {planner_column(), {.name = "of_sweep", .header = "sweep", .place = Place::key}},
      summaries.front().metrics);
  for (const SweepSummary& summary : summaries) {
    const std::string revision =
        summary.revision > 1 ? "@" + std::to_string(summary.revision) : std::string();
    for (const PlannerSummary& planner : summary.overall) {
      Row& row = table.rows.emplace_back(make_row(summary.planners[planner.planner],
                                                  summary.name + revision, summary_cells(planner)));
      for (Cell& cell : row) cell.is_best = false;  // among its own sweep's planners
    }
  }
  // Rows of a planner together, its sweeps in the order asked for.
  std::stable_sort(table.rows.begin(), table.rows.end(),
                   [](const auto& a, const auto& b) { return a.front().value < b.front().value; });
  return {.name = "all",
          .title = "Sweeps side by side",
          .tables = {std::move(table)},
          .is_brief = detail == Detail::brief};
}

}  // namespace avoidbench
