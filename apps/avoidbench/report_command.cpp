#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "commands.hpp"
#include "custom_metrics/metric_file.hpp"
#include "database_choice.hpp"
#include "output.hpp"
#include "plots.hpp"
#include "report/summary.hpp"
#include "report/sweep_choice.hpp"
#include "report/sweep_tables.hpp"

namespace avoidbench {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  OutputOptions output;
  std::string sweep;
  std::string plots;
  std::vector<std::string> metrics, metric_files, group_by, where, tables;
  bool is_all = false;
};

ReportQuery query_of(const ReportOptions& options) {
  ReportQuery query;
  query.metrics = options.metrics;
  for (const std::string& column : options.group_by) {
    query.group_by.push_back(parse_group_column(column));
  }
  for (const std::string& condition : options.where) {
    query.where.push_back(parse_condition(condition));
  }
  const std::vector<std::string> known = table_names();
  for (const std::string& table : options.tables) {
    if (std::find(known.begin(), known.end(), table) == known.end()) {
      throw InputError("--tables " + table + ": unknown" + did_you_mean(table, known));
    }
  }
  return query;
}

/// The metrics of one's own files, of every trial of each database.
std::vector<ComputedMetrics> computed_metrics(const std::vector<std::string>& files,
                                              const Database& database) {
  std::vector<ComputedMetrics> computed;
  for (const std::string& file : files) computed.push_back(computed_by(file, database));
  return computed;
}

/// Without a choice the usual metrics and all of one's own.
std::vector<std::string> metrics_with(const std::vector<ComputedMetrics>& own,
                                      const SweepResult& result) {
  std::vector<std::string> names = default_metrics(result);
  for (const ComputedMetrics& computed : own) {
    for (const MetricRow& metric : computed.metrics) names.push_back(metric.name);
  }
  return names;
}

void report(ReportOptions options) {
  ReportQuery query = query_of(options);
  check_output(options.output.output, text(options.output.format));
  if (options.files.empty()) options.files.push_back(newest_database("report").string());
  std::map<std::pair<std::string, std::string>, std::vector<SweepResult>> parts_of;  // name, spec
  const std::vector<Database> databases = opened(options.files, "report");
  std::vector<std::string> unflown;
  const auto sweeps = chosen_sweeps(databases, options.sweep, &unflown);
  for (const std::string& line : unflown) std::cerr << line << '\n';
  for (std::size_t i = 0; i < databases.size(); ++i) {
    if (sweeps[i].empty()) continue;
    const std::vector<ComputedMetrics> own = computed_metrics(options.metric_files, databases[i]);
    for (const SweepInfo& sweep : sweeps[i]) {
      SweepResult part = databases[i].read_sweep(sweep.name, sweep.revision, query.fields());
      for (const ComputedMetrics& computed : own) add_metrics(computed, part);
      if (query.metrics.empty() && !own.empty()) query.metrics = metrics_with(own, part);
      parts_of[{sweep.name, sweep.spec_json}].push_back(std::move(part));
    }
  }
  std::vector<SweepSummary> summaries;
  std::vector<const SweepResult*> all;
  for (const auto& [sweep, parts] : parts_of) {
    for (const SweepResult& part : parts) all.push_back(&part);
  }
  check_values(all, query.where);
  for (auto& [sweep, parts] : parts_of) {
    summaries.push_back(summarize(combined(std::move(parts)), query));
  }
  std::vector<Section> sections;
  const Detail detail = options.is_all ? Detail::all : Detail::brief;
  if (summaries.size() > 1 && options.tables.empty()) {
    sections.push_back(side_by_side(summaries, detail));
  }
  for (const SweepSummary& summary : summaries) {
    sections.push_back(sweep_section(summary, options.tables, detail));
  }
  if (sections.back().is_brief) {
    sections.back().footer = "More tables, all warnings and what every column means: report --all";
  }
  write_sections(sections, options.output);
  if (!options.plots.empty()) draw_plots(options.files, options.sweep, options.plots);
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report",
                                         "Tables of results: success rates with intervals, means, "
                                         "outcomes, contrast factors, response "
                                         "to difficulty");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option(
      "DB", options->files,
      "Databases; parts of one sweep are taken together (default: the newest results/*.db)");
  add_output_options(*command, options->output);
  add_sweep_choice(*command, options->sweep);
  command
      ->add_option("--plots", options->plots,
                   "Folder for the pictures of the paper, too, as PDF and PNG; needs Python with "
                   "matplotlib and pandas")
      ->type_name("FOLDER");
  command
      ->add_option("--metrics", options->metrics,
                   "Metrics to show, separated by commas; `avoidbench metrics` lists them "
                   "(default: path and energy "
                   "optimality, average goal velocity, mission progress, processing time as CPU "
                   "and wall time)")
      ->delimiter(',');
  command
      ->add_option("--metrics-from", options->metric_files,
                   "File with metrics of your own, FILE.sql or FILE.py (docs/reports.md): shown "
                   "beside the others; can be given more than once")
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--group-by", options->group_by,
                   "Columns to group trials by, separated by commas: a field of the trials "
                   "(planner, traversability, map.poisson_radius_m, wind.mean_mps, sensor, …), or "
                   "FIELD/5 for its range in five groups of equal map count")
      ->delimiter(',');
  command
      ->add_option("--where", options->where,
                   "Only trials that fulfil this: FIELD OP VALUE, such as 'map.poisson_radius_m < "
                   "3' or 'planner = ego, reactive'; given more than once, all of them")
      ->expected(1)
      ->take_all();
  command
      ->add_option(
          "--tables", options->tables,
          "Tables to show, separated by commas: planners, groups, grouped, outcomes, "
          "causes, pairs, difficulty, flight_time, flight_time_curve, maps, environment (default: "
          "planners, outcomes, pairs, and groups if each has several maps)")
      ->delimiter(',');
  command->add_flag("--all", options->is_all,
                    "Every table except maps and flight_time_curve, every warning, and what each "
                    "column means; csv and json always have all of it");
  command->callback([options] { report(*options); });
}

}  // namespace avoidbench
