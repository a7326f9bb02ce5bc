#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "plots.hpp"
#include "report/summary.hpp"
#include "report/sweep_tables.hpp"
#include "store/database.hpp"
#include "visible_streams.hpp"

namespace avoidbench {
namespace {

struct ReportOptions {
  std::vector<std::string> files;
  std::string format = "table";
  std::string output = "-";
  std::string sweep;
  std::string plots;
  std::vector<std::string> metrics, group_by, where, tables;
};

/// As wide as the terminal, within reason, and coloured there if nobody objects (no-color.org).
TextStyle style_of_output(const std::string& output) {
  TextStyle style;
  if (output != "-" || ::isatty(STDOUT_FILENO) != 1) return style;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.width = std::clamp<std::size_t>(size.ws_col, 60, 100);
  }
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  style.is_coloured = !is_dumb && (no_color == nullptr || *no_color == '\0');
  return style;
}

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

/// Whether `wanted` means this sweep: "" all, NAME the latest revision of that name, NAME@2
/// revision 2.
bool is_wanted(const SweepInfo& sweep, const std::string& wanted, bool is_latest) {
  if (wanted == sweep.name + "@" + std::to_string(sweep.revision)) return true;
  return is_latest && (wanted.empty() || wanted == sweep.name);
}

struct Candidates {
  std::map<std::pair<std::string, std::string>, std::vector<SweepResult>>
      by_sweep;  // (name, spec) → parts
  std::vector<std::string> names;
};

void add_sweeps_of(const Database& database, const std::string& wanted,
                   const std::vector<std::string>& fields, Candidates& found) {
  const std::vector<SweepInfo> sweeps = database.read_sweeps();
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const bool is_latest = i + 1 == sweeps.size() || sweeps[i + 1].name != sweeps[i].name;
    found.names.push_back(sweeps[i].name);
    if (!is_latest)
      found.names.push_back(sweeps[i].name + "@" + std::to_string(sweeps[i].revision));
    if (!is_wanted(sweeps[i], wanted, is_latest)) continue;
    if (sweeps[i].trial_count == 0) {
      std::cerr << database.path().string() << ": sweep " << sweeps[i].name
                << " has no finished trial yet\n";
      continue;
    }
    found.by_sweep[{sweeps[i].name, sweeps[i].spec_json}].push_back(
        database.read_sweep(sweeps[i].name, sweeps[i].revision, fields));
  }
}

void write_output(const std::string& path, const std::string& text) {
  if (path == "-") {
    data_output() << text << std::flush;
    if (!data_output()) throw InputError("standard output can't be written");
    return;
  }
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw InputError(InputProblem{.file = path, .message = "can't be written"});
}

void report(ReportOptions options) {
  const auto format = enum_from_text<TableFormat>(options.format);
  if (!format) {
    throw InputError("--format " + options.format + ": unknown" +
                     did_you_mean(options.format, enum_texts<TableFormat>()) +
                     "; it is one of table, csv, json, markdown, latex");
  }
  const ReportQuery query = query_of(options);
  if (options.files.empty()) options.files.push_back(newest_database("report").string());
  Candidates found;
  for (const std::string& file : options.files) {
    add_sweeps_of(open_checked(file), options.sweep, query.fields(), found);
  }
  const bool is_known =
      std::find(found.names.begin(), found.names.end(), options.sweep) != found.names.end();
  if (found.by_sweep.empty() && !options.sweep.empty() && !is_known) {
    throw InputError("no sweep " + options.sweep + did_you_mean(options.sweep, found.names));
  }
  if (found.by_sweep.empty()) throw InputError("nothing to report: no finished trial");

  std::vector<SweepSummary> summaries;
  for (auto& [sweep, parts] : found.by_sweep) {
    summaries.push_back(summarize(combined(std::move(parts)), query));
  }
  std::vector<Section> sections;
  if (summaries.size() > 1 && options.tables.empty()) sections.push_back(side_by_side(summaries));
  for (const SweepSummary& summary : summaries) {
    sections.push_back(sweep_section(summary, options.tables));
  }
  write_output(options.output, format_sections(sections, *format, style_of_output(options.output)));
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
  command->add_option("--format", options->format, "table, csv, json, markdown or latex")
      ->capture_default_str();
  command->add_option("--output", options->output, "File to write, - for standard output")
      ->capture_default_str();
  command->add_option(
      "--sweep", options->sweep,
      "Only this sweep; NAME@2 for its revision 2 (default: the latest revision of every sweep)");
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
