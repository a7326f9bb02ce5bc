#include "report/sweep_tables.hpp"

#include <algorithm>

#include "base/input_error.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// Short headers of the usual metrics; others stand with their name without unit.
std::string short_header(const MetricRow& metric) {
  constexpr std::pair<std::string_view, std::string_view> kShort[] = {
      {"path_optimality_pct", "PO"},
      {"energy_optimality", "EO"},
      {"average_goal_velocity_mps", "AGV"},
      {"mission_progress_pct", "MP"},
      {"processing_time_ms", "PT"}};
  for (const auto& [name, header] : kShort) {
    if (metric.name == name) return std::string(header);
  }
  for (const std::string_view suffix :
       {"_pct", "_ratio", "_mps", "_ms", "_1pm", "_m", "_s", "_j"}) {
    if (metric.name.ends_with(suffix))
      return metric.name.substr(0, metric.name.size() - suffix.size());
  }
  return metric.name;
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

void append_summary_columns(std::vector<Column>& columns, std::span<const MetricRow> metrics) {
  columns.push_back({.name = "trial_count", .header = "trials", .unit = "", .doc = ""});
  columns.push_back(machine_column("finished_count"));
  columns.push_back(
      {.name = "success_rate",
       .header = "SR",
       .unit = "",
       .doc = "success_rate: finished of all trials, with a 95 % interval: Wilson's, from five "
              "maps on widened by how much the maps differ"});
  append_bounds(columns, "success_rate");
  for (const MetricRow& metric : metrics) {
    columns.push_back({.name = metric.name,
                       .header = short_header(metric),
                       .unit = metric.unit,
                       .doc = metric_doc(metric)});
    append_bounds(columns, metric.name, metric.unit);
    columns.push_back(machine_column(metric.name + "_std", metric.unit));
    columns.push_back(machine_column(metric.name + "_count"));
  }
}

void append_summary_cells(std::vector<Cell>& row, const PlannerSummary& planner) {
  append(row, planner.trial_count);
  append(row, planner.finished_count);
  append(row, planner.success_rate, planner.is_best_rate);
  append(row, planner.success_interval);
  for (const MetricMean& mean : planner.means) {
    append(row, mean.mean, mean.is_best);
    append(row, mean.interval);
    append(row, mean.standard_deviation);
    append(row, mean.count);
  }
}

Table planner_table(const SweepSummary& summary) {
  Table table{.name = "planners", .title = "Planners", .columns = {planner_column()}, .rows = {}};
  append_summary_columns(table.columns, summary.metrics);
  for (const PlannerSummary& planner : summary.overall) {
    std::vector<Cell> row;
    append(row, summary.planners[planner.planner]);
    append_summary_cells(row, planner);
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// In these tables the means' intervals are left to machines: there are few maps in a group, and
/// many columns.
void hide_mean_bounds(Table& table) {
  for (Column& column : table.columns) {
    if (column.place == Place::bound && !column.name.starts_with("success_rate")) {
      column.place = Place::machine;
    }
  }
}

Table group_table(const SweepSummary& summary) {
  Table table{
      .name = "groups", .title = "By traversability, hard maps first", .columns = {}, .rows = {}};
  table.columns.push_back(
      {.name = "traversability_group",
       .header = "P_τ",
       .unit = "",
       .doc = "normalised traversability of the maps, in groups of equal map count; 1 is free",
       .place = Place::key});
  table.columns.push_back(machine_column("map_count"));
  table.columns.push_back(machine_column("lowest_traversability_normalized_ratio"));
  table.columns.push_back(machine_column("highest_traversability_normalized_ratio"));
  table.columns.push_back(planner_column());
  append_summary_columns(table.columns, summary.metrics);
  hide_mean_bounds(table);
  for (const MapGroup& group : summary.groups) {
    for (const PlannerSummary& planner : group.planners) {
      std::vector<Cell> row;
      append(row, range_text(group.lowest_ratio, group.highest_ratio));
      append(row, group.map_count);
      append(row, group.lowest_ratio);
      append(row, group.highest_ratio);
      append(row, summary.planners[planner.planner]);
      append_summary_cells(row, planner);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table grouped_table(const SweepSummary& summary) {
  std::string title = "By ";
  Table table{.name = "grouped", .title = {}, .columns = {}, .rows = {}};
  for (const GroupColumn& column : summary.group_columns) {
    title += (table.columns.empty() ? "" : ", ") + column.field;
    table.columns.push_back({.name = column.field,
                             .header = column.field.substr(column.field.rfind('.') + 1),
                             .unit = "",
                             .doc = "",
                             .place = Place::key});
  }
  table.title = title;
  table.columns.push_back({.name = "map_count", .header = "maps", .unit = "", .doc = ""});
  append_summary_columns(table.columns, summary.metrics);
  hide_mean_bounds(table);
  for (const GroupRow& group : summary.group_rows) {
    std::vector<Cell> row;
    for (const TableValue& key : group.keys) row.push_back({.value = key});
    append(row, group.map_count);
    append_summary_cells(row, group.summary);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table outcome_table(const SweepSummary& summary) {
  constexpr std::string_view kHeaders[] = {"goal",    "collided", "left",    "time out",
                                           "gave up", "error",    "crashed", "hung"};
  static_assert(std::size(kHeaders) == kOutcomeCount);
  Table table{.name = "outcomes", .title = "Outcomes", .columns = {planner_column()}, .rows = {}};
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    table.columns.push_back({.name = std::string(EnumText<Outcome>::entries[i].second) + "_count",
                             .header = std::string(kHeaders[i]),
                             .unit = "",
                             .doc = ""});
  }
  for (const PlannerSummary& planner : summary.overall) {
    std::vector<Cell> row;
    append(row, summary.planners[planner.planner]);
    for (const std::int64_t count : planner.outcome_counts) append(row, count);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table pair_table(const SweepSummary& summary) {
  Table table{
      .name = "pairs", .title = "Pairs of planners", .columns = {planner_column()}, .rows = {}};
  table.columns.push_back(
      {.name = "other_planner", .header = "against", .unit = "", .doc = "", .place = Place::key});
  table.columns.push_back(
      {.name = "contrast_factor",
       .header = "CF",
       .unit = "",
       .doc = "contrast factor: failures per metre of the first planner over those of the other, 1 "
              "is equal; – if undefined (a success rate is 0 or 1)"});
  table.columns.push_back(
      {.name = "contrast_factor_smoothed",
       .header = "CF smoothed",
       .unit = "",
       .doc = "the same of Jeffreys-smoothed rates, with a 95 % interval by bootstrap over maps"});
  append_bounds(table.columns, "contrast_factor_smoothed");
  table.columns.push_back(
      {.name = "fisher_p",
       .header = "p",
       .unit = "",
       .doc = "that the two success rates are equal (Fisher's exact test, two-sided)",
       .place = Place::value,
       .decimals = 3});
  table.columns.push_back(
      {.name = "map_p",
       .header = "p maps",
       .unit = "",
       .doc = "that they are equal on maps like these (Wilcoxon's signed-rank test of the maps' "
              "rates); from six maps on",
       .place = Place::value,
       .decimals = 3});
  for (const Contrast& contrast : summary.contrasts) {
    std::vector<Cell> row;
    append(row, summary.planners[contrast.planner_1]);
    append(row, summary.planners[contrast.planner_2]);
    append(row, contrast.factor);
    append(row, contrast.smoothed_factor);
    append(row, contrast.smoothed_interval);
    append(row, contrast.fisher_p);
    append(row, contrast.map_p);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string title_of(const SweepSummary& summary) {
  std::string title =
      "Sweep " + summary.name +
      (summary.revision > 1 ? " (revision " + std::to_string(summary.revision) + ")" : "") + ": " +
      counted(summary.trial_count, "trial") + " of " +
      counted(static_cast<std::int64_t>(summary.planners.size()), "planner") + " on " +
      counted(static_cast<std::int64_t>(summary.maps.size()), "map") + ", " +
      counted(summary.mission_count, "mission") + " (" +
      std::to_string(summary.invalid_mission_count) + " invalid: not flown, not counted)";
  for (std::size_t i = 0; i < summary.conditions.size(); ++i) {
    title += (i == 0 ? ", where " : " and ") + summary.conditions[i];
  }
  return title;
}

/// Those of `tables` that `names` asks for; all where it is empty.
void keep_wanted(std::vector<Table>& tables, std::span<const std::string> names) {
  if (names.empty()) return;
  std::erase_if(tables, [&](const Table& table) {
    return std::find(names.begin(), names.end(), table.name) == names.end();
  });
  for (Table& table : tables) table.is_for_people = true;
}

}  // namespace

std::vector<std::string> table_names() {
  return {"planners",   "groups",      "grouped",           "outcomes", "pairs",
          "difficulty", "flight_time", "flight_time_curve", "maps",     "environment"};
}

Section sweep_section(const SweepSummary& summary, std::span<const std::string> tables) {
  Section section{.name = summary.name,
                  .title = title_of(summary),
                  .tables = {},
                  .notes = {},
                  .warnings = summary.warnings};
  section.tables.push_back(planner_table(summary));
  if (!summary.groups.empty()) section.tables.push_back(group_table(summary));
  if (!summary.group_columns.empty()) {
    section.tables.back().is_for_people = summary.groups.empty();  // the other one was asked for
    section.tables.push_back(grouped_table(summary));
  }
  section.tables.push_back(outcome_table(summary));
  if (!summary.contrasts.empty()) section.tables.push_back(pair_table(summary));
  append_response_tables(section.tables, summary);
  append_environment_tables(section.tables, summary);
  keep_wanted(section.tables, tables);
  const bool has_stars =
      std::any_of(section.tables.begin(), section.tables.end(), [](const Table& table) {
        return table.is_for_people &&
               std::any_of(table.rows.begin(), table.rows.end(), [](const auto& row) {
                 return std::any_of(row.begin(), row.end(),
                                    [](const Cell& cell) { return cell.is_best; });
               });
      });
  if (has_stars) {
    section.notes.emplace_back(
        "*",
        "best, and significantly so against every other planner (p < 0.05, Bonferroni): rates by "
        "Fisher's exact test and Wilcoxon's of the maps' rates, means by Wilcoxon's signed-rank "
        "test on the missions that both have");
  }
  return section;
}

Section side_by_side(std::span<const SweepSummary> summaries) {
  Section section{
      .name = "all", .title = "Sweeps side by side", .tables = {}, .notes = {}, .warnings = {}};
  Table table{.name = "sweeps",
              .title = "Planners in every sweep",
              .columns = {planner_column()},
              .rows = {}};
  table.columns.push_back(
      {.name = "of_sweep", .header = "sweep", .unit = "", .doc = "", .place = Place::key});
  append_summary_columns(table.columns, summaries.front().metrics);
  hide_mean_bounds(table);
  for (const SweepSummary& summary : summaries) {
    for (const PlannerSummary& planner : summary.overall) {
      std::vector<Cell> row;
      append(row, summary.planners[planner.planner]);
      append(row, summary.revision > 1 ? summary.name + "@" + std::to_string(summary.revision)
                                       : summary.name);
      append_summary_cells(row, planner);
      for (Cell& cell : row) cell.is_best = false;  // among its own sweep's planners
      table.rows.push_back(std::move(row));
    }
  }
  std::stable_sort(table.rows.begin(), table.rows.end(),
                   [](const auto& a, const auto& b) { return a.front().value < b.front().value; });
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace avoidbench
