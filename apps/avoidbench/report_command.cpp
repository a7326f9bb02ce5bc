#include <algorithm>
#include <iostream>
#include <map>

#include "base/data_folder.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "custom_metrics/metric_file.hpp"
#include "database_choice.hpp"
#include "output.hpp"
#include "page/page.hpp"
#include "page/page_text.hpp"
#include "page_output.hpp"
#include "process/program.hpp"
#include "report/selection.hpp"
#include "report/summary.hpp"
#include "report/sweep_tables.hpp"
#include "store/row_digest.hpp"
#include "store/trial_fields.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  OutputOptions output;
  std::string sweep;
  std::string plots, page;
  std::optional<double> page_mb;
  std::vector<std::string> metrics, metric_files, group_by, where, tables;
  bool is_all = false;
  bool must_check = false;
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
    if (!contains(known, table)) {
      const std::string meant = did_you_mean(table, known);
      throw InputError("--tables " + table + ": unknown" +
                       (meant.empty() ? "; tables are " + joined(known) : meant));
    }
  }
  return query;
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

/// The runs that flew a sweep, each once, the first one first.
std::vector<RunRow> runs_of(const Database& database, const SweepInfo& sweep) {
  std::vector<RunRow> runs;
  for (const MapFlights& map : read_map_flights(database, sweep)) {
    const bool is_there = std::any_of(runs.begin(), runs.end(), [&](const RunRow& run) {
      return run.started_at == map.first_run.started_at &&
             run.command_line == map.first_run.command_line;
    });
    if (!is_there) runs.push_back(map.first_run);
  }
  std::sort(runs.begin(), runs.end(),
            [](const RunRow& a, const RunRow& b) { return a.started_at < b.started_at; });
  return runs;
}

/// What a page needs of the databases beside the sweeps themselves; empty without a page.
struct PageParts {
  std::map<std::string, TrialListing> listing_of;      ///< by trial key
  std::map<std::string, std::vector<RunRow>> runs_of;  ///< by name of the sweep
  std::map<std::string, std::vector<std::string>> axes_of;
};

/// The fields that are read of each trial: those of the query and, for a page, the sweep's axes.
std::vector<std::string> fields_of(const ReportQuery& query, const SweepInfo& sweep,
                                   PageParts* page) {
  std::vector<std::string> fields = query.fields();
  add_limit_field(sweep.spec_json, fields);
  if (page == nullptr) return fields;
  std::vector<std::string>& axes = page->axes_of[sweep.name];
  std::vector<std::string> shown = axis_fields({&sweep, 1});
  add_limit_field(sweep.spec_json, shown);
  for (const std::string& axis : shown) {
    if (!contains(axes, axis)) axes.push_back(axis);
    if (!contains(fields, axis)) fields.push_back(axis);
  }
  return fields;
}

/// What the page has of a sweep beside its trials. After these: a run may go on and add more.
void read_page_parts(const Database& database, const SweepInfo& sweep, PageParts& page) {
  for (TrialListing& listing : database.list_trials(sweep.name, sweep.revision)) {
    std::string key = listing.key;
    page.listing_of.emplace(std::move(key), std::move(listing));
  }
  std::vector<RunRow>& runs = page.runs_of[sweep.name];
  for (RunRow& run : runs_of(database, sweep)) runs.push_back(std::move(run));
}

/// What a report is made of.
struct ReportData {
  std::vector<Database> databases;
  std::vector<SweepSummary> summaries;  ///< of the sweeps
  std::vector<SweepResult> results;     ///< the same sweeps' trials, for a page; else empty
  PageParts page;
};

/// The page with all tables, whatever of them is printed, and with what it says of a `run`.
nlohmann::ordered_json page_of(ReportData data, const PageOrigin& origin,
                               std::optional<double> page_mb, std::size_t run_bytes = 0) {
  std::vector<PageSweep> sweeps;
  std::size_t trial_count = 0;
  for (std::size_t i = 0; i < data.results.size(); ++i) {
    trial_count += data.results[i].trials.size();
    const std::string name = data.results[i].name;  // the result moves away
    std::map<std::string, std::string> causes;
    for (const TrialSummary& trial : data.results[i].trials) {
      if (!trial.cause.empty()) causes.emplace(trial.key, trial.cause);
    }
    sweeps.push_back({.summary = data.summaries[i],
                      .section = sweep_section(data.summaries[i]),
                      .result = std::move(data.results[i]),
                      .axes = data.page.axes_of[name],
                      .listing_of = data.page.listing_of,
                      .runs = data.page.runs_of[name],
                      .cause_of = std::move(causes)});
  }
  std::vector<PageDatabase> places;
  for (const Database& database : data.databases) {
    places.push_back(
        {.database = &database,
         .files = {.folders = {".", database.path().parent_path()}, .database = database.path()}});
  }
  const std::size_t room = page_room(page_mb, trial_count);
  return sweeps_page(sweeps, places, origin, room > run_bytes ? room - run_bytes : 0);
}

/// Draws the figures of papers (scripts/plot/paper_figures.py) from these databases into
/// `folder`/SWEEP/, as PDF and PNG; `sweep` as `avoidbench report --sweep`. Runs the first of
/// $AVOIDBENCH_PYTHON, python3 on the PATH and /usr/bin/python3 that has matplotlib and pandas.
/// Throws InputError where there is none (with what to install), or where the script fails.
void draw_plots(const std::vector<std::string>& databases, const std::string& sweep,
                const std::filesystem::path& folder) {
  std::vector<std::string> command = {python_with({"matplotlib", "pandas"}, "figures need"),
                                      (data_folder() / "scripts/plot/paper_figures.py").string(),
                                      "--program",
                                      program_file().string(),
                                      "--output",
                                      folder.string()};
  if (!sweep.empty()) command.insert(command.end(), {"--sweep", sweep});
  command.emplace_back("--");
  command.insert(command.end(), databases.begin(), databases.end());
  if (run_program(command, Standard::shown).code != 0) {
    throw InputError("figures could not be drawn: see above");
  }
}

/// All that is stored of all trials, also what no table needs.
void check_stored(std::span<const Database> databases) {
  for (const Database& database : databases) {
    const std::int64_t count = check_all(database);
    std::cerr << database.path().string() << ": " << counted(count, "trial")
              << " checked: rows, flights, plan calls and events are as they were stored\n";
  }
}

/// Reads the chosen sweeps of the databases: parts of a sweep become one. `has_page`: with what a
/// page needs beside the tables.
ReportData read_report(const ReportOptions& options, const std::vector<std::string>& files,
                       ReportQuery query, bool has_page) {
  ReportData data;
  data.databases = opened(files, "report");
  if (options.must_check) check_stored(data.databases);
  PageParts* const page = has_page ? &data.page : nullptr;
  std::map<std::pair<std::string, std::string>, std::vector<SweepResult>> parts_of;  // name, spec
  std::vector<std::string> unflown;
  const auto sweeps = chosen_sweeps(data.databases, options.sweep, &unflown);
  for (const std::string& line : unflown) std::cerr << line << '\n';
  for (std::size_t i = 0; i < data.databases.size(); ++i) {
    if (sweeps[i].empty()) continue;
    std::vector<ComputedMetrics> own;
    for (const std::string& metric : options.metric_files) {
      own.push_back(computed_by(metric, data.databases[i]));
    }
    for (const SweepInfo& sweep : sweeps[i]) {
      const std::vector<std::string> fields = fields_of(query, sweep, page);
      SweepResult part = data.databases[i].read_sweep(sweep.name, sweep.revision, fields);
      if (has_page) read_page_parts(data.databases[i], sweep, data.page);
      for (const ComputedMetrics& computed : own) add_metrics(computed, part);
      if (query.metrics.empty() && !own.empty()) query.metrics = metrics_with(own, part);
      parts_of[{sweep.name, sweep.spec_json}].push_back(std::move(part));
    }
  }
  std::vector<const SweepResult*> all;
  for (const auto& [sweep, parts] : parts_of) {
    for (const SweepResult& part : parts) all.push_back(&part);
  }
  check_values(all, query.where);
  for (auto& [sweep, parts] : parts_of) {
    SweepResult whole = combined(std::move(parts));
    if (has_page) data.results.push_back(selected(whole, query.where));
    data.summaries.push_back(summarize(std::move(whole), query));
  }
  return data;
}

void report(const ReportOptions& options) {
  const ReportQuery query = query_of(options);
  check_output(options.output.output, text(options.output.format));
  if (!options.page.empty()) check_page(options.page);
  if (!options.plots.empty()) made_folder(options.plots);
  std::vector<std::string> files = options.files;
  if (files.empty()) files.push_back(newest_database("report").string());
  ReportData data = read_report(options, files, query, !options.page.empty());
  std::vector<Section> sections;
  const Detail detail = options.is_all ? Detail::all : Detail::brief;
  if (data.summaries.size() > 1 && options.tables.empty()) {
    sections.push_back(side_by_side(data.summaries, detail));
  }
  for (const SweepSummary& summary : data.summaries) {
    sections.push_back(sweep_section(summary, options.tables, detail));
  }
  if (sections.back().is_brief) {
    sections.back().footer = "More tables, all warnings and what every column means: report --all";
  }
  write_sections(sections, options.output);
  if (!options.page.empty()) {
    write_page(page_of(std::move(data), page_origin(), options.page_mb), options.page);
  }
  if (!options.plots.empty()) draw_plots(files, options.sweep, options.plots);
}

}  // namespace

void write_report_files(const std::string& database, const std::string& report_file,
                        const std::string& page) {
  ReportOptions options;
  options.files = {database};
  options.output = {.format = TableFormat::markdown, .output = report_file};
  options.is_all = true;
  options.page = page;
  report(options);
}

nlohmann::ordered_json page_of_run(const std::string& database, const std::string& sweep,
                                   const PageOrigin& origin, nlohmann::ordered_json run) {
  const std::size_t run_bytes = size_in_page({{"run", run}});
  ReportOptions options;
  options.sweep = sweep;
  nlohmann::ordered_json page =
      page_of(read_report(options, {database}, {}, true), origin, {}, run_bytes);
  page["run"] = std::move(run);
  return page;
}

void add_report_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "report",
                  "Tables of results: success rates with intervals, means, outcomes, contrast "
                  "factors, response to difficulty",
                  report);
  command.add_option("DB", options.files,
                     "Databases; parts of one sweep are merged (default: the newest results/*.db)");
  add_output_options(command, options.output);
  add_sweep_choice(command, options.sweep);
  add_typed(command, "--plots", options.plots, "FOLDER",
            "Also draw the paper's figures into this folder, as PDF and PNG; needs Python with "
            "matplotlib and pandas");
  CLI::Option* page =
      add_typed(command, "--page", options.page, "FILE",
                "Also write a page: one HTML file, to be opened in a browser without a "
                "network, with charts, all trials and their flights in 3-D (docs/page.md)");
  add_page_size(command, page, options.page_mb);
  add_list(command, "--metrics", options.metrics,
           "Metrics to show, separated by commas; `avoidbench metrics` lists them (default: path "
           "and energy optimality, average goal velocity, mission progress, processing time as "
           "CPU and wall time)");
  add_repeatable(command, "--metrics-from", options.metric_files, "FILE",
                 "File with custom metrics, FILE.sql or FILE.py (docs/reports.md): shown with the "
                 "others; repeatable");
  add_list(command, "--group-by", options.group_by,
           "Columns to group trials by, separated by commas: a field of the trials (planner, "
           "traversability, map.poisson_radius_m, wind.mean_world_mps, sensor, …), or FIELD/5 for "
           "its range in five groups of equal map count");
  add_where(command, options.where);
  add_list(command, "--tables", options.tables,
           "Tables to show, separated by commas: " + joined(table_names()) +
               " (default: speed, planners, outcomes, pairs, and groups if each has several maps)");
  command.add_flag("--check", options.must_check,
                   "First check everything that is stored of each trial against its digests, "
                   "including flights and plan calls (default: rows and what is read)");
  command.add_flag("--all", options.is_all,
                   "Every table except maps, speed_curve and flight_time_curve, every warning, and "
                   "what each column means; csv and json always have all of it");
}

}  // namespace avoidbench
