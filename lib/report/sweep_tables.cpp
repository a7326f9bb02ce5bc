#include "report/sweep_tables.hpp"

#include <algorithm>

#include "explain/causes.hpp"
#include "report/table_rows.hpp"
#include "text/words.hpp"

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
                       "five maps on widened by how much the maps differ",
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
    keys.push_back({.name = column.field,
                    // The last part of the path, as "poisson_radius_m" of "map.poisson_radius_m".
                    .header = column.field.substr(column.field.rfind('.') + 1),
                    .place = Place::key});
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
        .brief = "the same on other maps like these"}});
  for (const Contrast& c : summary.contrasts) {
    table.rows.push_back(make_row(summary.planners[c.planner_1], summary.planners[c.planner_2],
                                  c.factor, c.smoothed_factor, c.smoothed_interval, c.fisher_p,
                                  c.map_p));
  }
  return table;
}

/// " (revision 1 of 2)"; "" for the only one.
std::string revision_text(const SweepSummary& summary) {
  if (summary.latest_revision < 2) return "";
  return " (revision " + std::to_string(summary.revision) + " of " +
         std::to_string(summary.latest_revision) + ")";
}

/// "ego 1.0, mine 0.2".
std::string versions_text(const SweepSummary& summary) {
  std::vector<std::string> versions;
  for (std::size_t i = 0; i < summary.planners.size(); ++i) {
    versions.push_back(summary.planners[i] + " " + summary.planner_versions[i]);
  }
  return joined(versions);
}

std::string title_of(const SweepSummary& summary) {
  std::string title =
      "Sweep " + summary.name + revision_text(summary) + ": " +
      counted(summary.trial_count, "trial") + " of " + counted(summary.planners.size(), "planner") +
      " on " + counted(summary.maps.size(), "map") + ", " +
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

/// Shows people what is wanted at this detail.
void show_usual(std::vector<Table>& tables, const SweepSummary& summary, Detail detail) {
  for (Table& table : tables) {
    if (detail == Detail::all) {
      table.is_for_people = table.is_for_people || table.name == "environment";
    } else if (table.name == "groups") {
      table.is_for_people = table.is_for_people && has_real_groups(summary);
    } else if (table.name == "difficulty" || table.name == "flight_time") {
      table.is_for_people = false;
    }
  }
}

/// Those of `tables` that `names` asks for.
void keep_wanted(std::vector<Table>& tables, std::span<const std::string> names) {
  std::erase_if(tables, [&](const Table& table) {
    return std::find(names.begin(), names.end(), table.name) == names.end();
  });
  for (Table& table : tables) table.is_for_people = true;
}

}  // namespace

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
        planners[count.planner], count.cause.empty() ? "(not told)" : count.cause, count.count,
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
  return {"planners",   "groups",      "grouped",           "outcomes", "causes",     "pairs",
          "difficulty", "flight_time", "flight_time_curve", "maps",     "environment"};
}

Section sweep_section(const SweepSummary& summary, std::span<const std::string> tables,
                      Detail detail) {
  const bool is_brief = detail == Detail::brief && tables.empty();
  Section section{.name = summary.name,
                  .title = title_of(summary),
                  .warnings = summary.warnings,
                  .is_brief = is_brief};
  section.tables.push_back(planner_table(summary));
  if (!summary.groups.empty()) section.tables.push_back(group_table(summary));
  if (!summary.group_columns.empty()) {
    // The table by traversability, where there is one.
    section.tables.back().is_for_people = summary.groups.empty();  // the other one was asked for
    section.tables.push_back(grouped_table(summary));
  }
  section.tables.push_back(outcome_table(summary));
  if (!summary.causes.empty()) {
    section.tables.push_back(causes_table(summary.causes, summary.planners));
  }
  if (!summary.contrasts.empty()) section.tables.push_back(pair_table(summary));
  if (!summary.difficulty.empty()) section.tables.push_back(difficulty_table(summary));
  section.tables.push_back(flight_time_table(summary));
  section.tables.push_back(flight_time_curve_table(summary));
  section.tables.push_back(map_table(summary));
  if (!summary.environment.correlations.empty()) {
    section.tables.push_back(correlation_table(summary));
  }
  // All tables are made in any case: formats for programs have them all, and is_for_people decides
  // what a person sees.
  if (tables.empty()) {
    show_usual(section.tables, summary, detail);
  } else {
    keep_wanted(section.tables, tables);
  }
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
        "*", is_brief
                 ? "significantly best"
                 : "best, and significantly so against every other planner (p < 0.05, "
                   "Bonferroni): rates by Fisher's exact test and Wilcoxon's of the maps' rates, "
                   "means by Wilcoxon's signed-rank test on the missions that both have");
  }
  const bool shows_causes =
      std::any_of(section.tables.begin(), section.tables.end(),
                  [](const Table& table) { return table.name == "causes" && table.is_for_people; });
  if (shows_causes) {
    for (auto& note : cause_notes(summary.causes)) section.notes.push_back(std::move(note));
  }
  section.notes.emplace_back("planners", versions_text(summary));
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
