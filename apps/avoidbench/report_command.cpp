#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "commands.hpp"
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
  std::vector<std::string> metrics, group_by, where, tables;
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

void report(ReportOptions options) {
  const ReportQuery query = query_of(options);
  if (options.files.empty()) options.files.push_back(newest_database("report").string());
  std::map<std::pair<std::string, std::string>, std::vector<SweepResult>> parts_of;  // name, spec
  const std::vector<Database> databases = opened(options.files, "report");
  std::vector<std::string> unflown;
  const auto sweeps = chosen_sweeps(databases, options.sweep, &unflown);
  for (const std::string& line : unflown) std::cerr << line << '\n';
  for (std::size_t i = 0; i < databases.size(); ++i) {
    for (const SweepInfo& sweep : sweeps[i]) {
      parts_of[{sweep.name, sweep.spec_json}].push_back(
          databases[i].read_sweep(sweep.name, sweep.revision, query.fields()));
    }
  }
  std::vector<SweepSummary> summaries;
  for (auto& [sweep, parts] : parts_of) {
    summaries.push_back(summarize(combined(std::move(parts)), query));
  }
  std::vector<Section> sections;
  if (summaries.size() > 1 && options.tables.empty()) sections.push_back(side_by_side(summaries));
  for (const SweepSummary& summary : summaries) {
    sections.push_back(sweep_section(summary, options.tables));
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
                   "optimality, average goal velocity, mission progress, processing time)")
      ->delimiter(',');
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
      ->add_option("--tables", options->tables,
                   "Tables to show, separated by commas: planners, groups, grouped, outcomes, "
                   "pairs, difficulty, flight_time, flight_time_curve, maps, environment")
      ->delimiter(',');
  command->callback([options] { report(*options); });
}

}  // namespace avoidbench
