#include "report/sweep_tables.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace avoidbench {
namespace {

void append(std::vector<Cell>& row, std::int64_t count) { row.emplace_back().value = count; }
void append(std::vector<Cell>& row, const std::string& words) { row.emplace_back().value = words; }
void append(std::vector<Cell>& row, double number, bool is_best = false) {
  Cell& cell = row.emplace_back();
  if (!std::isnan(number)) cell.value = number;
  cell.is_best = is_best;
}

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

void append_summary_columns(std::vector<Column>& columns, const SweepSummary& summary) {
  columns.push_back({.name = "trial_count", .header = "trials", .unit = "", .doc = ""});
  columns.push_back(
      {.name = "finished_count", .header = "", .unit = "", .doc = "", .place = Place::machine});
  columns.push_back({.name = "success_rate",
                     .header = "SR",
                     .unit = "",
                     .doc = "success_rate: finished of all trials, with Wilson's 95 % interval"});
  columns.push_back(
      {.name = "success_rate_lower", .header = "", .unit = "", .doc = "", .place = Place::bound});
  columns.push_back(
      {.name = "success_rate_upper", .header = "", .unit = "", .doc = "", .place = Place::bound});
  for (const MetricRow& metric : summary.metrics) {
    columns.push_back({.name = metric.name,
                       .header = short_header(metric),
                       .unit = metric.unit,
                       .doc = metric_doc(metric)});
    columns.push_back({.name = metric.name + "_std",
                       .header = "",
                       .unit = metric.unit,
                       .doc = "",
                       .place = Place::machine});
    columns.push_back({.name = metric.name + "_count",
                       .header = "",
                       .unit = "",
                       .doc = "",
                       .place = Place::machine});
  }
}

void append_summary_cells(std::vector<Cell>& row, const PlannerSummary& planner) {
  append(row, planner.trial_count);
  append(row, planner.finished_count);
  append(row, planner.success_rate, planner.is_best_rate);
  append(row, planner.success_interval.lower);
  append(row, planner.success_interval.upper);
  for (const MetricMean& mean : planner.means) {
    append(row, mean.mean, mean.is_best);
    append(row, mean.standard_deviation);
    append(row, mean.count);
  }
}

Column planner_column() {
  return {.name = "planner", .header = "planner", .unit = "", .doc = "", .place = Place::key};
}

Table planner_table(const SweepSummary& summary) {
  Table table{.name = "planners", .title = "Planners", .columns = {planner_column()}, .rows = {}};
  append_summary_columns(table.columns, summary);
  for (const PlannerSummary& planner : summary.overall) {
    std::vector<Cell> row;
    append(row, summary.planners[planner.planner]);
    append_summary_cells(row, planner);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string range_text(const MapGroup& group) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3f–%.3f", group.lowest_ratio, group.highest_ratio);
  return buffer.data();
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
  table.columns.push_back(
      {.name = "map_count", .header = "", .unit = "", .doc = "", .place = Place::machine});
  table.columns.push_back({.name = "lowest_traversability_normalized_ratio",
                           .header = "",
                           .unit = "",
                           .doc = "",
                           .place = Place::machine});
  table.columns.push_back({.name = "highest_traversability_normalized_ratio",
                           .header = "",
                           .unit = "",
                           .doc = "",
                           .place = Place::machine});
  table.columns.push_back(planner_column());
  append_summary_columns(table.columns, summary);
  for (const MapGroup& group : summary.groups) {
    for (const PlannerSummary& planner : group.planners) {
      std::vector<Cell> row;
      append(row, range_text(group));
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
       .doc = "contrast factor: failures a metre of the first planner over those of the other, 1 "
              "is equal; – where undefined (a success rate is 0 or 1)"});
  table.columns.push_back(
      {.name = "contrast_factor_smoothed",
       .header = "CF smoothed",
       .unit = "",
       .doc = "the same of Jeffreys-smoothed rates, with a 95 % interval by bootstrap over maps"});
  table.columns.push_back({.name = "contrast_factor_smoothed_lower",
                           .header = "",
                           .unit = "",
                           .doc = "",
                           .place = Place::bound});
  table.columns.push_back({.name = "contrast_factor_smoothed_upper",
                           .header = "",
                           .unit = "",
                           .doc = "",
                           .place = Place::bound});
  table.columns.push_back(
      {.name = "fisher_p",
       .header = "p",
       .unit = "",
       .doc = "that the two success rates are equal (Fisher's exact test, two-sided)",
       .place = Place::value,
       .decimals = 3});
  for (const Contrast& contrast : summary.contrasts) {
    std::vector<Cell> row;
    append(row, summary.planners[contrast.planner_1]);
    append(row, summary.planners[contrast.planner_2]);
    append(row, contrast.factor);
    append(row, contrast.smoothed_factor);
    append(row, contrast.smoothed_interval.lower);
    append(row, contrast.smoothed_interval.upper);
    append(row, contrast.fisher_p);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

Section sweep_section(const SweepSummary& summary) {
  Section section{
      .name = summary.name, .title = {}, .tables = {}, .notes = {}, .warnings = summary.warnings};
  section.title =
      "Sweep " + summary.name +
      (summary.revision > 1 ? " (revision " + std::to_string(summary.revision) + ")" : "") + ": " +
      counted(summary.trial_count, "trial") + " of " +
      counted(static_cast<std::int64_t>(summary.planners.size()), "planner") + " on " +
      counted(summary.map_count, "map") + ", " + counted(summary.mission_count, "mission") + " (" +
      std::to_string(summary.invalid_mission_count) + " invalid: not flown, not counted)";
  section.tables.push_back(planner_table(summary));
  if (!summary.groups.empty()) section.tables.push_back(group_table(summary));
  section.tables.push_back(outcome_table(summary));
  if (!summary.contrasts.empty()) section.tables.push_back(pair_table(summary));
  if (summary.planners.size() > 1) {
    section.notes.emplace_back(
        "*",
        "best, and significantly so against every other planner (p < 0.05, Bonferroni): rates by "
        "Fisher's exact test, means by Wilcoxon's signed-rank test on the missions that both have");
  }
  return section;
}

}  // namespace avoidbench
